#include "sim/truth/facet_at.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/truth/sight.hpp"

namespace zstep::compare {

namespace {

// Does an interval have a point with |x - place.x| <= 1/2 and |y - place.y| <= 1/2?
bool enters_square(const Vec2& from, const Vec2& to, const Vec2& place) {
  Real first = 0, last = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const Real start = from[axis] - place[axis], along = to[axis] - from[axis];
    if (along == 0 && std::fabs(start) > 0.5L) return false;
    if (along == 0) continue;
    const Real one = (-0.5L - start) / along, other = (0.5L - start) / along;
    first = std::max(first, std::min(one, other)), last = std::min(last, std::max(one, other));
  }
  return first <= last;
}

}  // namespace

std::optional<FacetAt> facet_at(const Scene& scene, std::int32_t facet, bool cull, std::int32_t x, std::int32_t y) {
  const Sight sight(scene);
  const Facet& shape = scene.facets.at(static_cast<std::size_t>(facet));
  Seen seen;
  if (!see(scene, shape, sight, cull, seen)) return std::nullopt;
  const Vec2 place(x, y);
  FacetAt found;
  found.candidate.facet = facet, found.candidate.polygon = shape.polygon;
  locate(seen, place, found.candidate);
  measure_depth(seen, sight, place, found.candidate);
  found.in_square = found.candidate.covers;
  for (std::size_t i = 0; i < seen.outline.size(); ++i)
    found.in_square =
        found.in_square || enters_square(seen.outline[i], seen.outline[(i + 1) % seen.outline.size()], place);
  return found;
}

std::optional<double> depth_on_sight(const Scene& scene, std::int32_t facet, std::int32_t x, std::int32_t y) {
  const Sight sight(scene);
  const Facet& shape = scene.facets.at(static_cast<std::size_t>(facet));
  std::vector<Vec3> corners;
  Vec3 normal(0), from, along;
  for (std::int32_t i = 0; i < shape.corner_count; ++i) {
    const auto corner = static_cast<std::size_t>(scene.corners[static_cast<std::size_t>(shape.first_corner + i)]);
    corners.push_back(in_view(scene.camera, scene.points[corner]));
  }
  if (corners.size() < 3) return std::nullopt;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  sight.line(Vec2(x, y), from, along);
  const Real approach = glm::dot(along, normal);
  if (!(std::fabs(approach) > edge_on_sine * glm::length(along) * glm::length(normal))) return std::nullopt;
  const Real z = glm::dot(corners[0] - from, normal) / approach;
  const Vec3 point = from + z * along;
  // Inside by the even-odd rule, in the plane of the two axes that the normal leans on least.
  const Vec3 size = glm::abs(normal);
  const int drop = size.x >= size.y && size.x >= size.z ? 0
                   : size.y >= size.z                   ? 1
                                                        : 2,
            u = drop == 0 ? 1 : 0, v = drop == 2 ? 1 : 2;
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a[v] > point[v]) == (b[v] > point[v])) continue;
    if (a[u] + (b[u] - a[u]) * ((point[v] - a[v]) / (b[v] - a[v])) > point[u]) inside = !inside;
  }
  if (!inside) return std::nullopt;
  return static_cast<double>(z);
}

}  // namespace zstep::compare
