// What all reports of a submission say in the same words.
#pragma once

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "sim/homework/assess.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::homework {

inline std::string points_text(double points) { return number(points, 2, true); }

inline const char* word_of_state(Graded::State state) {
  switch (state) {
    case Graded::State::judged:
      return "judged";
    case Graded::State::missing:
      return "missing";
    case Graded::State::stopped:
      return "stopped";
    default:
      return "unreadable";
  }
}

/// The task whose first wrong step a student is shown: of a hidden one no numbers are.
inline const Graded* first_to_mend(const Assessment& all) {
  const auto found = std::find_if(all.tasks.begin(), all.tasks.end(),
                                  [](const Graded& task) { return task.first && !task.task->hidden; });
  return found == all.tasks.end() ? nullptr : &*found;
}

inline bool is_right(const Graded& task) {
  return task.state == Graded::State::judged && !task.first && task.why.empty() && task.left_out.empty();
}
/// What comes next where nothing that is shown is to be mended: the first part that a program has no step of; or
/// nothing. That the rest is right is said where it is, in the hidden scenes as well.
inline std::string next_part_text(const Assessment& all) {
  if (first_to_mend(all)) return "";
  const auto task = std::find_if(all.tasks.begin(), all.tasks.end(),
                                 [](const Graded& one) { return !one.left_out.empty(); });
  if (task == all.tasks.end()) return "";
  const auto part = std::find_if(all.homework->parts.begin(), all.homework->parts.end(),
                                 [&](const grade::Part& one) { return one.name == task->left_out.front(); });
  std::string names;
  for (const StepInfo& step : all.homework->steps)
    if (std::find(part->kinds.begin(), part->kinds.end(), step.kind) != part->kinds.end())
      names += (names.empty() ? "" : ", ") + step.name;
  const bool right = std::all_of(all.tasks.begin(), all.tasks.end(), [](const Graded& one) {
    return one.state == Graded::State::judged && !one.first && one.why.empty();
  });
  return fmt::format("{}Next come the {}: the program prints no {} yet.",
                     right ? "What the program prints is right. " : "", part->name, names);
}
inline bool all_right(const Assessment& all) { return std::all_of(all.tasks.begin(), all.tasks.end(), is_right); }

}  // namespace zstep::homework
