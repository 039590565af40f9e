// Scenes of each student's own: what homework.toml says of them, and one that is fit to be handed out.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "sim/homework/homework.hpp"
#include "sim/homework/seeds.hpp"

namespace zstep::homework {

/// Reads what [[scene]] says of how a scene is made. Throws InputError.
Generator read_generator(scene::Keys& keys, const std::string& file);

/// Tries seed after seed until the reference of a scene shows all `needed` steps and is as hard as the generator asks.
/// `take` makes a scene file the task's. None, and why, where no seed will do.
std::optional<Task> make_own_scene(const Generator& how, const Key& key, const std::string& student,
                                   const Method& method, const std::vector<StepInfo>& needed, const Task& task,
                                   std::string& why, const std::function<void(SceneFile, Task&)>& take);

}  // namespace zstep::homework
