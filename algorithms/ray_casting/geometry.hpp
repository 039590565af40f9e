// Rays in the world, and where they meet facets.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "algorithms/pieces/plane.hpp"
#include "algorithms/viewing/camera.hpp"
#include "traces/scene.hpp"

namespace zstep::ray_casting {

/// X = X_0 + t dX (002). A ray from the eye has t = 0 at the centre of projection and t = 1 on the projection plane;
/// parallel rays count t = z_v, those of a screen scene its z.
struct Ray {
  glm::dvec3 from, along;  ///< X_0 and dX, world
  double t_least, t_most;  ///< what lies before or beyond is not met: near and far plane

  glm::dvec3 at(double t) const { return from + t * along; }
};

/// The rays through the centres of a picture's pixels.
class EyeRays {
 public:
  EyeRays(const Scene& scene, Conventions::Depth depth);
  Ray through(std::int32_t x, std::int32_t y) const;
  /// The number that a depth buffer holds for a point of such a ray.
  double depth(double t) const;

 private:
  viewing::Lens lens_;
  bool screen_;
  glm::dvec3 eye_, right_, up_, away_;  // the axes of viewing coordinates in the world
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

/// Where a ray meets a plane: t = -(A X_0 + B Y_0 + C Z_0 + D)/(A dX + B dY + C dZ), NaN where it runs along it: where
/// the sine of the angle between them is that of a facet seen edge-on.
struct Crossing {
  double numerator, denominator, t;
};
inline Crossing cross(const Ray& ray, const pieces::Plane& plane) {
  const double numerator = -plane.value(ray.from);
  const double denominator = plane.a * ray.along.x + plane.b * ray.along.y + plane.c * ray.along.z;
  constexpr double edge_on_sine = 1e-12;  // the plane's normal has length 1
  const bool along = denominator * denominator <= edge_on_sine * edge_on_sine * glm::dot(ray.along, ray.along);
  return {numerator, denominator, along ? std::numeric_limits<double>::quiet_NaN() : numerator / denominator};
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
