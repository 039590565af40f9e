
#include "sim/truth/sight.hpp"
#include "traces/formulas/fill.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

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

std::optional<FacetAt> facet_at(const Scene& scene, std::int32_t facet, bool cull, std::int32_t x, std::int32_t y,
                                bool non_zero) {
  const Sight sight(scene);
  const Facet& shape = scene.facets.at(facet);
  Seen seen;
  if (!see(scene, shape, sight, cull, seen)) return std::nullopt;
  const Vec2 place(x, y);
  FacetAt found;
  found.candidate.facet = facet, found.candidate.polygon = shape.polygon;
  locate(seen, place, non_zero, found.candidate);
  measure_depth(seen, sight, place, found.candidate);
  constexpr Real nothing = 1e-12L;  // of a square whose side is 1: a point or a line that rounding moved
  found.in_square = found.candidate.covers || area_in_square(seen.outline, place) > nothing;
  return found;
}

std::optional<double> depth_on_sight(const Scene& scene, std::int32_t facet, std::int32_t x, std::int32_t y,
                                     bool non_zero) {
  const Sight sight(scene);
  const Facet& shape = scene.facets.at(facet);
  std::vector<Vec3> corners;
  Vec3 normal(0), from, along;
  for (std::int32_t i = 0; i < shape.corner_count; ++i) {
    const std::size_t corner = scene.corners[shape.first_corner + i];
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
  // Inside in the plane of the two axes that the normal leans on least.
  const Vec3 size = glm::abs(normal);
  const int drop = size.x >= size.y && size.x >= size.z ? 0
                   : size.y >= size.z                   ? 1
                                                        : 2,
            u = drop == 0 ? 1 : 0, v = drop == 2 ? 1 : 2;
  std::int32_t winding = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a[v] > point[v]) == (b[v] > point[v])) continue;
    if (a[u] + (b[u] - a[u]) * ((point[v] - a[v]) / (b[v] - a[v])) > point[u]) winding += b[v] > a[v] ? 1 : -1;
  }
  if (!formulas::is_inside(non_zero, winding)) return std::nullopt;
  return static_cast<double>(z);
}

Vec3 in_view(const Camera& camera, const glm::dvec3& world) {
  if (camera.kind == Camera::Kind::screen) return Vec3(world);
  Vec3 view;
  for (int row = 0; row < 3; ++row) {
    const auto entry = [&](int column) { return static_cast<Real>(camera.view[column][row]); };
    view[row] = entry(0) * static_cast<Real>(world.x) + entry(1) * static_cast<Real>(world.y) +
                entry(2) * static_cast<Real>(world.z) + entry(3);
  }
  return view;
}

namespace {

// What of the outline lies on one side of a depth: `sign` 1 keeps z >= depth, -1 keeps z <= depth.
std::vector<Vec3> cut_at(const std::vector<Vec3>& outline, Real depth, Real sign) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 &here = outline[i], &next = outline[(i + 1) % outline.size()];
    const Real in_here = sign * (here.z - depth), in_next = sign * (next.z - depth);
    if (in_here >= 0) kept.push_back(here);
    if ((in_here > 0 && in_next < 0) || (in_here < 0 && in_next > 0)) {
      Vec3 crossing = here + (next - here) * (in_here / (in_here - in_next));
      crossing.z = depth;
      kept.push_back(crossing);
    }
  }
  return kept;
}

}  // namespace

bool see(const Scene& scene, const Facet& facet, const Sight& sight, bool cull, Seen& seen) {
  const Camera& camera = scene.camera;
  std::vector<Vec3> corners;
  for (std::int32_t i = 0; i < facet.corner_count; ++i) {
    const std::int32_t corner = scene.corners[facet.first_corner + i];
    corners.push_back(in_view(camera, scene.points[corner]));
  }
  if (corners.size() < 3) return false;

  Vec3 normal(0), sum(0);
  Real size = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    size = std::max(size, glm::length(corners[i] - corners[0]));
    sum += corners[i];
  }
  const Real area = glm::length(normal);
  const bool flat = !(area > 1e-14L * size * size);
  seen.middle = sum / static_cast<Real>(corners.size());
  seen.normal = flat ? Vec3(0) : normal / area;
  seen.bend = 0;
  for (const Vec3& corner : corners) {
    seen.bend = std::max(seen.bend, std::fabs(glm::dot(corner - seen.middle, seen.normal)));
  }
  const Vec3 towards = sight.perspective() ? glm::normalize(seen.middle) : Vec3(0, 0, 1);
  const Real sine = glm::dot(towards, seen.normal);
  seen.edge_on = !(std::fabs(sine) > edge_on_sine);

  if (!sight.screen()) {
    if (flat) return false;
    // Counter-clockwise in the world is clockwise in view space if the view is a mirroring, as left-handed ones are.
    const bool mirroring = glm::determinant(glm::dmat3(camera.view)) < 0;
    const bool faces_eye = mirroring ? sine > 0 : sine < 0;
    if (cull && !faces_eye && !seen.edge_on) return false;
    corners = cut_at(corners, camera.near, 1);
    corners = cut_at(corners, camera.far, -1);
    if (corners.size() < 3) return false;
  }

  seen.outline.clear();
  seen.z_low = seen.z_high = corners[0].z;
  for (const Vec3& corner : corners) {
    const Vec2 place = sight.on_raster(corner);
    // A trace from elsewhere may hold a point, or a camera, that leads nowhere. The methods drop the facet, too.
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) return false;
    seen.outline.push_back(place);
    seen.z_low = std::min(seen.z_low, corner.z), seen.z_high = std::max(seen.z_high, corner.z);
  }
  return true;
}

namespace {

Real distance_to_edge(const Vec2& place, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const Real length = glm::dot(along, along);
  const Real t = length > 0 ? std::clamp(glm::dot(place - from, along) / length, Real{0}, Real{1}) : 0;
  return glm::length(place - (from + t * along));
}

}  // namespace

void locate(const Seen& seen, const Vec2& place, bool non_zero, Candidate& candidate) {
  Real nearest = std::numeric_limits<Real>::infinity();
  std::int32_t winding = 0;
  for (std::size_t i = 0; i < seen.outline.size(); ++i) {
    const Vec2 &from = seen.outline[i], &to = seen.outline[(i + 1) % seen.outline.size()];
    nearest = std::min(nearest, distance_to_edge(place, from, to));
    if ((from.y > place.y) == (to.y > place.y)) continue;
    if (from.x + (to.x - from.x) * ((place.y - from.y) / (to.y - from.y)) > place.x) winding += to.y > from.y ? 1 : -1;
  }
  candidate.covers = formulas::is_inside(non_zero, winding);
  candidate.edge = static_cast<double>(nearest);
}

void measure_depth(const Seen& seen, const Sight& sight, const Vec2& place, Candidate& candidate) {
  Vec3 from, along;
  sight.line(place, from, along);
  const Real approach = glm::dot(along, seen.normal);
  candidate.edge_on = seen.edge_on || !(std::fabs(approach) > edge_on_sine * glm::length(along));
  if (candidate.edge_on) {
    candidate.z = static_cast<double>(seen.z_low);
    candidate.slope = candidate.z_slack = 0;
    return;
  }
  const Real z = glm::dot(seen.middle - from, seen.normal) / approach;
  const Real across = glm::length(Vec2(seen.normal.x, seen.normal.y));
  candidate.slope = static_cast<double>(across * sight.pixel_at(z) / std::fabs(approach));
  candidate.z_slack = static_cast<double>(seen.bend / std::fabs(approach));
  // Beside the facet its plane may go anywhere; the facet does not.
  candidate.z = static_cast<double>(candidate.covers ? z : std::clamp(z, seen.z_low, seen.z_high));
}

}  // namespace zstep::compare
