// What all reports of a submission say in the same words: among it why points are missing.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "sim/homework/assess.hpp"
#include "sim/homework/homework.hpp"
#include "sim/words/numbers.hpp"
#include "traces/grade/grade.hpp"

namespace zstep::homework {

// Why points are missing, in words: made of the counts that the points are made of.

/// "never", "missing", …: for programs.
std::string_view word_of(grade::Loss::Why why);
/// The names of the steps that a loss is about; none of pixels and of orders.
std::string steps_of(const Homework& homework, const grade::Loss& loss);
/// "interpolate_z: not printed, 83 expected". Of a hidden scene nothing is counted.
std::string loss_text(const Homework& homework, const grade::Loss& loss, bool hidden);
/// All of a part; empty where it has all points.
std::string losses_text(const Homework& homework, const grade::PartCount& count, bool hidden);

inline std::string points_text(double points) { return number(points, 2, true); }
/// With as many digits as tell them from all of them.
inline std::string points_text(double points, double most) {
  constexpr int most_digits = 12;
  int digits = 2;
  while (points < most && digits < most_digits && number(points, digits, true) == number(most, digits, true)) ++digits;
  return number(points, digits, true);
}

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

/// The task of which something is to be said before all wrong steps: how its program crashed, which lines cannot be
/// read. Of a hidden one less may be said.
inline const Graded* said_first(const Assessment& all) {
  const Graded* found = nullptr;
  for (const Graded& task : all.tasks)
    if (task.comes_first() && (!found || (found->task->hidden && !task.task->hidden))) found = &task;
  return found;
}
/// That, line by line; empty where there is none. The other scenes of which it is true are named.
inline std::string said_first_text(const Assessment& all) {
  const Graded* first = said_first(all);
  if (!first) return "";
  std::string others;
  for (const Graded& task : all.tasks)
    if (&task != first && task.comes_first()) others += (others.empty() ? "" : ", ") + task.task->name;
  return fmt::format("{}\nMend this first. It is about {}{}{}.", first->shown(), first->task->name,
                     first->state == Graded::State::judged ? ", of which the rest is graded" : "",
                     others.empty() ? "" : "; there is something to mend first in " + others + ", too");
}

/// Everything is right.
inline bool is_right(const Graded& task) {
  return task.is_whole() && !task.first && task.why.empty() && task.left_out.empty() && !task.passed_over.any();
}
/// What comes next where nothing that is shown is to be mended: the first part of which a program prints some step not
/// at all; or nothing. That the rest is right is said where it is, in the hidden scenes as well.
inline std::string next_part_text(const Assessment& all) {
  using Why = grade::Loss::Why;
  if (first_to_mend(all)) return "";
  const auto never = [](const grade::Loss& loss) { return loss.why == Why::never; };
  bool right = true;
  std::string part, names;
  bool whole = false;  // no step of the part is there
  for (const Graded& task : all.tasks) {
    right = right && task.state == Graded::State::judged && !task.first && task.why.empty();
    if (task.comes_first() || task.from_picture) continue;
    for (std::size_t k = 0; k < task.counts.size(); ++k) {
      const std::vector<grade::Loss>& lost = task.counts[k].lost;
      if (!part.empty() || std::none_of(lost.begin(), lost.end(), never)) continue;
      part = all.homework->parts[k].name;
      whole = std::find(task.left_out.begin(), task.left_out.end(), part) != task.left_out.end();
      for (const grade::Loss& loss : lost)
        if (never(loss)) names += (names.empty() ? "" : ", ") + steps_of(*all.homework, loss);
    }
  }
  if (part.empty()) return "";
  return fmt::format("{}{} {}: the program prints no {} yet.", right ? "What the program prints is right. " : "",
                     whole ? "Next come the" : "Next comes what is missing of the", part, names);
}
inline bool all_right(const Assessment& all) { return std::all_of(all.tasks.begin(), all.tasks.end(), is_right); }

}  // namespace zstep::homework
