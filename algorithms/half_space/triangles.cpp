#include "algorithms/half_space/triangles.hpp"

#include <span>

#include "traces/formulas/edge_functions.hpp"
#include "traces/scene.hpp"

namespace zstep::half_space {

const std::vector<Corners>& Triangulation::cut(const clipping::Outline& outline, const viewing::Vertices& vertices) {
  triangles_.clear();
  convex_ = is_convex(outline.size(), [&](std::size_t i) { return glm::dvec2(vertices[outline[i]].raster); });
  std::vector<std::int32_t> ears;
  if (!convex_) {
    std::vector<glm::dvec3> points;
    std::vector<std::int32_t> corners;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec3& raster = vertices[outline[i]].raster;
      points.emplace_back(raster.x, raster.y, 0);
      corners.push_back(index32(i));
    }
    clipper_.cut(points, corners, ears);
  }
  for (std::size_t i = 0; i < ears.size(); i += 3)
    triangles_.push_back({outline[ears[i]], outline[ears[i + 1]], outline[ears[i + 2]]});
  // Where cutting ears takes too long a fan covers each pixel as often, but for an even number of times.
  if (ears.empty())
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) triangles_.push_back({outline[0], outline[i], outline[i + 1]});
  return triangles_;
}

}  // namespace zstep::half_space
