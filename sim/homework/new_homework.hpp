// The folder of a new homework, what in it is made from the rest, and whether it can be handed out.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "sim/homework/homework.hpp"
#include "sim/homework/own_scenes.hpp"
#include "sim/homework/plain_scene.hpp"

namespace zstep::homework {

// Scenes of each student's own: what homework.toml says of them, and one that is fit to be handed out.

/// Reads what [[scene]] says of how a scene is made. Throws InputError.
Generator read_generator(scene::Keys& keys, const std::string& file);

/// Tries seed after seed until the reference of a scene shows all `needed` steps and is as hard as the generator asks.
/// `take` makes a scene file the task's. None, and why, where no seed will do.
std::optional<Task> make_own_scene(const Generator& how, const Key& key, const std::string& student,
                                   const Method& method, const std::vector<StepInfo>& needed, const Task& task,
                                   std::string& why, const std::function<void(SceneFile, Task&)>& take);

/// What is made from homework.toml and the scenes, where it is missing or no longer agrees with them: the scenes in
/// plain numbers, the files that write steps, in starter/ and solution/, the schema of a line, and the hand-out as a
/// page; and the hand-out and the starters without what they say of steps that are not asked for (asked_text.hpp). Each
/// with the text that it should have. Throws InputError where the hand-out's blocks are not as they must be.
std::vector<std::pair<std::filesystem::path, std::string>> made_files(const Homework& homework);
/// Writes these. Returns what it wrote, from the folder.
std::vector<std::string> refresh_homework(const std::filesystem::path& folder);

/// The methods that there is a homework of.
std::vector<std::string> homework_methods();

/// Fills a folder that is empty or not there yet: homework.toml, scenes as TOML and as plain numbers, hand-out,
/// starters, files to write steps with, and a solution apart. Returns what was written, from the folder. Throws
/// InputError, with nothing left behind, where there is no homework of this method or the folder holds something.
std::vector<std::string> new_homework(const std::string& method, const std::filesystem::path& folder);

// Whether a homework can be handed out: all that a class will do is done once.

enum class Tried : std::uint8_t {
  right,
  wrong,
  note,  ///< nothing to mend, but to know
};

/// Tries all of it and says what it found, a line each. Returns whether nothing is wrong. Throws InputError where
/// homework.toml or a scene cannot be read. `on_work` is called before what takes time, and while it does.
bool try_homework(const std::filesystem::path& folder, const std::function<void(Tried, const std::string&)>& say,
                  const std::function<void(const std::string&)>& on_work);

}  // namespace zstep::homework
