// A step that both runs have, but of which each has it where the other one does not.
#pragma once

#include "traces/diff/diff.hpp"

namespace zstep::diff {

/// Where a cause is a step of A alone and another one the same step of B alone (the same edge, pixel, polygon), the two
/// are one: the first of them stays, and `elsewhere` is the other run's.
void join_moved(const Trace& a, const Trace& b, DiffReport& report);

}  // namespace zstep::diff
