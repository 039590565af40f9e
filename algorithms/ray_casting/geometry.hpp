// Rays in the world, and where they meet facets.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "algorithms/pieces/pieces.hpp"
#include "algorithms/viewing/camera.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/scene.hpp"

namespace zstep::ray_casting {

/// X = X_0 + t dX (002).
struct Ray {
  glm::dvec3 from, along;  ///< X_0 and dX, world
  double t_least, t_most;  ///< what lies before or beyond is not met: near and far plane

  glm::dvec3 at(double t) const { return from + t * along; }
};

/// The rays through the centres of a picture's pixels, from the near to the far plane.
class EyeRays {
 public:
  EyeRays(const Scene& scene, Conventions::Depth depth);
  Ray through(std::int32_t x, std::int32_t y) const;
  /// The number that a depth buffer holds for a point of such a ray.
  double depth(double t) const;

 private:
  formulas::EyeRays rays_;
  viewing::Lens lens_;
  bool screen_;
};

/// A facet's plane, all zero if it has none, and its corners; in the world.
struct Target {
  std::int32_t facet;
  pieces::Plane plane;
  std::vector<glm::dvec3> corners;
};

Target target_of(const Scene& scene, std::int32_t facet);

/// Is there a plane, and does the facet count? As everywhere, a facet in space that encloses no area is dropped, while
/// a screen scene's facets are taken as they are.
bool can_be_met(const Scene& scene, const Target& target);

/// Where a ray meets a plane, NaN where it runs along it: where the sine of the angle between them is that of a facet
/// seen edge-on.
using Crossing = formulas::RayCrossing;
inline Crossing cross(const Ray& ray, const pieces::Plane& plane) {
  return formulas::ray_crossing(ray.from, ray.along, plane.normal(), plane.d);
}

/// Points as they are seen along a ray: the coordinate along which it runs fastest is projected away, and the ray is
/// the origin.
class AlongRay {
 public:
  explicit AlongRay(const Ray& ray);
  glm::dvec2 project(glm::dvec3 point) const;

 private:
  glm::dvec3 from_;
  int axis_, axis_x_, axis_y_;
  double slope_x_, slope_y_;
};

/// Does the ray pass inside the outline? By the even-odd rule; edges are taken from the end with the smaller y to the
/// other, so that of two facets which share an edge a ray meets exactly one there.
bool passes_inside(const AlongRay& along, std::span<const glm::dvec3> corners);

}  // namespace zstep::ray_casting
