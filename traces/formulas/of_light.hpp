// Where rays begin and go: from the eye, to the light, mirrored and bent (002, "Simple Ray Tracing"); and what a
// polygon keeps of its colour in shadow.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "traces/formulas/of_rays.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/vectors.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

// How light goes on where it meets a face, and what a polygon keeps of its colour in shadow. Templates for the reason
// in outlines.hpp.

/// How much of its colour a polygon keeps in shadow.
inline constexpr double in_shadow = 0.4;

/// How much of its colour a polygon keeps where this share of the light reaches it; `left` in shadow.
template <class T>
T kept_of_color(const T& left, const T& share) {
  return left + (T(1) - left) * share;
}

/// A channel of a colour of this opacity that is laid over another one.
template <class T>
T laid_over(const T& opacity, const T& over, const T& under) {
  return opacity * over + (T(1) - opacity) * under;
}

inline double value_of(double number) { return number; }
inline double value_of(const Rounded& number) { return number.value; }

/// The mirrored direction R = D - 2 (D·N) N; N of length 1, on either side.
template <class T>
Vector<T> mirrored(const Vector<T>& along, const Vector<T>& normal) {
  const T twice = T(2) * dot(along, normal);
  return {along.x - twice * normal.x, along.y - twice * normal.y, along.z - twice * normal.z};
}

/// The direction T behind a face, by Snell's law sin a_2 = r sin a_1 with r = n_1/n_2; D and N of length 1. Nothing
/// where light cannot leave: sin a_2 would be greater than 1 (total reflection).
template <class T>
std::optional<Vector<T>> refracted(const Vector<T>& along, Vector<T> normal, const T& ratio) {
  using std::sqrt;
  if (value_of(dot(along, normal)) > 0) normal = {-normal.x, -normal.y, -normal.z};  // to where the light comes from
  const T cosine = -dot(along, normal);
  const T square = T(1) - ratio * ratio * (T(1) - cosine * cosine);  // of the cosine behind the face
  if (value_of(square) < 0) return std::nullopt;
  const T back = ratio * cosine - sqrt(square);
  return Vector<T>{ratio * along.x + back * normal.x, ratio * along.y + back * normal.y,
                   ratio * along.z + back * normal.z};
}
template <class T>
std::optional<Vector<T>> refracted(const Vector<T>& along, const Vector<T>& normal, const T& n_1, const T& n_2) {
  return refracted(along, normal, T(n_1 / n_2));
}

namespace detail {

/// Where a ray begins and goes.
struct Course {
  Vector<Rounded> from, way;
};
/// What it is made of lets each coordinate be off by as much as the largest one.
inline Vector<Rounded> evenly(const glm::dvec3& v, double more = 0) {
  const double spread = 4 * std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) + more;
  return {Rounded(v.x, spread), Rounded(v.y, spread), Rounded(v.z, spread)};
}
inline double product(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline glm::dvec3 recorded_way(const RayBegin& e) { return {e.dir_x, e.dir_y, e.dir_z}; }

/// A length is the program's own where it is not nearly the formula's.
inline double factor_of_length(const glm::dvec3& recorded, const glm::dvec3& way) {
  constexpr double near = 1e-3;
  const double longer = std::sqrt(product(recorded, recorded) / product(way, way));
  return std::abs(longer - 1) < near || !std::isfinite(longer) ? 1 : longer;
}

/// From the eye through the centre of the pixel. How long its direction is and where on it t = 0 is the program's own.
inline Course course_from_eye(const RayBegin& e, const Situation& at) {
  auto [from, way] = EyeRays(*at.camera, at.scene.raster).through(e.x, e.y);
  constexpr double near = 1e-3;
  const double ahead = product(glm::dvec3(e.x_0, e.y_0, e.z_0) - from, way) / product(way, way);
  if (std::abs(ahead) > near) from += ahead * way;
  return {evenly(from), evenly(factor_of_length(recorded_way(e), way) * way)};
}

/// Where the light goes on from a facet: mirrored, or bent by Snell's law.
inline std::optional<Vector<Rounded>> way_on(const RayBegin& e, const RayBegin& parent, const Situation& at,
                                             std::int32_t facet) {
  const auto corners = corners_of(at, facet);
  const auto plane = plane_of_corners(corners.size(), [&](std::size_t i) { return corner_at(at, corners[i]); });
  if (!plane) return std::nullopt;
  const Vector<Rounded> full{parent.dir_x, parent.dir_y, parent.dir_z};
  const Rounded length = sqrt(dot(full, full));
  const Vector<Rounded> along{full.x / length, full.y / length, full.z / length};
  if (e.role == RayRole::reflected) return mirrored(along, plane->normal);
  const std::size_t polygon = at.scene.facets[facet].polygon;
  const Rounded outside(1, 0), inside(at.scene.polygons[polygon].material->refraction, 0);
  const bool entering = dot(along, plane->normal).value < 0;
  return refracted(along, plane->normal, entering ? outside : inside, entering ? inside : outside);
}

/// Calls use(facet) for each facet on which a point may lie.
template <class Use>
void for_each_facet_at(const Situation& at, const glm::dvec3& p, Use&& use) {
  for (std::size_t number = 0; number < at.scene.facets.size(); ++number) {
    const auto facet = index32(number);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinity), high(-infinity);
    for (const std::int32_t corner : corners_of(at, facet))
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], corner_at(at, corner)[axis]);
        high[axis] = std::max(high[axis], corner_at(at, corner)[axis]);
      }
    // A facet is not quite flat, and its plane is met.
    constexpr double flat = 1e-4;
    const double beside = flat * std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const auto inside = [&](int axis) { return lies_in(p[axis], low[axis] - beside, high[axis] + beside); };
    if (inside(0) && inside(1) && inside(2)) use(facet);
  }
}

/// A ray that another one casts. The facet that it comes from is the one that the other one met; once rays to the light
/// were cast in between, one on which it begins (of large scenes nothing is said then).
inline std::optional<Course> course_from_facet(const RayBegin& e, const Situation& at) {
  const RayWork& rays = at.method().rays;
  const auto parent = std::lower_bound(rays.tree.begin(), rays.tree.end(), e.parent,
                                       [](const RayRow& row, std::int32_t ray) { return row.entry.ray < ray; });
  if (parent == rays.tree.end() || parent->entry.ray != e.parent) return std::nullopt;
  const auto brother = std::find_if(parent, rays.tree.end(), [&](const RayRow& row) {
    return row.entry.parent == e.parent && row.entry.role != RayRole::eye;
  });
  const RayHit* hit = parent + 1 == rays.tree.end() ? kept_hit(at) : nullptr;
  if (brother == rays.tree.end() && !hit) return std::nullopt;
  const glm::dvec3 from = hit ? glm::dvec3(hit->x_hit, hit->y_hit, hit->z_hit)
                              : glm::dvec3(brother->entry.x_0, brother->entry.y_0, brother->entry.z_0);
  Course course{evenly(from), evenly(recorded_way(e))};
  if (e.role == RayRole::shadow) {
    if (at.scene.light) course.way = evenly(at.scene.light->position - from, course.from.x.spread);
    return course;
  }
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](std::int32_t facet) {
    const auto way = way_on(e, parent->entry, at, facet);
    if (!way) return;
    const glm::dvec3 value(way->x.value, way->y.value, way->z.value);
    const double factor = factor_of_length(recorded_way(e), value);
    const glm::dvec3 off = factor * value - recorded_way(e);
    if (!(product(off, off) < least)) return;
    least = product(off, off);
    course.way = *way * Rounded(factor, 0);
  };
  constexpr std::size_t most_facets = 1000;
  if (hit) take(hit->facet);
  else if (at.scene.facets.size() <= most_facets) for_each_facet_at(at, from, take);
  return course;
}

}  // namespace detail

template <class Out>
void derive(const RayBegin& e, const Situation& at, Out& out) {
  const RayWork& rays = at.method().rays;
  out.rule(Rule::number_is_next, e.ray == (rays.tree.empty() ? 0 : rays.tree.back().entry.ray + 1));
  const bool from_eye = e.role == RayRole::eye;
  if (from_eye && !at.camera) return;
  const auto course = from_eye ? std::optional(detail::course_from_eye(e, at)) : detail::course_from_facet(e, at);
  if (!course) return;
  out.near(&RayBegin::x_0, course->from.x), out.near(&RayBegin::y_0, course->from.y);
  out.near(&RayBegin::z_0, course->from.z), out.near(&RayBegin::dir_x, course->way.x);
  out.near(&RayBegin::dir_y, course->way.y), out.near(&RayBegin::dir_z, course->way.z);
}

}  // namespace zstep::formulas
