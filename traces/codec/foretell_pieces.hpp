// Guesses about pieces, held against planes and against one another, and about rays. Part of foreteller.hpp.
#pragma once

#include <limits>

#include <glm/geometric.hpp>

#include "traces/codec/foreteller.hpp"

namespace zstep::codec {

// --- What pieces are

inline void Foreteller::evaluate(PlaneEquation& event) {
  const FacetPlane* plane = &of_facet_;
  if (!planes_in_world_) plane = facts_->plane_of_piece(event.piece);
  else if (event.piece != of_facet_.facet) of_facet_ = facts_->plane_by_parts(event.piece);
  static constexpr FacetPlane none;
  if (plane == nullptr) plane = &none;
  event.plane_a = plane->normal.x, event.plane_b = plane->normal.y, event.plane_c = plane->normal.z,
  event.plane_d = plane->d;
}

template <>
inline void Foreteller::note(const PlaneEquation& event) {
  divider_ = {event.piece, {event.plane_a, event.plane_b, event.plane_c}, event.plane_d};
  // Told of in the world, where trees are built, or on the raster: mostly as the one before.
  PlaneEquation guessed = event;
  evaluate(guessed);
  if (guessed.plane_a != event.plane_a) planes_in_world_ = !planes_in_world_;
}

inline void Foreteller::evaluate(Extent& event) {
  static constexpr PieceExtent none;
  const PieceExtent* extent = facts_->extent_of_piece(event.piece);
  const auto& [piece, low, high] = extent != nullptr ? *extent : none;
  event.x_min = low.x, event.x_max = high.x, event.y_min = low.y, event.y_max = high.y, event.z_min = low.z,
  event.z_max = high.z;
}

// --- Pieces against a plane

inline void Foreteller::tell(VertexSide& event) const {
  // The next piece is mostly a whole facet of its number.
  const std::span<const std::int32_t> next =
      facts_->corners(held_ < std::numeric_limits<std::int32_t>::max() ? held_ + 1 : held_);
  event.vertex = sides_ < next.size() ? next[sides_] : whole_[slot_of("vertex")];
}

inline void Foreteller::evaluate(VertexSide& event) {
  const bool told = event.plane_of == divider_.facet;
  if (!told && event.plane_of != of_facet_.facet) of_facet_ = facts_->plane_by_parts(event.plane_of);
  const FacetPlane& plane = told ? divider_ : of_facet_;
  glm::dvec3 point(0);
  if (facts_->is_point(event.vertex)) point = facts_->scene().points[static_cast<std::size_t>(event.vertex)];
  else
    for (const Cut& cut : cuts_)
      if (cut.vertex == event.vertex) point = cut.point;
  const glm::dvec3& normal = plane.normal;
  event.value = formulas::plane_value(normal.x, normal.y, normal.z, plane.d, point.x, point.y, point.z);
  event.side = formulas::side_of(event.value, event.value, facts_->tolerance());
}

template <>
inline void Foreteller::note(const VertexSide& event) {
  least_ = sides_ == 0 || event.value < least_ ? event.value : least_;
  greatest_ = sides_ == 0 || event.value > greatest_ ? event.value : greatest_;
  ++sides_;
}

inline void Foreteller::tell(SideTest& event) const {
  event.piece = sides_ > 0 && held_ < std::numeric_limits<std::int32_t>::max() ? held_ + 1 : whole_[slot_of("piece")];
  event.plane_of = whole_[slot_of("plane_of")];
}

inline void Foreteller::evaluate(SideTest& event) {
  event.least = sides_ > 0 ? least_ : real_[slot_of("least")];
  event.greatest = sides_ > 0 ? greatest_ : real_[slot_of("greatest")];
  event.side = formulas::side_of(event.least, event.greatest, facts_->tolerance());
}

template <>
inline void Foreteller::note(const SideTest& event) {
  held_ = event.piece;
  sides_ = 0;
}

// --- Pairs of pieces

/// What the scene tells needs not be remembered.
inline void Foreteller::learn_extent(std::int32_t piece, Axis axis, Range range, Range guessed) {
  if (bits_of(range.low) == bits_of(guessed.low) && bits_of(range.high) == bits_of(guessed.high)) return;
  extents_.take(piece)[static_cast<std::size_t>(axis)] = range;
}

inline Foreteller::Range Foreteller::extent_of(std::int32_t piece, Axis axis) const {
  const auto* told = extents_.find(piece);
  if (told != nullptr && (*told)[static_cast<std::size_t>(axis)]) return *(*told)[static_cast<std::size_t>(axis)];
  const auto i = static_cast<glm::length_t>(axis);
  if (const PieceExtent* whole = facts_->extent_of_piece(piece)) return {whole->low[i], whole->high[i]};
  return {};
}

template <>
inline void Foreteller::note(const Extent& event) {
  const std::array<Range, 3> told{
      Range{event.x_min, event.x_max}, {event.y_min, event.y_max}, {event.z_min, event.z_max}};
  for (const Axis axis : {Axis::x, Axis::y, Axis::z})
    learn_extent(event.piece, axis, told[static_cast<std::size_t>(axis)], extent_of(event.piece, axis));
}

inline std::int32_t Foreteller::after(std::int32_t piece) const {
  if (const std::int32_t* next = followers_.find(piece)) return *next;
  const std::int32_t nearer = facts_->next_by_depth(piece);
  return nearer >= 0 ? nearer : piece;
}

inline void Foreteller::tell(PairBegin& event) const { event.piece = whole_[slot_of("piece")]; }

inline void Foreteller::evaluate(PairBegin& event) {
  event.other = after(event.piece == pair_.piece ? pair_.other : event.piece);
}

template <>
inline void Foreteller::note(const PairBegin& event) {
  const std::int32_t before = event.piece == pair_.piece ? pair_.other : event.piece;
  if (event.other != after(before)) followers_.take(before) = event.other;
  pair_ = event;
  next_axis_ = Axis::x;
}

inline void Foreteller::tell(ExtentTest& event) const { event.axis = next_axis_; }

inline void Foreteller::evaluate(ExtentTest& event) {
  extents_guessed_ = {extent_of(event.piece, event.axis), extent_of(event.other, event.axis)};
  const auto& [one, other] = extents_guessed_;
  event.low = one.low, event.high = one.high, event.other_low = other.low, event.other_high = other.high;
  event.overlap = event.low < event.other_high && event.other_low < event.high;
}

template <>
inline void Foreteller::note(const ExtentTest& event) {
  learn_extent(event.piece, event.axis, {event.low, event.high}, extents_guessed_[0]);
  learn_extent(event.other, event.axis, {event.other_low, event.other_high}, extents_guessed_[1]);
  next_axis_ = event.axis == Axis::x ? Axis::y : Axis::z;
}

// --- Rays

inline void Foreteller::evaluate(RayPlane& event) {
  event.numerator = event.denominator = event.t = 0;
  if (event.facet < 0 || static_cast<std::size_t>(event.facet) >= facts_->scene().facets.size()) return;
  const FacetPlane& plane = facts_->plane(event.facet);
  const auto crossing = formulas::ray_crossing(ray_from_, ray_along_, plane.normal, plane.d);
  event.numerator = crossing.numerator, event.denominator = crossing.denominator, event.t = crossing.t;
}

inline void Foreteller::evaluate(RayHit& event) {
  event.t = real_[slot_of("t")];
  const glm::dvec3 point = ray_from_ + event.t * ray_along_;
  event.x_hit = point.x, event.y_hit = point.y, event.z_hit = point.z;
}

template <>
inline void Foreteller::note(const RayBegin& event) {
  ray_from_ = {event.x_0, event.y_0, event.z_0}, ray_along_ = {event.dir_x, event.dir_y, event.dir_z};
}

}  // namespace zstep::codec
