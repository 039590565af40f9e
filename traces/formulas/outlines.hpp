// What follows from the corners of a polygon: its normal, its plane, and where other things lie to that (001, 003).
// Templates for the reason in lines.hpp: V is any type of vector with `cross`.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "traces/events/pieces.hpp"
#include "traces/formulas/planes.hpp"

namespace zstep::formulas {

/// A sine below this is rounding: what has it is seen edge-on, or runs along a plane.
inline constexpr double edge_on_sine = 1e-12;

/// Newell's normal, as long as twice the area (M. E. Newell, after Sutherland, Sproull and Schumacker, "A
/// Characterization of Ten Hidden-Surface Algorithms", 1974): from 0, over corner(0), … of `count`.
template <class V, class Corner>
V newell_normal(V zero, std::size_t count, const Corner& corner) {
  if (count < 3) return zero;
  const V first = corner(0);
  V normal = zero;
  for (std::size_t i = 1; i + 1 < count; ++i) normal = normal + cross(corner(i) - first, corner(i + 1) - first);
  return normal;
}
/// The same about the origin, and not about the first corner.
template <class V, class Corner>
V newell_about_origin(V zero, std::size_t count, const Corner& corner) {
  V normal = zero;
  for (std::size_t i = 0; i < count; ++i) normal = normal + cross(corner(i), corner(i + 1 < count ? i + 1 : 0));
  return normal;
}
/// Its third component alone.
template <class T, class X, class Y>
T newell_z(T zero, std::size_t count, const X& x, const Y& y) {
  T normal_z = zero;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = i + 1 < count ? i + 1 : 0;
    normal_z = normal_z + (x(i) * y(next) - x(next) * y(i));
  }
  return normal_z;
}

/// A plane whose normal has length 1; all zero where an outline encloses no area.
struct UnitPlane {
  glm::dvec3 normal{0};
  double d = 0;
};
/// How the mean of corners is found that a plane goes through: each divided by their number, or their sum.
enum class Mean { of_parts, of_sum };
template <class Corner>
UnitPlane plane_through(std::size_t count, const Corner& corner, Mean mean) {
  if (count < 3) return {};
  glm::dvec3 normal = newell_normal(glm::dvec3(0), count, corner), middle(0);
  const double length = glm::length(normal), corners = static_cast<double>(count);
  if (!(length > 0)) return {};
  normal /= length;
  for (std::size_t i = 0; i < count; ++i) middle += mean == Mean::of_parts ? corner(i) / corners : corner(i);
  return {normal, -glm::dot(normal, mean == Mean::of_parts ? middle : middle / corners)};
}

/// The plane of a piece.
template <class T = double>
T plane_value(const PlaneEquation& plane, const glm::dvec3& at) {
  return plane_value<T>(plane.plane_a, plane.plane_b, plane.plane_c, plane.plane_d, at.x, at.y, at.z);
}
inline double plane_depth(const PlaneEquation& plane, double x, double y) {
  return plane_depth(plane.plane_a, plane.plane_b, plane.plane_c, plane.plane_d, x, y);
}

/// The point at t, of the way from p_0 (t = 0) to p_1 (t = 1).
inline glm::dvec3 part_of_way(const glm::dvec3& p_0, const glm::dvec3& p_1, double t) { return p_0 + t * (p_1 - p_0); }

/// Where something lies whose values of a plane go from `least` to `greatest`.
inline Side side_of(double least, double greatest, double tolerance) {
  const bool behind = least<-tolerance, front = greatest> tolerance;
  return behind ? (front ? Side::crossing : Side::behind) : front ? Side::front : Side::on;
}

/// Where a ray X_0 + t dX meets a plane (002): t = -(A X_0 + B Y_0 + C Z_0 + D)/(A dX + B dY + C dZ), NaN where it runs
/// along it. The normal has length 1.
struct RayCrossing {
  double numerator, denominator, t;
};
inline RayCrossing ray_crossing(glm::dvec3 from, glm::dvec3 along, glm::dvec3 normal, double d) {
  const double numerator = -plane_value(normal.x, normal.y, normal.z, d, from.x, from.y, from.z);
  const double denominator = glm::dot(normal, along);
  const bool runs_along = denominator * denominator <= edge_on_sine * edge_on_sine * glm::dot(along, along);
  return {numerator, denominator, runs_along ? std::numeric_limits<double>::quiet_NaN() : numerator / denominator};
}

}  // namespace zstep::formulas
