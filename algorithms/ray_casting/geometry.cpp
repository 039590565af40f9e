#include "algorithms/ray_casting/geometry.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>

#include "algorithms/viewing/back_face.hpp"

namespace zstep::ray_casting {

EyeRays::EyeRays(const Scene& scene, Conventions::Depth depth)
    : rays_(scene.camera, scene.raster),
      lens_(scene.camera, scene.raster, depth),
      screen_(scene.camera.kind == Camera::Kind::screen) {}

Ray EyeRays::through(std::int32_t x, std::int32_t y) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto [from, along] = rays_.through(x, y);
  if (screen_) return {from, along, -infinity, infinity};
  const double unit = lens_.orthographic ? 1 : lens_.d;
  return {from, along, lens_.near / unit, lens_.far / unit};
}

double EyeRays::depth(double t) const {
  if (screen_) return t;
  return lens_.project({0, 0, lens_.orthographic ? t : t * lens_.d}).z;
}

namespace {

// A polygon that crosses itself may enclose as much one way round as the other. Its plane is then that of the corner
// where it turns most.
pieces::Plane plane_of_crossing(std::span<const glm::dvec3> corners) {
  glm::dvec3 normal(0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 here = corners[i], next = corners[(i + 1) % corners.size()],
                     last = corners[(i + 2) % corners.size()];
    const glm::dvec3 turn = glm::cross(next - here, last - next);
    if (glm::dot(turn, turn) > glm::dot(normal, normal)) normal = turn;
  }
  if (normal == glm::dvec3(0)) return {};
  normal = glm::normalize(normal);
  return {normal.x, normal.y, normal.z, -glm::dot(normal, corners[0])};
}

}  // namespace

Target target_of(const Scene& scene, std::int32_t facet) {
  const Facet& entry = scene.facets[facet];
  Target target{facet, {}, {}};
  for (std::int32_t i = 0; i < entry.corner_count; ++i) {
    const std::int32_t corner = scene.corners[entry.first_corner + i];
    target.corners.push_back(scene.points[corner]);
  }
  if (target.corners.size() < 3) return target;
  // The mean is added up before it is divided: facets at z = 5 get planes at 5, and not one beside it.
  const auto corner = [&](std::size_t i) { return target.corners[i]; };
  const auto [normal, d] = formulas::plane_through(target.corners.size(), corner, formulas::Mean::of_sum);
  target.plane = {normal.x, normal.y, normal.z, d};
  if (target.plane.normal() == glm::dvec3(0)) target.plane = plane_of_crossing(target.corners);
  return target;
}

bool can_be_met(const Scene& scene, const Target& target) {
  for (const glm::dvec3& corner : target.corners) {
    if (!std::isfinite(corner.x + corner.y + corner.z)) return false;
  }
  if (target.plane.normal() == glm::dvec3(0)) return false;
  if (scene.camera.kind == Camera::Kind::screen) return true;
  const Facet& entry = scene.facets[target.facet];
  const auto corners = std::span(scene.corners).subspan(entry.first_corner, entry.corner_count);
  return !clipping::degenerate(scene, corners);
}

AlongRay::AlongRay(const Ray& ray) : from_(ray.from) {
  const glm::dvec3 size = glm::abs(ray.along);
  axis_ = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
  axis_x_ = (axis_ + 1) % 3, axis_y_ = (axis_ + 2) % 3;
  slope_x_ = ray.along[axis_x_] / ray.along[axis_], slope_y_ = ray.along[axis_y_] / ray.along[axis_];
}

glm::dvec2 AlongRay::project(glm::dvec3 point) const {
  const glm::dvec3 away = point - from_;
  return {away[axis_x_] - slope_x_ * away[axis_], away[axis_y_] - slope_y_ * away[axis_]};
}

bool passes_inside(const AlongRay& along, std::span<const glm::dvec3> corners) {
  bool inside = false;
  glm::dvec2 last = along.project(corners.back());
  for (const glm::dvec3& corner : corners) {
    const glm::dvec2 next = along.project(corner);
    glm::dvec2 from = last, to = next;
    if (to.y < from.y) std::swap(from, to);
    const bool beside = from.y <= 0 && 0 < to.y;
    if (beside && from.x + (to.x - from.x) * (0 - from.y) / (to.y - from.y) <= 0) inside = !inside;
    last = next;
  }
  return inside;
}

}  // namespace zstep::ray_casting
