// Guesses along scan lines, on their intervals and on Warnock's areas: most of what is not a pixel, so that they are
// worth having where they can be compiled into a decoder's loop. Part of foreteller.hpp.
#pragma once

#include <algorithm>

#include "traces/codec/foreteller.hpp"
#include "traces/codec/runs.hpp"

namespace zstep::codec {

namespace detail {

/// A whole number, limited to -1 … width.
inline std::int32_t column(std::int32_t whole, std::int32_t width) { return whole < -1 ? -1 : std::min(whole, width); }

}  // namespace detail

/// The first column at or right of x, limited to -1 … width; -1 for what is not a number.
inline std::int32_t column_from(double x, std::int32_t width) {
  if (!(x > -2)) return -1;
  if (x >= width) return width;
  const auto whole = static_cast<std::int32_t>(x);  // towards 0
  return detail::column(whole + (x > whole ? 1 : 0), width);
}
/// The first column right of x, limited likewise.
inline std::int32_t column_after(double x, std::int32_t width) {
  if (!(x > -2)) return -1;
  if (x >= width) return width;
  const auto whole = static_cast<std::int32_t>(x);
  return detail::column(x < whole ? whole : whole + 1, width);
}

// --- Scan lines

inline void Foreteller::tell(ScanLineBegin& event) const {
  const std::int32_t y = whole_[slot_of("y")];
  event.y = !in_rows_ && edges_.first_row() >= 0 ? edges_.first_row()
                                                 : static_cast<std::int32_t>(static_cast<std::uint32_t>(y) + 1u);
}

template <>
inline void Foreteller::note(const ScanLineBegin&) {
  in_rows_ = true;
  in_span_ = false;
  edges_.begin_row();
}

inline void Foreteller::tell(EdgeEnter& event) const {
  const std::int32_t known = edges_.to_enter(whole_[slot_of("y")]);
  event.edge = known >= 0 ? known : static_cast<std::int32_t>(static_cast<std::uint32_t>(whole_[slot_of("edge")]) + 1u);
}

inline void Foreteller::evaluate(EdgeEnter& event) {
  const KnownEdge* edge = edges_.at(event.edge);
  event.place = edge != nullptr ? edges_.place_for(*edge) : 0;
}

inline void Foreteller::tell(EdgeRetire& event) const {
  const std::int32_t known = edges_.to_retire(whole_[slot_of("y")]);
  event.edge = known >= 0 ? known : whole_[slot_of("edge")];
}

inline void Foreteller::tell(EdgeStep& event) const {
  const std::int32_t known = edges_.to_step();
  event.edge = known >= 0 ? known : static_cast<std::int32_t>(static_cast<std::uint32_t>(whole_[slot_of("edge")]) + 1u);
}

inline void Foreteller::evaluate(EdgeStep& event) {
  const KnownEdge* edge = edges_.at(event.edge);
  const std::int32_t y = whole_[slot_of("y")];
  if (edge != nullptr && facts_->increments()) {
    event.x_edge = edge->x + edge->dx_dy, event.z_edge = edge->z + edge->dz_dy;
    return;
  }
  const EdgeLine* line = edge != nullptr ? edge : static_cast<const EdgeLine*>(facts_->edge_of_table(event.edge));
  event.x_edge = line != nullptr ? line->x_at(y) : 0, event.z_edge = line != nullptr ? line->z_at(y) : 0;
}

template <>
inline void Foreteller::note(const EdgeStep& event) {
  edges_.step();
  if (KnownEdge* edge = edges_.at(event.edge)) edge->x = event.x_edge, edge->z = event.z_edge;
}

// --- Spans

inline void Foreteller::tell(SpanBegin& event) const {
  event.left_edge = std::max(0, edges_.to_begin_span(0));
  event.right_edge = std::max(0, edges_.to_begin_span(1));
}

inline void Foreteller::fill_span(SpanBegin& event, double x_left, double z_left, double x_right,
                                  double z_right) const {
  const std::int32_t width = facts_->scene().raster.width;
  event.x_left = x_left, event.z_left = z_left, event.x_right = x_right, event.z_right = z_right;
  event.first = std::max(0, column_from(x_left, width));
  event.last = (facts_->inclusive() ? column_after(x_right, width) : column_from(x_right, width)) - 1;
  event.dz_dx = x_right != x_left ? formulas::slope(z_left, z_right, x_left, x_right) : 0;
}

inline void Foreteller::evaluate(SpanBegin& event) {
  const KnownEdge *left = edges_.at(event.left_edge), *right = edges_.at(event.right_edge);
  fill_span(event, left != nullptr ? left->x : real_[slot_of("x_right")],
            left != nullptr ? left->z : real_[slot_of("z_right")], right != nullptr ? right->x : 0,
            right != nullptr ? right->z : 0);
}

template <>
inline void Foreteller::note(const SpanBegin& event) {
  edges_.span();
  // Field by field: a copy as a whole would wait until the event's fields, just written, have reached memory.
  for_each_index<SpanBegin>(
      [&]<std::size_t I>() { span_.*field_at<SpanBegin, I>.member = event.*field_at<SpanBegin, I>.member; });
  in_span_ = true;
  // So the span's first pixel is "one more".
  whole_[slot_of("x")] = static_cast<std::int32_t>(static_cast<std::uint32_t>(event.first) - 1u);
}

// --- All of a scan line at once, which is many times faster

inline bool Foreteller::guess_row(Row& row) const {
  tell(row.line);
  const auto [one, other] = edges_.first_two();
  if (one == nullptr || one == other) return false;
  const std::int32_t y = row.line.y;
  const auto step = [&](const KnownEdge& edge, EdgeStep& event) {
    if (facts_->increments()) event.x_edge = edge.x + edge.dx_dy, event.z_edge = edge.z + edge.dz_dy;
    else event.x_edge = edge.x_at(y), event.z_edge = edge.z_at(y);
  };
  EdgeStep &left = row.edges[0], &right = row.edges[1];
  step(*one, left), step(*other, right);
  left.edge = edges_.number(*one), right.edge = edges_.number(*other);
  fill_span(row.span, left.x_edge, left.z_edge, right.x_edge, right.z_edge);
  row.span.left_edge = left.edge, row.span.right_edge = right.edge, row.span.y = y;
  const bool are_numbers = left.x_edge == left.x_edge && left.z_edge == left.z_edge && right.x_edge == right.x_edge &&
                           right.z_edge == right.z_edge;
  return are_numbers && row.span.dz_dx == row.span.dz_dx;
}

inline void Foreteller::learn_row(const Row& row) {
  learn(row.line);
  for (const EdgeStep& edge : row.edges) learn(edge);
  learn(row.span);
}

template <>
inline void Foreteller::note(const EdgeEnter& event) {
  edges_.enter(event.edge, event.place);
}
template <>
inline void Foreteller::note(const EdgeRetire& event) {
  edges_.retire(event.edge);
}
template <>
inline void Foreteller::note(const EdgeSwap& event) {
  edges_.swap(event.place);
}

inline void Foreteller::evaluate(DepthInterpolate& event) {
  event.z = in_span_ ? depth_along(span_, facts_->increments(), event.x, real_[slot_of("z")])
                     : depth_by_weights(event.x, event.y);
}

// Guesses where planes are compared: on Warnock's areas, and on intervals of a scan line. Part of foreteller.hpp.

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
  const double y = event.y;
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
