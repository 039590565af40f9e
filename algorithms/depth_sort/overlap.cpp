#include "algorithms/depth_sort/overlap.hpp"

#include <algorithm>
#include <vector>

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

}  // namespace zstep::depth_sort
