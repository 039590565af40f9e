#include "sim/compare/truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

namespace zstep::compare {

namespace {

using Real = long double;
using Vec2 = glm::vec<2, Real>;
using Vec3 = glm::vec<3, Real>;

constexpr Real edge_on_sine = 1e-9L;  // below: rounding decides which way a facet faces, and what its plane says

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

// Where lines of sight and the raster meet. Pixel centres are at integers, row 0 on top.
struct Sight {
  const Camera& camera;
  Real half_x, half_y, width, height;

  explicit Sight(const Scene& scene)
      : camera(scene.camera), half_y(scene.camera.window), width(scene.raster.width), height(scene.raster.height) {
    half_x = half_y * width / height;
  }
  bool screen() const { return camera.kind == Camera::Kind::screen; }
  bool perspective() const { return camera.kind == Camera::Kind::perspective; }

  Vec2 on_raster(const Vec3& view) const {
    if (screen()) return {view.x, view.y};
    const Real shrink = perspective() ? static_cast<Real>(camera.d) / view.z : 1;
    return {(view.x * shrink / half_x + 1) / 2 * width - 0.5L, (1 - view.y * shrink / half_y) / 2 * height - 0.5L};
  }
  // A point of the line of sight, and how it moves for z growing by one: at depth z it is from + z * along.
  void line(const Vec2& raster, Vec3& from, Vec3& along) const {
    from = {raster.x, raster.y, 0}, along = {0, 0, 1};
    if (screen()) return;
    const Real x_p = ((raster.x + 0.5L) / width * 2 - 1) * half_x, y_p = (1 - (raster.y + 0.5L) / height * 2) * half_y;
    from = perspective() ? Vec3(0) : Vec3(x_p, y_p, 0);
    if (perspective()) along = {x_p / static_cast<Real>(camera.d), y_p / static_cast<Real>(camera.d), 1};
  }
  // How far the line of sight moves sideways at depth z when the raster's point moves by one pixel.
  Real pixel_at(Real z) const {
    if (screen()) return 1;
    const Real pixel = 2 * half_y / height;
    return perspective() ? pixel * std::fabs(z) / static_cast<Real>(camera.d) : pixel;
  }
};

struct Seen {
  std::vector<Vec2> outline;  // on the raster
  Vec3 middle, normal;        // its plane, in view space; unit normal, 0 if there is none
  Real bend = 0;              // the largest distance of a corner from it
  Real z_low = 0, z_high = 0;
  bool edge_on = false;
};

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

// A facet as it is seen; false if nothing of it may be drawn.
bool see(const Scene& scene, const Facet& facet, const Sight& sight, bool cull, Seen& seen) {
  const Camera& camera = scene.camera;
  std::vector<Vec3> corners;
  for (std::int32_t i = 0; i < facet.corner_count; ++i) {
    const std::int32_t corner = scene.corners[static_cast<std::size_t>(facet.first_corner + i)];
    corners.push_back(in_view(camera, scene.points[static_cast<std::size_t>(corner)]));
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
    seen.outline.push_back(sight.on_raster(corner));
    seen.z_low = std::min(seen.z_low, corner.z), seen.z_high = std::max(seen.z_high, corner.z);
  }
  return true;
}

Real distance_to_edge(const Vec2& place, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const Real length = glm::dot(along, along);
  const Real t = length > 0 ? std::clamp(glm::dot(place - from, along) / length, Real{0}, Real{1}) : 0;
  return glm::length(place - (from + t * along));
}

// Inside by the even-odd rule, and how far from the nearest edge.
void locate(const Seen& seen, const Vec2& place, Candidate& candidate) {
  Real nearest = std::numeric_limits<Real>::infinity();
  bool inside = false;
  for (std::size_t i = 0; i < seen.outline.size(); ++i) {
    const Vec2 &from = seen.outline[i], &to = seen.outline[(i + 1) % seen.outline.size()];
    nearest = std::min(nearest, distance_to_edge(place, from, to));
    if ((from.y > place.y) == (to.y > place.y)) continue;
    if (from.x + (to.x - from.x) * ((place.y - from.y) / (to.y - from.y)) > place.x) inside = !inside;
  }
  candidate.covers = inside;
  candidate.edge = static_cast<double>(nearest);
}

// The depth of the facet's plane on the line of sight.
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

// The pixels from `low` to `high`, widened by the tolerance, of `count`.
void rows_between(Real low, Real high, std::int32_t count, std::int32_t& first, std::int32_t& last) {
  const Real most = static_cast<Real>(count - 1), reach = edge_tolerance;
  first = static_cast<std::int32_t>(std::clamp(std::ceil(low - reach), Real{0}, most + 1));
  last = static_cast<std::int32_t>(std::clamp(std::floor(high + reach), Real{-1}, most));
}

}  // namespace

Truth::Truth(const Scene& scene, bool cull, std::span<const std::uint8_t> wanted)
    : width_(scene.raster.width),
      height_(scene.raster.height),
      place_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), -1) {
  std::int32_t places = 0;
  for (std::size_t pixel = 0; pixel < place_.size(); ++pixel) {
    if (wanted.empty() || wanted[pixel] != 0) place_[pixel] = places++;
  }
  candidates_.resize(static_cast<std::size_t>(places));
  const Sight sight(scene);
  Seen seen;
  for (std::size_t k = 0; k < scene.facets.size(); ++k) {
    if (!see(scene, scene.facets[k], sight, cull, seen)) continue;
    Vec2 low = seen.outline[0], high = low;
    for (const Vec2& corner : seen.outline) low = glm::min(low, corner), high = glm::max(high, corner);
    std::int32_t left = 0, right = 0, top = 0, bottom = 0;
    rows_between(low.x, high.x, width_, left, right);
    rows_between(low.y, high.y, height_, top, bottom);

    Candidate candidate;
    candidate.facet = static_cast<std::int32_t>(k), candidate.polygon = scene.facets[k].polygon;
    for (std::int32_t y = top; y <= bottom; ++y) {
      for (std::int32_t x = left; x <= right; ++x) {
        const std::int32_t slot =
            place_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
        if (slot < 0) continue;
        const Vec2 place(x, y);
        locate(seen, place, candidate);
        if (!candidate.covers && candidate.edge > edge_tolerance) continue;
        measure_depth(seen, sight, place, candidate);
        candidates_[static_cast<std::size_t>(slot)].push_back(candidate);
      }
    }
  }
  for (std::vector<Candidate>& here : candidates_) {
    std::stable_sort(here.begin(), here.end(), [](const Candidate& a, const Candidate& b) { return a.z < b.z; });
  }
}

std::span<const Candidate> Truth::at(std::int32_t x, std::int32_t y) const {
  const std::int32_t slot =
      place_.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  return candidates_.at(static_cast<std::size_t>(slot));
}

std::int32_t Truth::nearest(std::int32_t x, std::int32_t y) const {
  for (const Candidate& candidate : at(x, y)) {
    if (candidate.covers) return candidate.polygon;
  }
  return no_polygon;
}

namespace {

// Does a stretch have a point with |x - place.x| <= 1/2 and |y - place.y| <= 1/2?
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
    found.in_square = found.in_square || enters_square(seen.outline[i], seen.outline[(i + 1) % seen.outline.size()], place);
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
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  sight.line(Vec2(x, y), from, along);
  const Real approach = glm::dot(along, normal);
  if (!(std::fabs(approach) > edge_on_sine * glm::length(along) * glm::length(normal))) return std::nullopt;
  const Real z = glm::dot(corners[0] - from, normal) / approach;
  const Vec3 point = from + z * along;
  // Inside by the even-odd rule, in the plane of the two axes that the normal leans on least.
  const Vec3 size = glm::abs(normal);
  const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2, u = drop == 0 ? 1 : 0, v = drop == 2 ? 1 : 2;
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
