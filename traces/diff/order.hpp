// Polygons that are painted over one another: what comes later is seen. So their order is part of what a run does,
// though each step may be as it should be.
#pragma once

#include "traces/diff/diff.hpp"

namespace zstep::diff {

/// Finds where B paints, before something else, what A paints after it, and it matters: what B paints first is nearer,
/// or another one of the two is seen at the end. Adds the first such step to the causes, unless it follows from another
/// one, and to the differences. Steps that are about other pixels may come in any order.
void find_wrong_order(const Trace& b, DiffReport& report);

/// Of compares that part though each is right: an earlier or later one at the same pixel that has changed places with
/// it.
void find_other_order(const Trace& a, const Trace& b, DiffReport& report);

}  // namespace zstep::diff
