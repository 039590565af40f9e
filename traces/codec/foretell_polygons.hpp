// Guesses about vertices, polygons and the edge table; in a header, as foretell_rows.hpp is, since scenes of small
// polygons are mostly that. Part of foreteller.hpp.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "traces/codec/foreteller.hpp"

namespace zstep::codec {

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
  const auto point = [&](std::size_t i) { return scene.points[static_cast<std::size_t>(corners_[i])]; };
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
