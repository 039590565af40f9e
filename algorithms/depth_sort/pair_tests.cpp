#include "algorithms/depth_sort/pair_tests.hpp"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>

#include "algorithms/depth_sort/overlap.hpp"
#include "traces/formulas/outlines.hpp"

namespace zstep::depth_sort {

ExtentTest extent_test(const pieces::Pieces& all, std::int32_t p, std::int32_t q, Axis axis) {
  const auto i = static_cast<glm::length_t>(axis);
  const double low = all[p].low[i], high = all[p].high[i], other_low = all[q].low[i], other_high = all[q].high[i];
  return {p, q, axis, low, high, other_low, other_high, low < other_high && other_low < high};
}

SideTest side_test(const pieces::Pieces& all, std::int32_t piece, std::int32_t plane_of, double tolerance) {
  const pieces::Plane& its = all[plane_of].plane;
  const pieces::Plane plane = its.c > 0 ? its : its.flipped();
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const std::int32_t vertex : all[piece].outline) {
    const double value = plane.value(all.corner(vertex));
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  const double near = tolerance + all[piece].bend;
  return {piece, plane_of, least, greatest, formulas::side_of(-greatest, -least, near)};  // the eye: where it is < 0
}

OverlapTest overlap_test(const pieces::Pieces& all, std::int32_t p, std::int32_t q) {
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  const auto point = common_point(all.corners(all[p].outline), all.corners(all[q].outline));
  return {p, q, point.has_value(), point ? point->x : nowhere, point ? point->y : nowhere};
}

double tolerance_for(const pieces::Pieces& all) {
  double largest = 1;
  for (const pieces::Piece& piece : all.pieces) {
    for (const glm::dvec3 corner : {glm::abs(piece.low), glm::abs(piece.high)})
      largest = std::max({largest, corner.x, corner.y, corner.z});
  }
  return 1e-12 * largest;
}

}  // namespace zstep::depth_sort
