// A scene in Embree, ready to be asked ray by ray.
#pragma once

#include <string>
#include <vector>

#include "tests/embree/intersect.hpp"
#include "traces/scene.hpp"

namespace zstep::bench {

class EmbreeRays {
 public:
  /// The scene's facets, all of them convex, as triangles. Throws std::runtime_error if Embree fails.
  explicit EmbreeRays(const Scene& scene);
  ~EmbreeRays();
  EmbreeRays(const EmbreeRays&) = delete;
  EmbreeRays& operator=(const EmbreeRays&) = delete;

  /// Writes the polygon and the t that each pixel's ray meets first. Perspective only.
  void cast(Picture& picture) const;

 private:
  const Scene& scene_;
  RTCDevice device_;
  RTCScene embree_;
  std::vector<std::int32_t> polygons_;  // by triangle
};

std::string embree_name();

}  // namespace zstep::bench
