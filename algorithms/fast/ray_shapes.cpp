#include "algorithms/fast/ray_shapes.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "algorithms/ray_casting/geometry.hpp"

namespace zstep::ray_casting {

namespace {

// Whether the triangles (0, i, i + 1) cover the facet, each place once: seen from the first corner, the others follow
// each other within half a turn.
bool is_fan(const Target& target) {
  const std::vector<glm::dvec3>& corners = target.corners;
  const glm::dvec3 normal = target.plane.normal(), first = corners[1] - corners[0];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const glm::dvec3 here = corners[i] - corners[0], next = corners[i + 1] - corners[0];
    if (glm::dot(glm::cross(here, next), normal) < 0) return false;
    if (glm::dot(glm::cross(first, next), normal) < 0) return false;
  }
  return true;
}

Shape shape_around(const Target& target, std::initializer_list<glm::dvec3> corners) {
  Shape shape{};
  shape.facet = target.facet;
  shape.n = target.plane.normal(), shape.n_0 = target.plane.d;
  shape.u_0 = shape.v_0 = 0.25;  // inside, whatever the point
  shape.low = shape.high = *corners.begin();
  for (const glm::dvec3 corner : corners)
    shape.low = glm::min(shape.low, corner), shape.high = glm::max(shape.high, corner);
  return shape;
}

// `scale`: how large coordinates are. A triangle so narrow that rounding tells in its barycentric coordinates is met
// wherever its plane is.
void add_triangle(std::vector<Shape>& shapes, const Target& target, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c,
                  double scale) {
  Shape shape = shape_around(target, {a, b, c});
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double square = glm::dot(n, n);
  const glm::dvec3 u = glm::cross(c - a, n) / square, v = glm::cross(n, b - a) / square;
  if (std::max(glm::length(u), glm::length(v)) * scale < 1e5) {
    shape.u = u, shape.u_0 = -glm::dot(u, a);
    shape.v = v, shape.v_0 = -glm::dot(v, a);
  }
  shapes.push_back(shape);
}

}  // namespace

std::vector<Shape> shapes_of(const Scene& scene) {
  double scale = glm::length(scene.camera.eye);
  for (const glm::dvec3& point : scene.points) scale = std::max(scale, glm::length(point));
  std::vector<Shape> shapes;
  shapes.reserve(scene.corners.size());
  for (std::int32_t n = 0; n < static_cast<std::int32_t>(scene.facets.size()); ++n) {
    const Target target = target_of(scene, n);
    if (!can_be_met(scene, target)) continue;
    const std::vector<glm::dvec3>& corners = target.corners;
    if (is_fan(target)) {
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        add_triangle(shapes, target, corners[0], corners[i], corners[i + 1], scale);
      }
    } else {
      Shape shape = shape_around(target, {corners[0]});
      for (const glm::dvec3& corner : corners) {
        shape.low = glm::min(shape.low, corner), shape.high = glm::max(shape.high, corner);
      }
      shapes.push_back(shape);
    }
  }
  return shapes;
}

}  // namespace zstep::ray_casting
