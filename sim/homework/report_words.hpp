// What all reports of a submission say in the same words.
#pragma once

#include <algorithm>
#include <string>

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
  return task.state == Graded::State::judged && !task.first && task.why.empty();
}
inline bool all_right(const Assessment& all) { return std::all_of(all.tasks.begin(), all.tasks.end(), is_right); }

}  // namespace zstep::homework
