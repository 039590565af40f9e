#include "traces/codec/facts.hpp"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace zstep::codec {

namespace {
constexpr std::size_t vertices_at_hand = 2048, planes_at_hand = 16384;  // powers of two
}

Facts::Facts(const Scene& scene, const Conventions& conventions)
    : scene_(&scene),
      increments_(conventions.interpolation == Conventions::Interpolation::increments),
      inclusive_(conventions.coverage == Conventions::Coverage::inclusive),
      cull_(conventions.cull),
      viewed_(scene.camera.kind != Camera::Kind::screen),
      orthographic_(scene.camera.kind == Camera::Kind::orthographic),
      view_depth_(conventions.depth == Conventions::Depth::view),
      d_(scene.camera.d),
      window_x_(scene.camera.window * scene.raster.width / scene.raster.height),
      window_y_(scene.camera.window),
      near_(scene.camera.near),
      far_(scene.camera.far),
      a_(-(near_ + far_) / (near_ * (near_ - far_))),
      b_(2 * far_ / (near_ - far_)),
      width_(scene.raster.width),
      height_(scene.raster.height) {}

glm::dvec3 Facts::project(glm::dvec3 view) const {
  if (orthographic_) return {view.x, view.y, view_depth_ ? view.z : 2 * (view.z - near_) / (far_ - near_) - 1};
  return {d_ * view.x / view.z, d_ * view.y / view.z, view_depth_ ? view.z : near_ * (a_ * view.z + b_) / view.z};
}

glm::dvec2 Facts::to_viewport(double x_p, double y_p) const {
  return {(x_p + window_x_) / (2 * window_x_) * width_ - 0.5, (window_y_ - y_p) / (2 * window_y_) * height_ - 0.5};
}

std::array<double, 6> Facts::distances_inside(glm::dvec3 view) const {
  const double x_c = orthographic_ ? view.x / window_x_ : d_ * view.x / window_x_;
  const double y_c = orthographic_ ? view.y / window_y_ : d_ * view.y / window_y_;
  const double w_c = orthographic_ ? 1 : view.z;
  return {view.z - near_, far_ - view.z, w_c + x_c, w_c - x_c, w_c + y_c, w_c - y_c};
}

std::int32_t Facts::outcode(glm::dvec3 view) const {
  const std::array<double, 6> inside = distances_inside(view);
  std::int32_t outside = 0;
  for (std::size_t plane = 0; plane < 6; ++plane) outside |= static_cast<std::int32_t>(!(inside[plane] >= 0)) << plane;
  return outside;
}

VertexFacts Facts::from_view(std::int32_t vertex, glm::dvec3 view) const {
  VertexFacts facts;
  facts.vertex = vertex;
  facts.view = view;
  facts.plane = project(view);
  facts.raster = to_viewport(facts.plane.x, facts.plane.y);
  facts.outside = outcode(view);
  return facts;
}

const VertexFacts& Facts::of_point(std::int32_t vertex) const {
  if (at_hand_.empty()) at_hand_.resize(vertices_at_hand);
  VertexFacts& facts = at_hand_[static_cast<std::size_t>(vertex) % vertices_at_hand];
  if (facts.vertex == vertex) return facts;
  const glm::dvec3& point = scene_->points[static_cast<std::size_t>(vertex)];
  if (viewed_) {
    facts = from_view(vertex, glm::dvec3(scene_->camera.view * glm::dvec4(point, 1)));
  } else {
    facts.vertex = vertex;
    facts.plane = point;
    facts.raster = {point.x, point.y};
  }
  return facts;
}

std::span<const std::int32_t> Facts::corners(std::int32_t facet) const {
  if (facet < 0 || static_cast<std::size_t>(facet) >= scene_->facets.size()) return {};
  const Facet& found = scene_->facets[static_cast<std::size_t>(facet)];
  return std::span(scene_->corners).subspan(static_cast<std::size_t>(found.first_corner), static_cast<std::size_t>(found.corner_count));
}

const FacetPlane& Facts::plane(std::int32_t facet) const {
  if (planes_at_hand_.empty()) planes_at_hand_.resize(planes_at_hand);
  FacetPlane& plane = planes_at_hand_[static_cast<std::size_t>(facet) % planes_at_hand];
  if (plane.facet == facet) return plane;
  plane = {facet, glm::dvec3(0), 0};
  const std::span<const std::int32_t> of_facet = corners(facet);
  if (of_facet.size() < 3) return plane;
  const auto point = [&](std::size_t i) { return scene_->points[static_cast<std::size_t>(of_facet[i])]; };
  const glm::dvec3 first = point(0);
  glm::dvec3 normal(0), sum(0);
  for (std::size_t i = 0; i < of_facet.size(); ++i) {
    normal += glm::cross(point(i) - first, point(i + 1 < of_facet.size() ? i + 1 : 0) - first);
    sum += point(i);
  }
  const double length = glm::length(normal);
  if (!(length > 0)) return plane;
  plane.normal = normal / length;
  plane.d = -glm::dot(plane.normal, sum / static_cast<double>(of_facet.size()));
  return plane;
}

namespace {

FacetPlane plane_through(std::int32_t number, std::size_t count, const auto& corner) {
  FacetPlane plane{number, glm::dvec3(0), 0};
  if (count < 3) return plane;
  const glm::dvec3 first = corner(0);
  glm::dvec3 normal(0), mean(0);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 here = corner(i);
    normal += glm::cross(here - first, corner(i + 1 < count ? i + 1 : 0) - first);
    mean += here / static_cast<double>(count);
  }
  const double length = glm::length(normal);
  if (!(length > 0)) return plane;
  plane.normal = normal / length;
  plane.d = -glm::dot(plane.normal, mean);
  return plane;
}

}  // namespace

FacetPlane Facts::plane_by_parts(std::int32_t facet) const {
  const std::span<const std::int32_t> of_facet = corners(facet);
  return plane_through(facet, of_facet.size(), [&](std::size_t i) { return scene_->points[static_cast<std::size_t>(of_facet[i])]; });
}

bool Facts::in_view(std::span<const std::int32_t> outline) const {
  std::int32_t outside_some = 0, outside_all = (1 << 6) - 1;
  std::vector<glm::dvec3> polygon;
  for (const std::int32_t corner : outline) {
    const VertexFacts& facts = of_point(corner);
    outside_some |= facts.outside, outside_all &= facts.outside;
    polygon.push_back(facts.view);
  }
  if (outside_some == 0 || outside_all != 0) return outside_some == 0;
  for (std::size_t plane = 0; plane < 6; ++plane) {
    if ((outside_some >> plane & 1) == 0) continue;
    std::vector<glm::dvec3> kept;  // Sutherland and Hodgman
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec3 here = polygon[i], next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
      const double at_here = distances_inside(here)[plane], at_next = distances_inside(next)[plane];
      if (at_here >= 0) kept.push_back(here);
      if (at_here > 0 && at_next < 0) kept.push_back(here + at_here / (at_here - at_next) * (next - here));
      if (at_here < 0 && at_next > 0) kept.push_back(next + at_next / (at_next - at_here) * (here - next));
    }
    polygon = std::move(kept);
  }
  return polygon.size() >= 3;
}

void Facts::number_pieces() const {
  numbered_ = true;
  const auto facets = static_cast<std::int32_t>(scene_->facets.size());
  for (std::int32_t facet = 0; facet < facets; ++facet) {
    const std::span<const std::int32_t> of_facet = corners(facet);
    if (of_facet.size() < 3) continue;
    if (viewed_) {
      const auto point = [&](std::size_t i) { return scene_->points[static_cast<std::size_t>(of_facet[i])]; };
      const glm::dvec3 first = point(0);
      glm::dvec3 normal(0);
      for (std::size_t i = 0; i < of_facet.size(); ++i) normal += glm::cross(point(i) - first, point(i + 1 < of_facet.size() ? i + 1 : 0) - first);
      const double along = glm::dot(orthographic_ ? -scene_->camera.eye : first - scene_->camera.eye, normal);
      if (along == 0 || (cull_ && along > 0) || !in_view(of_facet)) continue;
    }
    facets_of_pieces_.push_back(facet);
  }
}

const RasterPiece* Facts::piece(std::int32_t number) const {
  if (!numbered_) number_pieces();
  if (number < 0 || static_cast<std::size_t>(number) >= facets_of_pieces_.size()) return nullptr;
  if (pieces_at_hand_.empty()) pieces_at_hand_.resize(planes_at_hand);
  RasterPiece& piece = pieces_at_hand_[static_cast<std::size_t>(number) % planes_at_hand];
  if (piece.piece == number) return &piece;
  const std::span<const std::int32_t> of_facet = corners(facets_of_pieces_[static_cast<std::size_t>(number)]);
  const auto corner = [&](std::size_t i) {
    const VertexFacts& facts = of_point(of_facet[i]);
    return glm::dvec3(facts.raster, facts.plane.z);
  };
  piece.piece = number;
  piece.plane = plane_through(number, of_facet.size(), corner);
  for (std::size_t i = 0; i < of_facet.size(); ++i) {
    const glm::dvec3 here = corner(i);
    piece.low = i == 0 ? here : glm::min(piece.low, here);
    piece.high = i == 0 ? here : glm::max(piece.high, here);
  }
  return &piece;
}

double Facts::tolerance() const {
  if (tolerance_ >= 0) return tolerance_;
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& point : scene_->points) low = glm::min(low, point), high = glm::max(high, point);
  const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
  tolerance_ = scene_->points.empty() ? 0 : 1e-9 * glm::length(high - low) + 1e-14 * std::max(far.x, std::max(far.y, far.z));
  return tolerance_;
}

}  // namespace zstep::codec
