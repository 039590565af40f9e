#include "traces/codec/scene_geometry.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/edge_functions.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/scene.hpp"

namespace zstep::codec {

SceneGeometry::SceneGeometry(const Scene& scene, const Header& header)
    : scene_(&scene),
      samples_(formulas::samples_of(header.conventions)),
      reach_(formulas::reach_of(header.conventions)),
      increments_(header.conventions.interpolation == Conventions::Interpolation::increments),
      inclusive_(header.conventions.coverage == Conventions::Coverage::inclusive),
      steps_edges_(formulas::steps_edges(header.conventions)),
      cull_(header.conventions.cull),
      viewed_(scene.camera.kind != Camera::Kind::screen),
      orthographic_(scene.camera.kind == Camera::Kind::orthographic),
      view_depth_(header.conventions.depth == Conventions::Depth::view),
      one_table_(sweeps(header)),
      d_(scene.camera.d),
      window_x_(scene.camera.window * scene.raster.width / scene.raster.height),
      window_y_(scene.camera.window),
      near_(scene.camera.near),
      far_(scene.camera.far),
      a_(formulas::pseudodepth_a(near_, far_)),
      b_(formulas::pseudodepth_b(near_, far_)),
      width_(scene.raster.width),
      height_(scene.raster.height) {}

glm::dvec3 SceneGeometry::project(glm::dvec3 view) const {
  if (orthographic_)
    return {view.x, view.y, view_depth_ ? view.z : formulas::parallel_pseudodepth(near_, far_, view.z)};
  return {formulas::projected(d_, view.x, view.z), formulas::projected(d_, view.y, view.z),
          view_depth_ ? view.z : formulas::pseudodepth(near_, a_, b_, view.z)};
}

glm::dvec2 SceneGeometry::to_viewport(double x_p, double y_p) const {
  return {formulas::screen_x<double>(x_p, window_x_, width_, scene_->raster),
          formulas::screen_y<double>(y_p, window_y_, height_, scene_->raster)};
}

double SceneGeometry::distance_inside(glm::dvec3 view, std::size_t plane) const {
  const formulas::ViewVolume<double> volume{orthographic_, near_, far_, d_, window_x_, window_y_};
  return formulas::distance_inside(volume, static_cast<ClipPlane>(plane), view.x, view.y, view.z);
}

std::int32_t SceneGeometry::outcode(glm::dvec3 view) const {
  std::int32_t outside = 0;
  for (std::size_t plane = 0; plane < clip_planes; ++plane)
    outside |= static_cast<std::int32_t>(!(distance_inside(view, plane) >= 0)) << plane;
  return outside;
}

VertexGeometry SceneGeometry::from_view(std::int32_t vertex, glm::dvec3 view) const {
  VertexGeometry facts;
  facts.vertex = vertex;
  facts.view = view;
  facts.plane = project(view);
  facts.raster = to_viewport(facts.plane.x, facts.plane.y);
  facts.outside = outcode(view);
  return facts;
}

void SceneGeometry::find_out(std::int32_t vertex, VertexGeometry& facts) const {
  const glm::dvec3& point = scene_->points[vertex];
  if (viewed_) {
    facts = from_view(vertex, glm::dvec3(scene_->camera.view * glm::dvec4(point, 1)));
  } else {
    facts.vertex = vertex;
    facts.plane = point;
    facts.raster = {point.x, point.y};
  }
}

std::span<const std::int32_t> SceneGeometry::corners(std::int32_t facet) const {
  if (facet < 0 || facet >= std::ssize(scene_->facets)) return {};
  const Facet& found = scene_->facets[facet];
  return std::span(scene_->corners).subspan(found.first_corner, found.corner_count);
}

const FacetPlane& SceneGeometry::plane(std::int32_t facet) const {
  FacetPlane& plane = facet_planes_.at(facet);
  if (plane.facet == facet) return plane;
  const std::span<const std::int32_t> of_facet = corners(facet);
  const auto [normal, d] = formulas::plane_through(of_facet.size(), points_of(of_facet), formulas::Mean::of_sum);
  return plane = {facet, normal, d};
}

FacetPlane SceneGeometry::plane_by_parts(std::int32_t facet) const {
  const std::span<const std::int32_t> of_facet = corners(facet);
  const auto [normal, d] = formulas::plane_through(of_facet.size(), points_of(of_facet), formulas::Mean::of_parts);
  return {facet, normal, d};
}

std::vector<glm::dvec3> SceneGeometry::clipped(std::span<const std::int32_t> outline, std::int32_t outside_some) const {
  std::vector<glm::dvec3> polygon;
  for (const std::int32_t corner : outline) polygon.push_back(of_point(corner).view);
  for (std::size_t plane = 0; plane < clip_planes; ++plane) {
    if ((outside_some >> plane & 1) == 0) continue;
    std::vector<glm::dvec3> kept;  // Sutherland and Hodgman
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec3 here = polygon[i], next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
      const double at_here = distance_inside(here, plane), at_next = distance_inside(next, plane);
      if (at_here >= 0) kept.push_back(here);
      if (at_here > 0 && at_next < 0)
        kept.push_back(formulas::part_of_way(here, next, formulas::where_zero(at_here, at_next)));
      if (at_here < 0 && at_next > 0)
        kept.push_back(formulas::part_of_way(next, here, formulas::where_zero(at_next, at_here)));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

bool SceneGeometry::in_view(std::span<const std::int32_t> outline) const {
  const Outside outside = outside_of(outline);
  if (outside.some == 0 || outside.all != 0) return outside.some == 0;
  return clipped(outline, outside.some).size() >= 3;
}

SceneGeometry::Outside SceneGeometry::outside_of(std::span<const std::int32_t> outline) const {
  Outside outside{0, (1 << clip_planes) - 1};
  for (const std::int32_t corner : outline) {
    const std::int32_t of_corner = of_point(corner).outside;
    outside.some |= of_corner, outside.all &= of_corner;
  }
  return outside;
}

void SceneGeometry::number_pieces() const {
  numbered_ = true;
  const auto facets = size32(scene_->facets);
  for (std::int32_t facet = 0; facet < facets; ++facet) {
    const std::span<const std::int32_t> of_facet = corners(facet);
    if (of_facet.size() < 3) continue;
    if (viewed_) {
      const auto point = points_of(of_facet);
      const glm::dvec3 normal = formulas::newell_normal(glm::dvec3(0), of_facet.size(), point);
      const double along = glm::dot(orthographic_ ? -scene_->camera.eye : point(0) - scene_->camera.eye, normal);
      if (along == 0 || (cull_ && along > 0) || !in_view(of_facet)) continue;
    }
    facets_of_pieces_.push_back(facet);
  }
}

std::span<const std::int32_t> SceneGeometry::corners_of_piece(std::int32_t piece) const {
  if (!numbered_) number_pieces();
  if (piece < 0 || piece >= std::ssize(facets_of_pieces_)) return {};
  return corners(facets_of_pieces_[piece]);
}

bool SceneGeometry::find_out(std::int32_t piece, FacetPlane& plane) const {
  const std::span<const glm::dvec3> corners = raster_outline(piece);
  if (corners.empty()) return false;
  const auto corner = [&](std::size_t i) { return corners[i]; };
  const auto [normal, d] = formulas::plane_through(corners.size(), corner, formulas::Mean::of_parts);
  plane = {piece, normal, d};
  return true;
}

bool SceneGeometry::find_out(std::int32_t piece, PieceExtent& extent) const {
  const std::span<const glm::dvec3> corners = raster_outline(piece);
  if (corners.empty()) return false;
  extent = {piece, corners[0], corners[0]};
  for (const glm::dvec3& corner : corners)
    extent.low = glm::min(extent.low, corner), extent.high = glm::max(extent.high, corner);
  return true;
}

std::int32_t SceneGeometry::next_by_depth(std::int32_t piece) const {
  if (!numbered_) number_pieces();
  if (next_by_depth_.size() != facets_of_pieces_.size()) {
    const std::size_t count = facets_of_pieces_.size();
    std::vector<double> farthest(count);
    std::vector<std::int32_t> order(count);
    for (std::size_t i = 0; i < count; ++i) {
      order[i] = static_cast<std::int32_t>(i);
      const PieceExtent* extent = extent_of_piece(order[i]);
      const bool is_number = extent != nullptr && extent->high.z == extent->high.z;
      farthest[i] = is_number ? extent->high.z : 0;
    }
    const auto at = [](std::int32_t number) { return static_cast<std::size_t>(number); };
    const auto polygon = [&](std::int32_t number) { return scene_->facets[at(facets_of_pieces_[at(number)])].polygon; };
    std::sort(order.begin(), order.end(), [&](std::int32_t one, std::int32_t other) {
      if (farthest[at(one)] != farthest[at(other)]) return farthest[at(one)] > farthest[at(other)];
      return polygon(one) != polygon(other) ? polygon(one) > polygon(other) : one > other;
    });
    next_by_depth_.assign(count, -1);
    for (std::size_t i = 1; i < count; ++i) next_by_depth_[at(order[i - 1])] = order[i];
  }
  return piece >= 0 && piece < std::ssize(next_by_depth_) ? next_by_depth_[piece] : -1;
}

std::span<const glm::dvec3> SceneGeometry::raster_outline(std::int32_t piece) const {
  const std::span<const std::int32_t> corners = corners_of_piece(piece);
  outline_.clear();
  std::int32_t outside = 0;
  for (const std::int32_t corner : corners) {
    const VertexGeometry& facts = of_point(corner);
    outside |= facts.outside;
    outline_.emplace_back(facts.raster, facts.plane.z);
  }
  if (outside == 0) return outline_;
  outline_.clear();
  for (const glm::dvec3& view : clipped(corners, outside)) {
    const VertexGeometry made = from_view(-1, view);
    outline_.emplace_back(made.raster, made.plane.z);
  }
  return outline_;
}

bool SceneGeometry::find_out(std::int32_t piece, PieceSides& sides) const {
  const std::span<const glm::dvec3> corners = raster_outline(piece);
  if (corners.empty()) return false;
  sides.piece = piece;
  sides.count = corners.size() <= PieceSides::most ? static_cast<std::uint32_t>(corners.size()) : 0;
  for (std::size_t i = 0; i < sides.count; ++i)
    sides.sides[i] = formulas::Segment::between(corners[i], corners[i + 1 < sides.count ? i + 1 : 0]);
  return true;
}

template <class Each>
void SceneGeometry::for_each_edge(std::int32_t piece, Each&& each) const {
  const std::span<const glm::dvec3> corners = raster_outline(piece);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    TableEdge edge;
    edge.start = corners[i], edge.end = corners[i + 1 < corners.size() ? i + 1 : 0];
    if (edge.start.y > edge.end.y) std::swap(edge.start, edge.end);
    edge.piece = piece;
    if (row_from(edge.start.y, scene_->raster.height) < row_from(edge.end.y, scene_->raster.height)) each(edge);
  }
}

bool SceneGeometry::find_out(std::int32_t edge, TableEdge& known) const {
  if (!numbered_) number_pieces();
  if (first_edges_.empty()) {
    first_edges_.push_back(0);
    for (std::size_t piece = 0; piece < facets_of_pieces_.size(); ++piece) {
      std::int32_t count = 0;
      for_each_edge(static_cast<std::int32_t>(piece), [&](const TableEdge&) { ++count; });
      first_edges_.push_back(first_edges_.back() + count);
    }
  }
  const auto beyond = std::upper_bound(first_edges_.begin(), first_edges_.end(), edge);
  if (beyond == first_edges_.end()) return false;
  std::int32_t number = *(beyond - 1);
  for_each_edge(static_cast<std::int32_t>(beyond - 1 - first_edges_.begin()), [&](const TableEdge& one) {
    if (number == edge) known = one, known.edge = edge;
    ++number;
  });
  return true;
}

double SceneGeometry::tolerance() const {
  if (tolerance_ >= 0) return tolerance_;
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& point : scene_->points) low = glm::min(low, point), high = glm::max(high, point);
  const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
  tolerance_ =
      scene_->points.empty() ? 0 : 1e-9 * glm::length(high - low) + 1e-14 * std::max(far.x, std::max(far.y, far.z));
  return tolerance_;
}

}  // namespace zstep::codec
