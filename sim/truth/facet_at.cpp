#include "sim/truth/facet_at.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/truth/sight.hpp"

namespace zstep::compare {

namespace {

/// What of an outline lies on one side of an upright or a level line: sign·p[axis] <= limit.
std::vector<Vec2> cut_off(const std::vector<Vec2>& outline, int axis, Real sign, Real limit) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &from = outline[i], &to = outline[(i + 1) % outline.size()];
    const Real one = limit - sign * from[axis], other = limit - sign * to[axis];
    if (one >= 0) kept.push_back(from);
    if ((one > 0 && other < 0) || (one < 0 && other > 0)) kept.push_back(from + one / (one - other) * (to - from));
  }
  return kept;
}

/// Of the pixel's square, how much an outline covers. Where it is not convex, parts of it hang together by lines, which
/// have no area.
Real area_in_square(std::vector<Vec2> outline, const Vec2& place) {
  for (int axis = 0; axis < 2; ++axis)
    for (const Real sign : {-1.0L, 1.0L}) outline = cut_off(outline, axis, sign, sign * place[axis] + 0.5L);
  Real twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - place, b = outline[(i + 1) % outline.size()] - place;
    twice += a.x * b.y - b.x * a.y;
  }
  return std::fabs(twice) / 2;
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
  constexpr Real nothing = 1e-12L;  // of a square whose side is 1: a point or a line that rounding moved
  found.in_square = found.candidate.covers || area_in_square(seen.outline, place) > nothing;
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
