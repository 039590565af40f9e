// Warnock's areas: their quarters, the bins of polygons, and what is done with each (002, "Warnock's Algorithm").
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "traces/formulas/outlines.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::formulas {

namespace detail {

/// Columns or rows, the end just beyond.
struct Interval {
  std::int32_t first = 0, end = 0;
};
/// Which half of its parent's columns or rows an area has: of both the one that is less far from what is recorded.
/// Where the number is odd, either half may be the larger one.
inline Interval half_of(Interval parent, Interval recorded) {
  const auto off = [&](Interval s) { return std::abs(s.first - recorded.first) + std::abs(s.end - recorded.end); };
  const std::int32_t middle = parent.first + (parent.end - parent.first) / 2,
                     other = parent.first + (parent.end - parent.first + 1) / 2;
  Interval best{middle, parent.end};
  for (const Interval half :
       {Interval{parent.first, middle}, Interval{other, parent.end}, Interval{parent.first, other}})
    if (half.first < half.end && off(half) < off(best)) best = half;
  return best;
}

/// Depths that are equal to twelve digits.
inline bool equally_near(double z, double other) {
  return std::abs(z - other) <= 1e-12 * std::max({1.0, std::abs(z), std::abs(other)});
}

/// How a piece compares with others at the corners of an area where the depths of both are known.
struct AtCorners {
  int nearer = 0, tied = 0, behind = 0;
  void add(double z, double other) { ++(equally_near(z, other) ? tied : z < other ? nearer : behind); }
  int all() const { return nearer + tied + behind; }
};

inline const AreaBegin* area_at_work(const Situation& at) {
  const std::size_t area = at.method().area;
  return at.method().area >= 0 && area < at.method().areas.size() ? &at.method().areas[area].entry : nullptr;
}

}  // namespace detail

template <class Out>
void derive(const AreaBegin& e, const Situation& at, Out& out) {
  detail::Interval columns{0, at.scene.raster.width}, rows{0, at.scene.raster.height};
  if (e.parent >= 0) {
    if (static_cast<std::size_t>(e.parent) >= at.method().areas.size()) return;
    const AreaBegin& parent = at.method().areas[e.parent].entry;
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
  std::vector<glm::dvec2> corners;
  glm::dvec2 low(1e300), high(-1e300);
  for (const std::int32_t vertex : piece->outline) {
    const auto corner = at.on_raster(vertex);
    if (!corner) return;
    out.reads(Place{Place::In::vertex, vertex});
    corners.emplace_back(corner->x, corner->y);
    low = {std::min(low.x, corner->x), std::min(low.y, corner->y)};
    high = {std::max(high.x, corner->x), std::max(high.y, corner->y)};
  }
  std::vector<Segment> outline;
  for (std::size_t i = 0; i < corners.size(); ++i)
    outline.push_back(Segment::between(corners[i], corners[i + 1 < corners.size() ? i + 1 : 0]));
  if (e.by_box) {
    const Rectangle all = rectangle_of(*area, 0.5, 1), centres = rectangle_of(*area, 0, 0);
    const bool apart = centres.is_apart(low, high), within = all.holds(low) && all.holds(high);
    return out.rule(Rule::box_decides, e.crossings == -1 && e.corners_inside == -1 &&
                                           (e.bin == Bin::disjoint ? apart : e.bin == Bin::contained && within));
  }
  const Crossed recorded{e.bin, e.crossings, e.corners_inside};
  Crossed expected = crossed_by(rectangle_of(*area), outline);
  // The square around a pixel's centre is the pixel; some take an area from the first centre to the last. What only
  // touches an area may be counted either way.
  constexpr double touch = 1e-6;
  for (const double before : {0.5, 0.0})
    for (const double after : {0.5, 0.0, 1.0})
      for (const double off : {0.0, touch, -touch})
        if (!(expected == recorded))
          if (const auto other = crossed_by(rectangle_of(*area, before + off, after + off), outline); other == recorded)
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
