// What a reader changed of a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algorithms/catalog/changes.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/viewer/model/step_marks.hpp"

namespace zstep::viewer {

/// What a reader changed, against the run that was opened.
struct Changed {
  struct Made {
    Change change;
    std::string was;  ///< its value in the run that was opened
  };
  std::vector<Made> made;         ///< each thing once
  std::vector<PixelMark> pixels;  ///< that end otherwise than in the run before
  std::string told;               ///< what the last change did, in a sentence
  std::optional<TaskState> task;  ///< how the run stands to what is to be tried
};

}  // namespace zstep::viewer
