// Guesses about pieces, held against planes and against one another, and about rays. Part of foreteller.hpp.
#pragma once

#include <limits>

#include <glm/geometric.hpp>

#include "traces/codec/foreteller.hpp"

namespace zstep::codec {

namespace detail {

/// Where something lies whose values of a plane go from `least` to `greatest`.
inline Side side_of(double least, double greatest, double tolerance) {
  const bool behind = least < -tolerance, front = greatest > tolerance;
  return behind ? (front ? Side::crossing : Side::behind) : front ? Side::front : Side::on;
}

}  // namespace detail

// --- Pieces against a plane

inline void Foreteller::tell(VertexSide& event) const {
  // The next piece is mostly a whole facet of its number.
  const std::span<const std::int32_t> next = facts_->corners(held_ < std::numeric_limits<std::int32_t>::max() ? held_ + 1 : held_);
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
  event.value = plane.normal.x * point.x + plane.normal.y * point.y + plane.normal.z * point.z + plane.d;
  event.side = detail::side_of(event.value, event.value, facts_->tolerance());
}

inline void Foreteller::note(const VertexSide& event) {
  least_ = sides_ == 0 || event.value < least_ ? event.value : least_;
  greatest_ = sides_ == 0 || event.value > greatest_ ? event.value : greatest_;
  ++sides_;
}

inline void Foreteller::tell(SideTest& event) const {
  event.piece = sides_ > 0 && held_ < std::numeric_limits<std::int32_t>::max() ? held_ + 1 : whole_[slot_of("piece")];
  event.plane_of = whole_[slot_of("plane_of")];
}

inline void Foreteller::evaluate(SideTest& event) const {
  event.least = sides_ > 0 ? least_ : real_[slot_of("least")];
  event.greatest = sides_ > 0 ? greatest_ : real_[slot_of("greatest")];
  event.side = detail::side_of(event.least, event.greatest, facts_->tolerance());
}

inline void Foreteller::note(const SideTest& event) {
  held_ = event.piece;
  sides_ = 0;
}

inline void Foreteller::evaluate(PlaneDepth& event) const {
  const RasterPiece* piece = facts_->piece(event.piece);
  if (piece == nullptr) {
    event.z = real_[slot_of("z")];
    return;
  }
  const glm::dvec3& normal = piece->plane.normal;
  event.z = -(normal.x * event.x_at + normal.y * event.y_at + piece->plane.d) / normal.z;
}

// --- Pairs of pieces

inline void Foreteller::note(const Extent& event) {
  extents_.learn(event.piece, Axis::x, {event.x_min, event.x_max});
  extents_.learn(event.piece, Axis::y, {event.y_min, event.y_max});
  extents_.learn(event.piece, Axis::z, {event.z_min, event.z_max});
}

inline void Foreteller::tell(PairBegin& event) const {
  event.piece = whole_[slot_of("piece")];
  event.other = extents_.after(held_against_);
}

inline void Foreteller::note(const PairBegin& event) {
  extents_.learn_after(held_against_, event.other);
  held_against_ = event.other;
  next_axis_ = Axis::x;
}

inline void Foreteller::tell(ExtentTest& event) const { event.axis = next_axis_; }

inline KnownExtents::Range Foreteller::extent_of(std::int32_t piece, Axis axis) const {
  if (const auto told = extents_.of(piece, axis)) return *told;
  const auto i = static_cast<glm::length_t>(axis);
  if (const RasterPiece* whole = facts_->piece(piece)) return {whole->low[i], whole->high[i]};
  return {};
}

inline void Foreteller::evaluate(ExtentTest& event) const {
  const KnownExtents::Range one = extent_of(event.piece, event.axis), other = extent_of(event.other, event.axis);
  event.low = one.low, event.high = one.high, event.other_low = other.low, event.other_high = other.high;
  event.overlap = event.low < event.other_high && event.other_low < event.high;
}

inline void Foreteller::note(const ExtentTest& event) {
  extents_.learn(event.piece, event.axis, {event.low, event.high});
  extents_.learn(event.other, event.axis, {event.other_low, event.other_high});
  next_axis_ = event.axis == Axis::x ? Axis::y : Axis::z;
}

// --- Rays

inline void Foreteller::evaluate(RayPlane& event) const {
  event.numerator = event.denominator = event.t = 0;
  if (event.facet < 0 || static_cast<std::size_t>(event.facet) >= facts_->scene().facets.size()) return;
  const FacetPlane& plane = facts_->plane(event.facet);
  const glm::dvec3 &normal = plane.normal, &from = ray_from_, &along = ray_along_;
  event.numerator = -(normal.x * from.x + normal.y * from.y + normal.z * from.z + plane.d);
  event.denominator = normal.x * along.x + normal.y * along.y + normal.z * along.z;
  constexpr double edge_on_sine = 1e-12;
  const bool in_plane = event.denominator * event.denominator <= edge_on_sine * edge_on_sine * glm::dot(along, along);
  event.t = in_plane ? std::numeric_limits<double>::quiet_NaN() : event.numerator / event.denominator;
}

inline void Foreteller::evaluate(RayHit& event) const {
  event.t = real_[slot_of("t")];
  const glm::dvec3 point = ray_from_ + event.t * ray_along_;
  event.x_hit = point.x, event.y_hit = point.y, event.z_hit = point.z;
}

}  // namespace zstep::codec
