// Where a stop attaches: `at: z_buffer.compare where not nearer, first`, `before: retire_edge where edge == 2`, `at:
// end`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim/classroom/expression.hpp"
#include "traces/record/recorder.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::classroom {

struct Anchor {
  enum class Kind : std::uint8_t { step, start, end, here };  ///< here: where the stop before it stands
  enum class Which : std::uint8_t { next, first, last, nth };
  Kind kind = Kind::step;
  bool before = false;  ///< the trace stands just before the step, so that the reader can predict it
  std::string step;
  std::optional<Expression> condition;
  Which which = Which::next;  ///< next: the first one after the stop before it
  std::int64_t n = 0;         ///< for nth, from 1
};

/// Reads what stands between a heading's braces. Throws InputError.
Anchor parse_anchor(std::string_view text, std::string_view where);

/// Checks the step's name and the condition's names against a method's page. Throws InputError.
void check_anchor(const Anchor& anchor, const Page& page, std::string_view where);

/// Where an anchor was found: the trace's position while it speaks, and the position that its step leads to (0: no
/// step).
struct Spot {
  std::int64_t position = 0;
  std::int64_t event = 0;
};

/// Finds the step in the replay's trace. Throws InputError when it never happens, or not after `previous`.
Spot resolve_anchor(const Anchor& anchor, const Spot& previous, Replay& replay, std::string_view where);

}  // namespace zstep::classroom
