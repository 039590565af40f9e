// Where the differences of two runs come from: which are causes, what follows from each, and which steps have only
// moved.
#pragma once

#include <vector>

#include "traces/diff/diff.hpp"
#include "traces/diff/follow.hpp"

namespace zstep::diff {

// A step that both runs have, but of which each has it where the other one does not.

/// Where a cause is a step of A alone and another one the same step of B alone (the same edge, pixel, polygon), the two
/// are one: the first of them stays, and `elsewhere` is the other run's.
void join_moved(const Trace& a, const Trace& b, DiffReport& report);

/// Puts the causes into the report, and counts by kind of step what rounding explains. What was found in going through
/// A and through B has one place for each difference.
void find_causes(DiffReport& report, const std::vector<Finding>& in_a, const std::vector<Finding>& in_b);

}  // namespace zstep::diff
