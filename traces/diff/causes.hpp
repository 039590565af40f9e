// Where the differences of two runs come from: which are causes, and what follows from each.
#pragma once

#include <vector>

#include "traces/diff/follow.hpp"

namespace zstep::diff {

/// Puts the causes into the report, and counts by kind of step what rounding explains. What was found in going through
/// A and through B has one place for each difference.
void find_causes(DiffReport& report, const std::vector<Finding>& in_a, const std::vector<Finding>& in_b);

}  // namespace zstep::diff
