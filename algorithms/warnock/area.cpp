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
    edges_.push_back(formulas::Segment::between(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0]));
    low_ = glm::min(low_, glm::dvec2(corners[i]));
    high_ = glm::max(high_, glm::dvec2(corners[i]));
  }
}

Shape::Judgement Shape::judge(const Area& area, bool boxes) const {
  const formulas::Rectangle rectangle = formulas::rectangle_of(area);
  if (boxes && rectangle.is_apart(low_, high_)) return {{Bin::disjoint, -1, -1}, true};
  if (boxes && rectangle.holds(low_) && rectangle.holds(high_)) return {{Bin::contained, -1, -1}, true};
  return {formulas::crossed_by(rectangle, edges_)};
}

void Shape::find_crossings(std::int32_t y, std::vector<double>& crossings) const {
  crossings.clear();
  for (const formulas::Segment& edge : edges_) {
    if (edge.meets_row(y)) crossings.push_back(edge.x_at(y));
  }
  std::sort(crossings.begin(), crossings.end());
}

}  // namespace zstep::warnock
