// Which polygon is seen where two runs end with different pictures, and in which order each of them painted polygons
// over one another: of methods that have few steps in common, this is what there is to tell.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/diff/diff.hpp"
#include "traces/file/trace.hpp"

namespace zstep::diff {

// Polygons that are painted over one another: what comes later is seen. So their order is part of what a run does,
// though each step may be as it should be.

/// Finds where B paints, before something else, what A paints after it, and it matters: what B paints first is nearer,
/// or another one of the two is seen at the end. Adds the first such step to the causes, unless it follows from another
/// one, and to the differences. Steps that are about other pixels may come in any order.
void find_wrong_order(const Trace& b, DiffReport& report);

/// Of compares that part though each is right: an earlier or later one at the same pixel that has changed places with
/// it.
void find_other_order(const Trace& a, const Trace& b, DiffReport& report);

/// What one run did with a polygon at a pixel. A step of 0: it never came to it there.
struct DrawnAt {
  std::int64_t step = 0;   ///< by which it was last put there
  std::int64_t found = 0;  ///< or, where it was not, was last compared
  double z = 0;            ///< then
};

/// Pixels at which A shows one polygon at its end, and B another one or nothing.
struct SeenApart {
  std::int32_t polygon_a = no_polygon, polygon_b = no_polygon;
  std::int64_t pixels = 0;
  std::int32_t x = 0, y = 0;  ///< the first of them
  DrawnAt a_in_a, b_in_a;     ///< what A did there with the polygon that A shows, and with the one that B shows
  DrawnAt a_in_b, b_in_b;     ///< and B
};

/// By pairs of polygons, those at most pixels first. Both pictures are those at the ends, of one size.
std::vector<SeenApart> seen_apart(const Trace& a, const Picture& end_a, const Trace& b, const Picture& end_b);

}  // namespace zstep::diff
