// Where the rays from the eye meet facets, in fractions: from the scene's points and the camera.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "traces/oracle/exact_geometry.hpp"
#include "traces/scene.hpp"

namespace zstep::oracle {

/// The number in the depth buffer for a point at z_v; in a screen scene z itself.
Rational depth_of_view(const Camera& camera, Conventions::Depth depth, const Rational& z_v);

class ExactRays {
 public:
  ExactRays(const Scene& scene, Conventions::Depth depth) : scene_(scene), depth_(depth) {}

  /// t of the ray through a pixel's centre in a facet's plane, Newell's through the mean of its corners; nothing where
  /// it has none or the ray runs along it.
  std::optional<Rational> meet(std::int32_t facet, std::int32_t x, std::int32_t y);
  /// The depth of such a point.
  Rational depth(const Rational& t) const;

 private:
  struct Ray {
    std::int32_t x = -1, y = -1;
    Point from, along;
  };
  const Ray& ray(std::int32_t x, std::int32_t y);
  const std::optional<Plane>& plane(std::int32_t facet);

  const Scene& scene_;
  Conventions::Depth depth_;
  Ray ray_;  ///< the last one
  std::map<std::int32_t, std::optional<Plane>> planes_;
};

}  // namespace zstep::oracle
