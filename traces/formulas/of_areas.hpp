// Warnock's areas: their quarters, the bins of polygons, and what is done with each (002, "Warnock's Algorithm").
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "traces/formulas/lines.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::formulas {

namespace detail {

/// Columns or rows, the end just beyond.
struct Stretch {
  std::int32_t first = 0, end = 0;
};
/// Which half of its parent's stretch an area has: of both the one that is less far from what is recorded. Where the
/// number is odd, either half may be the larger one.
inline Stretch half_of(Stretch parent, Stretch recorded) {
  const auto off = [&](Stretch s) { return std::abs(s.first - recorded.first) + std::abs(s.end - recorded.end); };
  const std::int32_t middle = parent.first + (parent.end - parent.first) / 2,
                     other = parent.first + (parent.end - parent.first + 1) / 2;
  Stretch best{middle, parent.end};
  for (const Stretch half : {Stretch{parent.first, middle}, Stretch{other, parent.end}, Stretch{parent.first, other}})
    if (half.first < half.end && off(half) < off(best)) best = half;
  return best;
}

/// A rectangle of the picture.
struct Rectangle {
  double left, right, top, bottom;

  bool holds(double x, double y) const { return left <= x && x <= right && top <= y && y <= bottom; }
  bool is_apart(double x_0, double x_1, double y_0, double y_1) const {
    return x_1 < left || x_0 > right || y_1 < top || y_0 > bottom;
  }
  /// A segment meets it unless its extents are apart from it or it lies on one side of the segment's line.
  bool meets(glm::dvec2 a, glm::dvec2 b) const {
    if (is_apart(std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y))) return false;
    if (holds(a.x, a.y) || holds(b.x, b.y)) return true;
    const auto side = [&](double x, double y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); };
    const double corners[] = {side(left, top), side(right, top), side(left, bottom), side(right, bottom)};
    const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
    return *least <= 0 && *most >= 0;
  }
};

/// How an outline lies to a rectangle.
struct Crossed {
  std::int32_t crossings = 0, corners_inside = 0;
  Bin bin = Bin::disjoint;
  bool operator==(const Crossed&) const = default;
};
inline Crossed crossed_by(const Rectangle& area, const std::vector<glm::dvec2>& outline) {
  const auto covers = [&](double x, double y) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      glm::dvec2 a = outline[i], b = outline[i + 1 < outline.size() ? i + 1 : 0];
      if (a.y > b.y) std::swap(a, b);
      if (a.y <= y && y < b.y && on_line(a.x, b.x, y, a.y, b.y) <= x) inside = !inside;
    }
    return inside;
  };
  Crossed crossed;
  bool all_in = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    crossed.crossings += area.meets(outline[i], outline[i + 1 < outline.size() ? i + 1 : 0]);
    all_in = all_in && area.holds(outline[i].x, outline[i].y);
  }
  if (crossed.crossings == 0) {  // no edge comes between any two points of the area
    const bool inside = covers((area.left + area.right) / 2, (area.top + area.bottom) / 2);
    if (inside) crossed.corners_inside = 4, crossed.bin = Bin::surrounding;
    return crossed;
  }
  for (const double x : {area.left, area.right})
    for (const double y : {area.top, area.bottom}) crossed.corners_inside += covers(x, y);
  crossed.bin = all_in ? Bin::contained : Bin::intersecting;
  return crossed;
}

inline const AreaBegin* area_at_work(const Situation& at) {
  const auto area = static_cast<std::size_t>(at.method().area);
  return at.method().area >= 0 && area < at.method().areas.size() ? &at.method().areas[area].entry : nullptr;
}

}  // namespace detail

template <class Out>
void derive(const AreaBegin& e, const Situation& at, Out& out) {
  detail::Stretch columns{0, at.scene.raster.width}, rows{0, at.scene.raster.height};
  if (e.parent >= 0) {
    if (static_cast<std::size_t>(e.parent) >= at.method().areas.size()) return;
    const AreaBegin& parent = at.method().areas[static_cast<std::size_t>(e.parent)].entry;
    columns = detail::half_of({parent.first_column, parent.end_column}, {e.first_column, e.end_column});
    rows = detail::half_of({parent.first_row, parent.end_row}, {e.first_row, e.end_row});
  }
  out.is(&AreaBegin::first_column, columns.first), out.is(&AreaBegin::end_column, columns.end);
  out.is(&AreaBegin::first_row, rows.first), out.is(&AreaBegin::end_row, rows.end);
}

template <class Out>
void derive(const AreaBin& e, const Situation& at, Out& out) {
  const AreaBegin* area = detail::area_at_work(at);
  const Piece* piece = at.piece(e.piece);
  if (!area || !piece || piece->outline.empty()) return;
  std::vector<glm::dvec2> outline;
  glm::dvec2 low(1e300), high(-1e300);
  for (const std::int32_t vertex : piece->outline) {
    const auto corner = at.on_raster(vertex);
    if (!corner) return;
    out.reads(Place{Place::In::vertex, vertex});
    outline.emplace_back(corner->x, corner->y);
    low = {std::min(low.x, corner->x), std::min(low.y, corner->y)};
    high = {std::max(high.x, corner->x), std::max(high.y, corner->y)};
  }
  // The square around a pixel's centre is the pixel; some take an area from the first centre to the last.
  const auto wider = [&](double before, double after) {
    return detail::Rectangle{area->first_column - before, area->end_column - 1 + after, area->first_row - before,
                             area->end_row - 1 + after};
  };
  if (e.by_box) {
    const detail::Rectangle all = wider(0.5, 1), centres = wider(0, 0);
    const bool apart = centres.is_apart(low.x, high.x, low.y, high.y),
               within = all.holds(low.x, low.y) && all.holds(high.x, high.y);
    return out.rule(Rule::box_decides, e.crossings == -1 && e.corners_inside == -1 &&
                                           (e.bin == Bin::disjoint ? apart : e.bin == Bin::contained && within));
  }
  const detail::Crossed recorded{e.crossings, e.corners_inside, e.bin};
  detail::Crossed expected = detail::crossed_by(wider(0.5, 0.5), outline);
  // What only touches an area may be counted either way.
  constexpr double touch = 1e-6;
  for (const double before : {0.5, 0.0})
    for (const double after : {0.5, 0.0, 1.0})
      for (const double off : {0.0, touch, -touch})
        if (!(expected == recorded))
          if (const auto other = detail::crossed_by(wider(before + off, after + off), outline); other == recorded)
            expected = other;
  out.is(&AreaBin::crossings, expected.crossings);
  out.is(&AreaBin::corners_inside, expected.corners_inside);
  out.is(&AreaBin::bin, expected.bin);
}

template <class Out>
void derive(const AreaDecide& e, const Situation& at, Out& out) {
  const AreaBegin* area = detail::area_at_work(at);
  if (!area || !at.records<AreaBin>()) return;
  int surrounding = 0, partly = 0;
  bool is_surrounding = false, is_partly = false;
  for (const AreaBin& bin : at.method().bins) {
    const bool around = bin.bin == Bin::surrounding, some = bin.bin == Bin::intersecting || bin.bin == Bin::contained;
    surrounding += around, partly += some;
    is_surrounding = is_surrounding || (around && bin.piece == e.piece);
    is_partly = is_partly || (some && bin.piece == e.piece);
  }
  const bool pixel = area->end_column - area->first_column == 1 && area->end_row - area->first_row == 1;
  bool right = e.area == at.method().area;
  switch (e.what) {
    case AreaCase::background:
      right = right && surrounding == 0 && partly == 0 && e.piece == -1;
      break;
    case AreaCase::one_polygon:
      right = right && surrounding == 0 && partly == 1 && is_partly;
      break;
    case AreaCase::surrounded:
      right = right && surrounding == 1 && partly == 0 && is_surrounding;
      break;
    case AreaCase::front_surrounder:
      right = right && is_surrounding;
      break;
    case AreaCase::pixel:
      right = right && pixel && (e.piece == -1 || is_surrounding || is_partly);
      break;
    case AreaCase::subdivide:
      right = right && !pixel && surrounding + partly > 0 && e.piece == -1;
      break;
  }
  out.rule(Rule::area_case, right);
}

}  // namespace zstep::formulas
