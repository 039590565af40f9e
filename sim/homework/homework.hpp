// A homework: a folder with homework.toml, which says what is to be done on which scenes and what it is worth
// (docs/homework.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "sim/homework/own_scenes.hpp"
#include "sim/homework/sandbox.hpp"
#include "traces/grade/grade.hpp"
#include "traces/scene.hpp"

namespace zstep::homework {

/// A scene that was made: the scene file's text, after so many seeds, and how hard it is.
struct Made {
  std::string text;
  std::int32_t tries = 0;
  Difficulty difficulty;
};

struct Task {
  std::string name;  ///< of its file, without extension: what a submission calls its run
  bool hidden = false;
  double weight = 1;  ///< its share of all points, beside the other tasks' weights
  Scene scene;        ///< as programs get it (plain_scene.hpp)
  Conventions conventions;
  std::optional<Made> made;  ///< where it is each student's own
};

struct Homework {
  std::filesystem::path folder;
  std::string title;
  const Method* method = nullptr;
  std::vector<std::string> free;  ///< conventions that a submission chooses itself, by their keys
  std::vector<Task> tasks;
  int left_out = 0;                      ///< hidden scenes whose files are not here, as in a student's copy
  std::vector<std::string> instructors;  ///< files of hidden scenes, from the folder
  /// Whether a scene is made from the secret key: then a homework is loaded for each student.
  bool seeded() const;
  std::vector<grade::Part> parts;
  std::vector<StepInfo> steps;  ///< that a program prints: those of the parts, and what gives them their places
  std::vector<StepInfo> page;   ///< all that a program could print, in the method's order

  int digits = 6;       ///< or decimals, that numbers are held to, however few a run prints
  std::string program;  ///< the command that runs a submission's program on the scene that follows it; or none
  Limits limits;        ///< of that program

  /// The share of all points that a task has.
  double share(const Task& task) const;
  double points() const;  ///< of all parts
};

/// A scene has at most so many pixels, and the right run of it so many steps: so each command takes seconds.
inline constexpr std::int64_t most_scene_pixels = std::int64_t{1} << 20, most_scene_steps = std::int64_t{1} << 22;

/// The run that a submission is held against. Throws InputError where it has more than `most_scene_steps`.
Trace reference_run(const Method& method, const Scene& scene, const Conventions& conventions);

/// With the scenes of this student, where the folder has the key that they are made from; a student's copy has no key,
/// and the scenes themselves. Throws InputError, with FILE:LINE, where homework.toml or a scene is not as it must be.
Homework load_homework(const std::filesystem::path& folder, const std::string& student = "");

}  // namespace zstep::homework
