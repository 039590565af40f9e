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

std::int32_t Facts::outcode(glm::dvec3 view) const {
  const double x_c = orthographic_ ? view.x / window_x_ : d_ * view.x / window_x_;
  const double y_c = orthographic_ ? view.y / window_y_ : d_ * view.y / window_y_;
  const double w_c = orthographic_ ? 1 : view.z;
  const double inside[] = {view.z - near_, far_ - view.z, w_c + x_c, w_c - x_c, w_c + y_c, w_c - y_c};
  std::int32_t outside = 0;
  for (int plane = 0; plane < 6; ++plane) outside |= static_cast<std::int32_t>(!(inside[plane] >= 0)) << plane;
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

FacetPlane Facts::plane_by_parts(std::int32_t facet) const {
  FacetPlane plane{facet, glm::dvec3(0), 0};
  const std::span<const std::int32_t> of_facet = corners(facet);
  if (of_facet.size() < 3) return plane;
  const auto point = [&](std::size_t i) { return scene_->points[static_cast<std::size_t>(of_facet[i])]; };
  const glm::dvec3 first = point(0);
  glm::dvec3 normal(0), mean(0);
  for (std::size_t i = 0; i < of_facet.size(); ++i) {
    normal += glm::cross(point(i) - first, point(i + 1 < of_facet.size() ? i + 1 : 0) - first);
    mean += point(i) / static_cast<double>(of_facet.size());
  }
  const double length = glm::length(normal);
  if (!(length > 0)) return plane;
  plane.normal = normal / length;
  plane.d = -glm::dot(plane.normal, mean);
  return plane;
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
