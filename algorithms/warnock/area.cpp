#include "algorithms/warnock/area.hpp"

#include <algorithm>

#include <glm/common.hpp>

namespace zstep::warnock {

std::vector<Area> quarters(const Area& area) {
  const std::int32_t column = area.first_column + (area.end_column - area.first_column) / 2;
  const std::int32_t row = area.first_row + (area.end_row - area.first_row) / 2;
  std::vector<Area> parts{{area.first_column, area.first_row, column, row},
                          {column, area.first_row, area.end_column, row},
                          {area.first_column, row, column, area.end_row},
                          {column, row, area.end_column, area.end_row}};
  std::erase_if(parts, [](const Area& a) { return a.first_column == a.end_column || a.first_row == a.end_row; });
  return parts;
}

Shape::Shape(const std::vector<glm::dvec3>& corners) : low_(corners[0]), high_(corners[0]) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    glm::dvec2 start(corners[i]), end(corners[i + 1 < corners.size() ? i + 1 : 0]);
    if (start.y > end.y) std::swap(start, end);
    edges_.push_back({start, end});
    low_ = glm::min(low_, glm::dvec2(corners[i]));
    high_ = glm::max(high_, glm::dvec2(corners[i]));
  }
}

namespace {

bool lies_in(glm::dvec2 point, glm::dvec2 low, glm::dvec2 high) {
  return low.x <= point.x && point.x <= high.x && low.y <= point.y && point.y <= high.y;
}
bool apart(glm::dvec2 low, glm::dvec2 high, glm::dvec2 other_low, glm::dvec2 other_high) {
  return high.x < other_low.x || low.x > other_high.x || high.y < other_low.y || low.y > other_high.y;
}

}  // namespace

// A segment meets a rectangle unless its extents are apart from it or the rectangle lies on one side of its line.
bool Shape::Edge::meets(glm::dvec2 low, glm::dvec2 high) const {
  if (apart(glm::min(start, end), glm::max(start, end), low, high)) return false;
  if (lies_in(start, low, high) || lies_in(end, low, high)) return true;
  const glm::dvec2 along = end - start;
  const auto side = [&](double x, double y) { return along.x * (y - start.y) - along.y * (x - start.x); };
  const double a = side(low.x, low.y), b = side(high.x, low.y), c = side(low.x, high.y), d = side(high.x, high.y);
  return std::min({a, b, c, d}) <= 0 && std::max({a, b, c, d}) >= 0;
}

Shape::Judgement Shape::judge(const Area& area, bool boxes) const {
  const glm::dvec2 low = area.low(), high = area.high();
  if (boxes && apart(low_, high_, low, high)) return {Bin::disjoint, -1, -1, true};
  if (boxes && lies_in(low_, low, high) && lies_in(high_, low, high)) return {Bin::contained, -1, -1, true};

  std::int32_t crossings = 0;
  bool all_inside = true;
  for (const Edge& edge : edges_) {
    if (edge.meets(low, high)) ++crossings;
    all_inside = all_inside && lies_in(edge.start, low, high) && lies_in(edge.end, low, high);
  }
  if (crossings == 0) {  // no edge comes between any two points of the area, so one of them speaks for all
    const bool inside = covers(area.first_column, area.first_row);
    return {inside ? Bin::surrounding : Bin::disjoint, 0, inside ? 4 : 0};
  }
  std::int32_t corners_inside = 0;
  for (const double x : {low.x, high.x}) {
    for (const double y : {low.y, high.y}) corners_inside += covers(x, y);
  }
  return {all_inside ? Bin::contained : Bin::intersecting, crossings, corners_inside};
}

bool Shape::covers(double x, double y) const {
  bool inside = false;
  for (const Edge& edge : edges_) {
    if (edge.meets_row(y) && edge.x_at(y) <= x) inside = !inside;
  }
  return inside;
}

void Shape::find_crossings(std::int32_t y, std::vector<double>& crossings) const {
  crossings.clear();
  for (const Edge& edge : edges_) {
    if (edge.meets_row(y)) crossings.push_back(edge.x_at(y));
  }
  std::sort(crossings.begin(), crossings.end());
}

}  // namespace zstep::warnock
