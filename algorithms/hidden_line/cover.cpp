#include "algorithms/hidden_line/cover.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "traces/formulas/outlines.hpp"
#include "traces/scene.hpp"

namespace zstep::hidden_line {

namespace {

double snapped(double value, double tolerance) { return std::abs(value) <= tolerance ? 0 : value; }

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Where the line, endless, crosses the outline.
std::vector<double> crossings_on_picture(const lines::Line& line, std::span<const glm::dvec3> face) {
  const glm::dvec2 from(line.from), along = glm::dvec2(line.to) - from;
  const double length = line.length();
  const auto side = [&](glm::dvec3 corner) {
    return snapped(cross(along, glm::dvec2(corner) - from) / length, on_line);
  };
  std::vector<double> crossings;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const glm::dvec3 start = face[i], end = face[i + 1 < face.size() ? i + 1 : 0];
    const double side_0 = side(start), side_1 = side(end);
    if ((side_0 > 0) == (side_1 > 0)) continue;
    const glm::dvec3 point = formulas::part_of_way(start, end, formulas::where_zero(side_0, side_1));
    crossings.push_back(glm::dot(glm::dvec2(point) - from, along) / (length * length));
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

}  // namespace

Cover find_cover(const lines::Line& line, std::span<const glm::dvec3> face, const pieces::Plane& plane) {
  // The eye looks along z: behind the plane is where its value has the sign of C.
  const double away = plane.c > 0 ? 1 : -1;
  const double d_0 = snapped(away * plane.value(line.from), on_plane);
  const double d_1 = snapped(away * plane.value(line.to), on_plane);
  if (d_0 <= 0 && d_1 <= 0) return {LineFace::in_front, {}, {}};

  Cover cover{LineFace::behind, {}, {}};
  Interval behind{0, 1};
  if (d_0 < 0 || d_1 < 0) {
    const double t = formulas::where_zero(d_0, d_1);
    (d_0 < 0 ? behind.t_0 : behind.t_1) = t;
    cover.crossings.push_back({t, true});
  }
  const std::vector<double> crossings = crossings_on_picture(line, face);
  for (const double t : crossings) {
    if (t > 0 && t < 1) cover.crossings.push_back({t, false});
  }
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {  // even-odd: inside between each pair
    const Interval both{std::max(crossings[i], behind.t_0), std::min(crossings[i + 1], behind.t_1)};
    if ((both.t_1 - both.t_0) * line.length() > shortest) cover.hidden.push_back(both);
  }
  if (!cover.hidden.empty()) cover.outcome = LineFace::covered;
  return cover;
}

std::vector<Part> cut(std::vector<Interval> hidden, double length) {
  const double least = shortest / length;
  std::sort(hidden.begin(), hidden.end(), [](const Interval& a, const Interval& b) { return a.t_0 < b.t_0; });
  std::vector<Part> parts;
  double seen_to = 0;  // all before it is in a part
  for (const Interval& interval : hidden) {
    if (interval.t_1 <= seen_to) continue;
    if (interval.t_0 - seen_to > least) {
      parts.push_back({seen_to, interval.t_0, true});
      parts.push_back({interval.t_0, interval.t_1, false});
    } else if (parts.empty()) {
      parts.push_back({0, interval.t_1, false});
    } else {
      parts.back().t_1 = interval.t_1;
    }
    seen_to = interval.t_1;
  }
  if (parts.empty() || 1 - seen_to > least) parts.push_back({seen_to, 1, true});
  parts.back().t_1 = 1;
  return parts;
}

namespace {

constexpr std::int32_t cell = 16;  // pixels

// The cell of a coordinate; what lies beyond the picture counts to the cells at its border.
std::int32_t cell_of(double at, std::int32_t cells) {
  return static_cast<std::int32_t>(std::clamp((at + 0.5) / cell, 0.0, cells - 1.0));
}

}  // namespace

Grid::Grid(const pieces::Pieces& faces, const Raster& raster)
    : faces_(faces),
      columns_(std::max(1, (raster.width + cell - 1) / cell)),
      rows_(std::max(1, (raster.height + cell - 1) / cell)),
      cells_(static_cast<std::size_t>(columns_) * rows_) {
  for (std::size_t i = 0; i < faces.pieces.size(); ++i) {
    const Cells reach = cells_of(faces.pieces[i].low, faces.pieces[i].high);
    for (std::int32_t row = reach.first_row; row <= reach.last_row; ++row) {
      for (std::int32_t column = reach.first_column; column <= reach.last_column; ++column) {
        at(column, row).push_back(index32(i));
      }
    }
  }
}

Grid::Cells Grid::cells_of(glm::dvec3 low, glm::dvec3 high) const {
  return {cell_of(low.x, columns_), cell_of(low.y, rows_), cell_of(high.x, columns_), cell_of(high.y, rows_)};
}

std::vector<std::int32_t>& Grid::at(std::int32_t column, std::int32_t row) {
  return cells_[static_cast<std::size_t>(row) * columns_ + column];
}

std::vector<std::int32_t> Grid::near(const lines::Line& line) {
  const glm::dvec3 low = glm::min(line.from, line.to), high = glm::max(line.from, line.to);
  const Cells reach = cells_of(low, high);
  std::vector<std::int32_t> found;
  for (std::int32_t row = reach.first_row; row <= reach.last_row; ++row) {
    for (std::int32_t column = reach.first_column; column <= reach.last_column; ++column) {
      for (const std::int32_t number : at(column, row)) {
        const pieces::Piece& face = faces_[number];
        const bool apart = face.high.x < low.x || face.low.x > high.x || face.high.y < low.y || face.low.y > high.y;
        if (!apart && face.low.z < high.z) found.push_back(number);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace zstep::hidden_line
