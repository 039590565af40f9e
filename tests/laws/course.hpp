// All lessons that come with zstep, as they are written and as they are told, with their runs.
#pragma once

#include <vector>

#include "sim/classroom/lesson.hpp"

namespace zstep::test {

struct Course {
  std::vector<Lesson> written;  // as in the files, braces and all
  std::vector<Lesson> told;     // after the run
  std::vector<Trace> traces;
};

inline const Course& course() {
  static const Course all = [] {
    Course made;
    made.written = all_lessons();
    made.told = made.written;
    for (Lesson& lesson : made.told) made.traces.push_back(run_lesson(lesson));
    return made;
  }();
  return all;
}

}  // namespace zstep::test
