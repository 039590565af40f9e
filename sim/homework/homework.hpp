// A homework: a folder with homework.toml, which says what is to be done on which scenes and what it is worth
// (docs/homework.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "sim/homework/sandbox.hpp"
#include "traces/grade/grade.hpp"
#include "traces/scene.hpp"

namespace zstep::homework {

struct Task {
  std::string name;  ///< of its file, without extension: what a submission calls its run
  bool hidden = false;
  double weight = 1;  ///< its share of all points, beside the other tasks' weights
  Scene scene;
  Conventions conventions;
};

struct Homework {
  std::filesystem::path folder;
  std::string title;
  const Method* method = nullptr;
  std::vector<std::string> free;  ///< conventions that a submission chooses itself, by their keys
  std::vector<Task> tasks;
  int left_out = 0;  ///< hidden scenes whose files are not here, as in a student's copy
  std::vector<grade::Part> parts;
  std::vector<StepInfo> steps;  ///< that a program prints: those of the parts, and what gives them their places

  std::string program;  ///< the command that runs a submission's program on the scene that follows it; or none
  Limits limits;        ///< of that program

  /// The share of all points that a task has.
  double share(const Task& task) const;
  double points() const;  ///< of all parts
};

/// Throws InputError, with FILE:LINE, where homework.toml or a scene is not as it must be.
Homework load_homework(const std::filesystem::path& folder);

}  // namespace zstep::homework
