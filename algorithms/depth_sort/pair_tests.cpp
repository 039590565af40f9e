
#include "algorithms/depth_sort/pair_tests.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "traces/formulas/outlines.hpp"

namespace zstep::depth_sort {

namespace {

using Outline = std::span<const glm::dvec3>;

struct Edge {
  glm::dvec2 low, high;  // by y
  double x_at(double y) const { return low.x + (high.x - low.x) * (y - low.y) / (high.y - low.y); }
};

std::vector<Edge> edges_of(Outline outline) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a(outline[i]), b(outline[i + 1 < outline.size() ? i + 1 : 0]);
    if (a.y != b.y) edges.push_back(a.y < b.y ? Edge{a, b} : Edge{b, a});
  }
  return edges;
}

// y where two edges cross, if they do.
std::optional<double> crossing(const Edge& a, const Edge& b) {
  const double bottom = std::max(a.low.y, b.low.y), top = std::min(a.high.y, b.high.y);
  if (!(bottom < top)) return std::nullopt;
  const double at_bottom = a.x_at(bottom) - b.x_at(bottom), at_top = a.x_at(top) - b.x_at(top);
  if (!(at_bottom * at_top < 0)) return std::nullopt;
  return bottom + (top - bottom) * at_bottom / (at_bottom - at_top);
}

// Where the line y meets the outline, sorted: it is inside from the first to the second, from the third to the fourth …
std::vector<double> meet(const std::vector<Edge>& edges, double y) {
  std::vector<double> xs;
  for (const Edge& edge : edges) {
    if (edge.low.y <= y && y < edge.high.y) xs.push_back(edge.x_at(y));
  }
  std::sort(xs.begin(), xs.end());
  return xs;
}

std::optional<double> common_x(const std::vector<double>& p, const std::vector<double>& q) {
  for (std::size_t i = 0; i + 1 < p.size(); i += 2) {
    for (std::size_t j = 0; j + 1 < q.size(); j += 2) {
      const double left = std::max(p[i], q[j]), right = std::min(p[i + 1], q[j + 1]);
      if (right - left > touch) return (left + right) / 2;
    }
  }
  return std::nullopt;
}

}  // namespace

// Between two heights at which there is neither a corner nor a crossing, edges keep their order from left to right, so
// the line halfway between them stands for all lines there.
std::optional<glm::dvec2> common_point(Outline p, Outline q) {
  const std::vector<Edge> edges_p = edges_of(p), edges_q = edges_of(q);
  std::vector<Edge> edges = edges_p;
  edges.insert(edges.end(), edges_q.begin(), edges_q.end());

  std::vector<double> heights;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    heights.push_back(edges[i].low.y);
    heights.push_back(edges[i].high.y);
    for (std::size_t j = 0; j < i; ++j) {
      if (const auto y = crossing(edges[i], edges[j])) heights.push_back(*y);
    }
  }
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    if (!(heights[i + 1] - heights[i] > touch)) continue;
    const double y = (heights[i] + heights[i + 1]) / 2;
    if (const auto x = common_x(meet(edges_p, y), meet(edges_q, y))) return glm::dvec2(*x, y);
  }
  return std::nullopt;
}

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
