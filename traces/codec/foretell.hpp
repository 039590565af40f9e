// Guesses about vertices, polygons, the edge table, pieces and rays; with foretell_rows.hpp and foretell_triangles.hpp
// these are all. Part of foreteller.hpp.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "traces/codec/foretell_rows.hpp"
#include "traces/codec/foretell_triangles.hpp"
#include "traces/codec/foreteller.hpp"

namespace zstep::codec {

// Guesses about pieces, held against planes and against one another, and about rays. Part of foreteller.hpp.

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
  if (facts_->is_point(event.vertex)) point = facts_->scene().points[event.vertex];
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
  extents_.take(piece)[axis] = range;
}

inline Foreteller::Range Foreteller::extent_of(std::int32_t piece, Axis axis) const {
  const auto* told = extents_.find(piece);
  if (told != nullptr && (*told)[axis]) return *(*told)[axis];
  const auto i = static_cast<glm::length_t>(axis);
  if (const PieceExtent* whole = facts_->extent_of_piece(piece)) return {whole->low[i], whole->high[i]};
  return {};
}

template <>
inline void Foreteller::note(const Extent& event) {
  const ByEnum<Axis, Range> told{
      Range{event.x_min, event.x_max}, {event.y_min, event.y_max}, {event.z_min, event.z_max}};
  for (const Axis axis : {Axis::x, Axis::y, Axis::z})
    learn_extent(event.piece, axis, told[axis], extent_of(event.piece, axis));
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
  if (event.facet < 0 || event.facet >= std::ssize(facts_->scene().facets)) return;
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

// Guesses about vertices, polygons and the edge table; in a header, as foretell_rows.hpp is, since scenes of small
// polygons are mostly that. Part of foreteller.hpp.

namespace detail {

inline constexpr std::size_t corners_limit = 32, made_limit = 64, cuts_limit = 256, outline_limit = 4096;

}  // namespace detail

// --- Vertices

inline void Foreteller::evaluate(ViewTransform& event) {
  const glm::dvec3 view = facts_->is_point(event.vertex) ? facts_->of_point(event.vertex).view : glm::dvec3(0);
  event.x_v = view.x, event.y_v = view.y, event.z_v = view.z;
}

inline void Foreteller::evaluate(Projection& event) {
  glm::dvec3 plane(0);
  if (facts_->is_point(event.vertex)) plane = facts_->of_point(event.vertex).plane;
  for (const VertexGeometry& made : made_)
    if (made.vertex == event.vertex) plane = made.plane;
  event.x_p = plane.x, event.y_p = plane.y, event.z = plane.z;
}

inline void Foreteller::evaluate(ViewportTransform& event) {
  const glm::dvec2 raster = facts_->to_viewport(real_[slot_of("x_p")], real_[slot_of("y_p")]);
  event.x_s = raster.x, event.y_s = raster.y;
}

template <>
inline void Foreteller::note(const ClipCross& event) {
  if (made_.size() < detail::made_limit)
    made_.push_back(facts_->from_view(event.vertex, {event.x_v, event.y_v, event.z_v}));
}

template <>
inline void Foreteller::note(const SplitVertex& event) {
  if (cuts_.size() < detail::cuts_limit) cuts_.push_back({event.vertex, {event.x_cut, event.y_cut, event.z_cut}});
  if (made_.size() >= detail::made_limit || event.space != Space::raster) return;
  VertexGeometry facts;
  facts.vertex = event.vertex;
  facts.plane.z = event.z_cut;
  facts.raster = {event.x_cut, event.y_cut};
  made_.push_back(facts);
}

inline bool Foreteller::find_raster(std::int32_t vertex, glm::dvec3& raster) const {
  for (const VertexGeometry& made : made_) {
    if (made.vertex != vertex) continue;
    raster = {made.raster, made.plane.z};
    return true;
  }
  if (!facts_->is_point(vertex)) return false;
  const VertexGeometry& facts = facts_->of_point(vertex);
  raster = {facts.raster, facts.plane.z};
  return true;
}

// --- Polygons

template <>
inline void Foreteller::note(const TablesBegin&) {
  keeps_all_ = true;
}

inline void Foreteller::begin_polygon(std::span<const std::int32_t> corners) {
  corners_ = corners;
  outline_.clear();
  looked_at_corners_ = false;
  side_ = 0;
  in_span_ = false;
  triangle_.of_polygon = 0;
  if (keeps_all_) return;
  made_.clear();
  edges_.clear();
  in_rows_ = false;
}

inline void Foreteller::tell(PolygonBegin& event) const {
  const std::vector<Facet>& facets = facts_->scene().facets;
  const auto next = static_cast<std::uint32_t>(whole_[slot_of("facet")]) + 1u;
  const std::uint32_t facet = outline_.empty() && corners_.empty() && next == 1 ? 0 : next;
  event.facet = static_cast<std::int32_t>(facet);
  event.polygon = facet < facets.size() ? facets[facet].polygon : 0;
}

template <>
inline void Foreteller::note(const PolygonBegin& event) {
  begin_polygon(facts_->corners(event.facet));
}

template <>
inline void Foreteller::note(const PieceDraw& event) {
  // Most pieces are facets that were not cut.
  const std::vector<Facet>& facets = facts_->scene().facets;
  const auto found = std::lower_bound(facets.begin(), facets.end(), event.polygon,
                                      [](const Facet& facet, std::int32_t polygon) { return facet.polygon < polygon; });
  keeps_all_ = false;  // its edges are a table of their own
  begin_polygon(found == facets.end() ? std::span<const std::int32_t>()
                                      : facts_->corners(static_cast<std::int32_t>(found - facets.begin())));
}

inline bool Foreteller::look_at_corners() {
  if (std::exchange(looked_at_corners_, true)) return !corner_facts_.empty();
  corner_facts_.clear();
  if (corners_.empty() || corners_.size() > detail::corners_limit || !facts_->viewed()) return false;
  for (const std::int32_t corner : corners_) {
    if (!facts_->is_point(corner)) {
      corner_facts_.clear();
      return false;
    }
    corner_facts_.push_back(facts_->of_point(corner));
  }
  return true;
}

inline void Foreteller::evaluate(FacingTest& event) {
  event = {};
  if (!look_at_corners()) return;
  const Scene& scene = facts_->scene();
  const bool orthographic = scene.camera.kind == Camera::Kind::orthographic;
  const std::size_t count = corners_.size();
  const auto point = [&](std::size_t i) { return scene.points[corners_[i]]; };
  const auto view = [&](std::size_t i) { return corner_facts_[i].view; };
  const glm::dvec3 first = point(0), eye = scene.camera.eye, sight = orthographic ? -eye : first - eye;
  const glm::dvec3 normal = formulas::newell_normal(glm::dvec3(0), count, point);
  const double d = orthographic ? 0 : -glm::dot(normal, first);
  event.determinant =
      glm::dot(orthographic ? glm::dvec3(0, 0, 1) : view(0), formulas::newell_about_origin(glm::dvec3(0), count, view));
  event.plane_at_eye = formulas::plane_value(normal.x, normal.y, normal.z, d, eye.x, eye.y, eye.z);
  event.view_dot_normal = glm::dot(sight, normal);
  const bool before_eye = std::all_of(corner_facts_.begin(), corner_facts_.end(),
                                      [&](const VertexGeometry& corner) { return corner.view.z >= scene.camera.near; });
  event.projected_normal_z = std::numeric_limits<double>::quiet_NaN();
  if (before_eye)
    event.projected_normal_z = formulas::newell_z(
        0.0, count, [&](std::size_t i) { return corner_facts_[i].raster.x; },
        [&](std::size_t i) { return corner_facts_[i].raster.y; });
  event.facing = event.view_dot_normal > 0 ? Facing::back : Facing::front;
}

inline void Foreteller::tell(PolygonReject& event) const {
  event.reason = facing_ == Facing::back      ? Reject::back_facing
                 : facing_ == Facing::edge_on ? Reject::edge_on
                                              : Reject::outside;
}

inline void Foreteller::evaluate(ClipTest& event) {
  event = {};
  if (!look_at_corners()) return;
  event.outside_all = (1 << 6) - 1;
  for (const VertexGeometry& corner : corner_facts_) {
    event.outside_some |= corner.outside;
    event.outside_all &= corner.outside;
  }
}

inline void Foreteller::tell(OutlineVertex& event) const {
  const std::size_t place = outline_.size();
  if (place < corners_.size()) event.vertex = corners_[place];
  else event.vertex = static_cast<std::int32_t>(static_cast<std::uint32_t>(whole_[slot_of("vertex")]) + 1u);
}

template <>
inline void Foreteller::note(const OutlineVertex& event) {
  if (outline_.size() < detail::outline_limit) outline_.push_back(event.vertex);
}

// --- The edge table

inline Foreteller::Side Foreteller::next_side() const {
  const std::span<const std::int32_t> outline = outline_.empty() ? corners_ : std::span<const std::int32_t>(outline_);
  if (outline.empty()) return {};
  return {outline[side_ % outline.size()], outline[(side_ + 1) % outline.size()]};
}

inline void Foreteller::tell(EdgeTableInsert& event) const {
  event.edge = keeps_all_ ? last_inserted_ + 1 : edges_.next_number();
  event.polygon = whole_[slot_of("polygon")];
  const Side side = next_side();
  event.vertex_0 = side.from, event.vertex_1 = side.to;
  glm::dvec3 from, to;
  if (find_raster(side.from, from) && find_raster(side.to, to) && from.y > to.y)
    std::swap(event.vertex_0, event.vertex_1);
}

inline void Foreteller::evaluate(EdgeTableInsert& event) {
  event.first_row = event.end_row = 0;
  event.x_edge = event.dx_dy = event.z_edge = event.dz_dy = 0;
  KnownEdge edge;
  if (!find_raster(event.vertex_0, edge.start) || !find_raster(event.vertex_1, edge.end)) return;
  const std::int32_t height = facts_->scene().raster.height;
  event.first_row = row_from(edge.start.y, height);
  event.end_row = row_from(edge.end.y, height);
  event.x_edge = edge.x_at(event.first_row);
  event.z_edge = edge.z_at(event.first_row);
  event.dx_dy = formulas::slope(edge.start.x, edge.end.x, edge.start.y, edge.end.y);
  event.dz_dy = formulas::slope(edge.start.z, edge.end.z, edge.start.y, edge.end.y);
}

template <>
inline void Foreteller::note(const EdgeTableInsert& event) {
  KnownEdge edge;
  find_raster(event.vertex_0, edge.start);
  find_raster(event.vertex_1, edge.end);
  edge.first_row = event.first_row, edge.end_row = event.end_row;
  edge.x = event.x_edge, edge.z = event.z_edge;
  edge.dx_dy = event.dx_dy, edge.dz_dy = event.dz_dy;
  edges_.insert(event.edge, edge);
  last_inserted_ = event.edge;
  ++side_;
}

inline void Foreteller::tell(EdgeTableSkip& event) const {
  const Side side = next_side();
  event.vertex_0 = side.from, event.vertex_1 = side.to;
}

inline void Foreteller::evaluate(EdgeTableSkip& event) {
  glm::dvec3 from, to;
  const bool known = find_raster(event.vertex_0, from) && find_raster(event.vertex_1, to);
  event.why = known && from.y == to.y ? EdgeSkip::horizontal : EdgeSkip::between_rows;
}

template <>
inline void Foreteller::note(const FacingTest& event) {
  facing_ = event.facing;
}
template <>
inline void Foreteller::note(const EdgeTableSkip&) {
  ++side_;
}

}  // namespace zstep::codec
