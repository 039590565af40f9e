// Steps: the named lines of an algorithm's pseudo-code.
//
// A step is the pseudo-code line, the anchor of a lesson's narration and the category of a grading report at once. Each
// module lists its steps in one steps.def and declares them by including declare_steps.hpp (see there).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traces/events/vocabulary.hpp"

namespace zstep {

/// The handle of a step. Its type says which event the step records, so that recording another one does not compile.
template <class E>
struct Step {
  std::uint8_t id;
};

/// A step as a trace's header carries it.
struct StepInfo {
  std::uint8_t id = 0;      ///< unique in its trace, below step_limit
  std::uint8_t kind = 0;    ///< which event it records: an index of Event
  std::uint8_t indent = 0;  ///< depth of nesting in the pseudo-code
  std::string module;       ///< "viewing", "scan_conversion", "z_buffer"
  std::string name;         ///< "compare"
  std::string text;         ///< "if z < zbuffer[x,y]"

  bool operator==(const StepInfo&) const = default;
};

/// A method's pseudo-code: its steps in the order in which they are read.
using Page = std::vector<StepInfo>;

inline constexpr int step_limit =
    125;  ///< a token of the file is seven bits, and three of them stand for several events

}  // namespace zstep
