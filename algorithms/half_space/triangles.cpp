#include "algorithms/half_space/triangles.hpp"

#include <span>

#include "traces/formulas/edge_functions.hpp"
#include "traces/scene.hpp"

namespace zstep::half_space {

namespace {

double turn(const viewing::Vertices& vertices, std::int32_t a, std::int32_t b, std::int32_t c) {
  const glm::dvec3 &p = vertices[a].raster, &q = vertices[b].raster, &r = vertices[c].raster;
  return formulas::twice_area(p.x, p.y, q.x, q.y, r.x, r.y);
}

/// Are all turns, and all triangles of the fan, the same way round? An outline that goes round more than once has
/// others in its fan.
bool is_convex(const clipping::Outline& outline, const viewing::Vertices& vertices) {
  const std::size_t n = outline.size();
  bool left = false, right = false;
  const auto look = [&](double turned) { left = left || turned > 0, right = right || turned < 0; };
  for (std::size_t i = 0; i < n; ++i) {
    look(turn(vertices, outline[i], outline[(i + 1) % n], outline[(i + 2) % n]));
    if (i > 0 && i + 1 < n) look(turn(vertices, outline[0], outline[i], outline[i + 1]));
    if (left && right) return false;
  }
  return true;
}

}  // namespace

const std::vector<Corners>& Triangulation::cut(const clipping::Outline& outline, const viewing::Vertices& vertices) {
  triangles_.clear();
  convex_ = is_convex(outline, vertices);
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
