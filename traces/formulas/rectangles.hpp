// How an outline lies to a rectangle of the picture (002, "Warnock's Algorithm"): for the method, for the codec that
// foretells it and for those who judge it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include <glm/vec2.hpp>

#include "traces/events/areas.hpp"
#include "traces/formulas/lines.hpp"

namespace zstep::formulas {

/// A side of an outline, from its end with the smaller y, so that polygons that share it compute the same bits.
struct Segment {
  glm::dvec2 start{0}, end{0};

  static Segment between(glm::dvec2 a, glm::dvec2 b) { return a.y > b.y ? Segment{b, a} : Segment{a, b}; }
  bool meets_row(double y) const { return start.y <= y && y < end.y; }
  double x_at(double y) const { return on_line(start.x, end.x, y, start.y, end.y); }
};

struct Rectangle {
  glm::dvec2 low, high;

  bool holds(glm::dvec2 p) const { return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y; }
  bool is_apart(glm::dvec2 other_low, glm::dvec2 other_high) const {
    return other_high.x < low.x || other_low.x > high.x || other_high.y < low.y || other_low.y > high.y;
  }
  /// A segment meets it unless its extents are apart from it or it lies on one side of the segment's line.
  bool meets(const Segment& segment) const {
    const glm::dvec2 &start = segment.start, &end = segment.end;
    if (is_apart({std::min(start.x, end.x), start.y}, {std::max(start.x, end.x), end.y})) return false;
    if (holds(start) || holds(end)) return true;
    const glm::dvec2 along = end - start;
    const auto side = [&](double x, double y) { return along.x * (y - start.y) - along.y * (x - start.x); };
    const double a = side(low.x, low.y), b = side(high.x, low.y), c = side(low.x, high.y), d = side(high.x, high.y);
    return std::min({a, b, c, d}) <= 0 && std::max({a, b, c, d}) >= 0;
  }
};

/// The squares around the centres of an area's pixels; or reaching otherwise before the first and after the last one.
template <class Area>
Rectangle rectangle_of(const Area& area, double before = 0.5, double after = 0.5) {
  return {{area.first_column - before, area.first_row - before},
          {area.end_column - 1 + after, area.end_row - 1 + after}};
}

/// Is the point in it? Even-odd rule; of edges, the left and upper ones count.
inline bool covers(std::span<const Segment> outline, double x, double y) {
  bool inside = false;
  for (const Segment& segment : outline)
    if (segment.meets_row(y) && segment.x_at(y) <= x) inside = !inside;
  return inside;
}

struct Crossed {
  Bin bin = Bin::disjoint;
  std::int32_t crossings = 0, corners_inside = 0;
  bool operator==(const Crossed&) const = default;
};
inline Crossed crossed_by(const Rectangle& area, std::span<const Segment> outline) {
  Crossed crossed;
  bool all_inside = true;
  for (const Segment& segment : outline) {
    crossed.crossings += area.meets(segment);
    all_inside = all_inside && area.holds(segment.start) && area.holds(segment.end);
  }
  if (crossed.crossings == 0) {  // no edge comes between any two points of the area, so one of them speaks for all
    const glm::dvec2 middle = (area.low + area.high) * 0.5;
    if (covers(outline, middle.x, middle.y)) crossed = {Bin::surrounding, 0, 4};
    return crossed;
  }
  for (const double x : {area.low.x, area.high.x})
    for (const double y : {area.low.y, area.high.y}) crossed.corners_inside += covers(outline, x, y);
  crossed.bin = all_inside ? Bin::contained : Bin::intersecting;
  return crossed;
}

}  // namespace zstep::formulas
