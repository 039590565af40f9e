// Guesses where planes are compared: on Warnock's areas, and on intervals of a scan line. Part of foreteller.hpp.
#pragma once

#include <algorithm>

#include "traces/codec/foretell_rows.hpp"
#include "traces/codec/foreteller.hpp"

namespace zstep::codec {

// --- Areas

template <>
inline void Foreteller::note(const AreaBegin& event) {
  areas_.begin(event);
  painted_ = -1;
  const auto [low, high] = formulas::rectangle_of(event);
  const bool is_pixel =
      std::int64_t{event.end_column} - event.first_column == 1 && std::int64_t{event.end_row} - event.first_row == 1;
  if (is_pixel)
    begin_depths(false, {{{static_cast<double>(event.first_column), static_cast<double>(event.first_row)}}}, 1);
  else begin_depths(false, {{{low.x, low.y}, {high.x, low.y}, {low.x, high.y}, {high.x, high.y}}}, 4);
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
  const formulas::Rectangle area = formulas::rectangle_of(areas_.area());
  if (area.is_apart(extent->low, extent->high)) return;
  const PieceSides* outline = facts_->sides_of_piece(event.piece);
  if (outline == nullptr) return;
  const auto crossed = formulas::crossed_by(area, {outline->sides.data(), outline->count});
  event.crossings = crossed.crossings, event.corners_inside = crossed.corners_inside, event.bin = crossed.bin;
}

template <>
inline void Foreteller::note(const AreaBin& event) {
  areas_.bin(event);
}

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
inline void Foreteller::note(const SpanWinner& event) {
  painted_ = event.piece;
}

template <>
inline void Foreteller::note(const FlagFlip& event) {
  sweep_.flip(event.piece, event.inside);
}

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
