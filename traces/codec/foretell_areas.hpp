// Guesses where planes are compared: on Warnock's areas, and on intervals of a scan line. Part of foreteller.hpp.
#pragma once

#include <algorithm>

#include "traces/codec/foretell_rows.hpp"
#include "traces/codec/foreteller.hpp"

namespace zstep::codec {

// --- Areas

namespace detail {

/// The rectangle of an area's pixels, half a pixel wider than their centres. Without jumps, as none could be foretold.
struct Rectangle {
  double left, right, top, bottom;

  explicit Rectangle(const AreaBegin& area)
      : left(area.first_column - 0.5),
        right(area.end_column - 0.5),
        top(area.first_row - 0.5),
        bottom(area.end_row - 0.5) {}
  bool holds(glm::dvec2 point) const {
    return (left <= point.x) & (point.x <= right) & (top <= point.y) & (point.y <= bottom);
  }
  bool meets(const PieceSides::Side& side) const {
    const glm::dvec2 &start = side.start, &end = side.end, along = end - start;
    const double x_least = std::min(start.x, end.x), x_most = std::max(start.x, end.x);
    const bool overlaps = (x_most >= left) & (x_least <= right) & (end.y >= top) & (start.y <= bottom);
    const bool holds_start = holds(start), holds_end = holds(end);
    // On which side of its line the corners lie.
    const double up = along.x * (top - start.y), down = along.x * (bottom - start.y),
                 to_left = along.y * (left - start.x), to_right = along.y * (right - start.x);
    const double least = std::min(std::min(up - to_left, up - to_right), std::min(down - to_left, down - to_right));
    const double most = std::max(std::max(up - to_left, up - to_right), std::max(down - to_left, down - to_right));
    return overlaps & (holds_start | holds_end | ((least <= 0) & (most >= 0)));
  }
};

/// Is the point in it? By the even-odd rule.
inline bool covers(const PieceSides& outline, double x, double y) {
  bool inside = false;
  for (std::uint32_t i = 0; i < outline.count; ++i) {
    const auto& [start, end] = outline.sides[i];
    inside ^= (start.y <= y) & (y < end.y) & (start.x + (end.x - start.x) * (y - start.y) / (end.y - start.y) <= x);
  }
  return inside;
}

}  // namespace detail

template <>
inline void Foreteller::note(const AreaBegin& event) {
  areas_.begin(event);
  painted_ = -1;
  const detail::Rectangle area(event);
  const bool is_pixel =
      std::int64_t{event.end_column} - event.first_column == 1 && std::int64_t{event.end_row} - event.first_row == 1;
  if (is_pixel)
    begin_depths(false, {{{static_cast<double>(event.first_column), static_cast<double>(event.first_row)}}}, 1);
  else
    begin_depths(false,
                 {{{area.left, area.top}, {area.right, area.top}, {area.left, area.bottom}, {area.right, area.bottom}}},
                 4);
}

inline void Foreteller::tell(AreaBin& event) const {
  const std::int32_t next = areas_.next_piece();
  event.piece = next >= 0 ? next : static_cast<std::int32_t>(static_cast<std::uint32_t>(whole_[slot_of("piece")]) + 1u);
}

inline void Foreteller::evaluate(AreaBin& event) {
  event.crossings = event.corners_inside = 0, event.bin = Bin::disjoint, event.by_box = false;
  if (areas_.surrounded_before()) {
    event.corners_inside = 4, event.bin = Bin::surrounding;
    return;
  }
  const PieceExtent* extent = areas_.at_work() ? facts_->extent_of_piece(event.piece) : nullptr;
  if (extent == nullptr) return;
  const detail::Rectangle area(areas_.area());
  const glm::dvec3 &low = extent->low, &high = extent->high;
  if (high.x < area.left || low.x > area.right || high.y < area.top || low.y > area.bottom) return;
  const PieceSides* outline = facts_->sides_of_piece(event.piece);
  if (outline == nullptr) return;
  if (area.holds(glm::dvec2(low)) && area.holds(glm::dvec2(high))) {
    event.crossings = static_cast<std::int32_t>(outline->count), event.bin = Bin::contained;
    return;
  }
  for (std::uint32_t i = 0; i < outline->count; ++i) event.crossings += area.meets(outline->sides[i]);
  const auto covers = [&](double x, double y) {
    return ((low.x <= x) & (x <= high.x) & (low.y <= y) & (y <= high.y)) && detail::covers(*outline, x, y);
  };
  if (event.crossings > 0) {
    for (const double x : {area.left, area.right})
      for (const double y : {area.top, area.bottom}) event.corners_inside += covers(x, y);
    event.bin = Bin::intersecting;
  } else if (covers(areas_.area().first_column, areas_.area().first_row)) {
    event.corners_inside = 4, event.bin = Bin::surrounding;
  }
}

template <>
inline void Foreteller::note(const AreaBin& event) { areas_.bin(event); }

template <>
inline void Foreteller::note(const AreaDecide& event) {
  areas_.decide();
  painted_ = event.piece;
}

inline void Foreteller::evaluate(PixelPaint& event) {
  const FacetPlane* plane = in_span_ || painted_ < 0 ? nullptr : facts_->plane_of_piece(painted_);
  if (in_span_) event.z = depth_along(span_, facts_->increments(), event.x, real_[slot_of("z")]);
  else event.z = plane != nullptr ? depth_of(*plane, event.x, event.y) : real_[slot_of("z")];
}

// --- Intervales of a scan line

inline void Foreteller::evaluate(FlagFlip& event) {
  const TableEdge* edge = facts_->edge_of_table(event.edge);
  event.piece = edge != nullptr ? edge->piece : whole_[slot_of("piece")];
  event.inside = !sweep_.is_inside(event.piece);
}

template <>
inline void Foreteller::note(const SpanWinner& event) { painted_ = event.piece; }

template <>
inline void Foreteller::note(const FlagFlip& event) { sweep_.flip(event.piece, event.inside); }

inline void Foreteller::tell(SpanFlags& event) const {
  event.x_left = real_[slot_of("x_right")];
  event.x_right = real_[slot_of("x_right")];
}

inline void Foreteller::evaluate(SpanFlags& event) {
  const std::int32_t width = facts_->scene().raster.width;
  event.first = std::max(0, column_from(event.x_left, width));
  event.last = std::max(0, column_from(event.x_right, width)) - 1;
  event.flags = static_cast<std::int32_t>(sweep_.count());
}

template <>
inline void Foreteller::note(const SpanFlags& event) {
  sweep_.expect(event.flags);
  const auto y = static_cast<double>(event.y);
  begin_depths(true, {{{event.x_left, y}, {event.x_right, y}}}, 2);
}

// --- Depths: of one piece after another at the same points

inline void Foreteller::begin_depths(bool on_line, const std::array<glm::dvec2, 4>& points, std::size_t count) {
  depths_on_line_ = on_line;
  depth_points_ = points, depth_point_count_ = count;
  depth_point_ = depth_place_ = 0;
}

inline void Foreteller::tell(PlaneDepth& event) const {
  event.piece = whole_[slot_of("piece")];
  const std::size_t count = depths_on_line_ ? sweep_.count() : areas_.piece_count();
  if (depth_point_ == 0 && depth_place_ < count) {
    const std::int32_t listed = depths_on_line_ ? sweep_.piece(depth_place_) : areas_.piece(depth_place_);
    if (listed >= 0) event.piece = listed;
  }
  const bool known = depth_point_count_ > 0;
  event.x_at = known ? depth_points_[depth_point_].x : real_[slot_of("x_at")];
  event.y_at = known ? depth_points_[depth_point_].y : real_[slot_of("y_at")];
}

inline void Foreteller::evaluate(PlaneDepth& event) {
  const FacetPlane* plane = facts_->plane_of_piece(event.piece);
  event.z = plane != nullptr ? depth_of(*plane, event.x_at, event.y_at) : real_[slot_of("z")];
}

template <>
inline void Foreteller::note(const PlaneDepth& event) {
  constexpr std::size_t look_ahead = 256;
  if (depth_point_count_ == 0) return;
  if (depth_point_ == 0) {
    if (depths_on_line_) sweep_.learn(depth_place_, event.piece);
    // Pieces of an area may be passed over.
    else
      for (std::size_t place = depth_place_, end = std::min(areas_.piece_count(), depth_place_ + look_ahead);
           place < end; ++place)
        if (areas_.piece(place) == event.piece) {
          depth_place_ = place;
          break;
        }
  }
  if (++depth_point_ < depth_point_count_) return;
  depth_point_ = 0;
  ++depth_place_;
}

}  // namespace zstep::codec
