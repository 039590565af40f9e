// Lines, planes and outlines: what is linear between two ends, a plane's depth, what follows from the corners of a
// polygon (its normal, its plane, where other things lie to that) and how it lies to a rectangle of the picture (000 to
// 003). V is any type of vector with `cross`.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "traces/events/areas.hpp"
#include "traces/events/pieces.hpp"

namespace zstep::formulas {

// What is linear between two ends: x and z along an edge, z along a span (000, "Double interpolation").
//
// Each formula stands here once, for any type of number: the engine and the codec evaluate it with double, in this
// order, so that they agree to the bit; the words evaluate it with a number that remembers how it was made, and print
// that.

/// p at q on the line from (q_0, p_0) to (q_1, p_1).
template <class T>
T on_line(const T& p_0, const T& p_1, const T& q, const T& q_0, const T& q_1) {
  return p_0 + (p_1 - p_0) * (q - q_0) / (q_1 - q_0);
}

/// What p gains there where q gains 1.
template <class T>
T slope(const T& p_0, const T& p_1, const T& q_0, const T& q_1) {
  return (p_1 - p_0) / (q_1 - q_0);
}

/// How far along from 0 to 1 a value that is d_0 at 0 and d_1 at 1 becomes 0.
template <class T>
T where_zero(const T& d_0, const T& d_1) {
  return d_0 / (d_0 - d_1);
}

/// p at t, of the way from p_0 (t = 0) to p_1 (t = 1).
template <class T>
T part_of_way(const T& p_0, const T& p_1, const T& t) {
  return p_0 + t * (p_1 - p_0);
}

// Planes: A x + B y + C z + D (001, 002), and the depth that one has at a pixel.

/// The plane's value at a point: its distance times the length of the normal, with a sign.
template <class T>
T plane_value(const T& a, const T& b, const T& c, const T& d, const T& x, const T& y, const T& z) {
  return a * x + b * y + c * z + d;
}

/// The depth of a plane at (x, y).
template <class T>
T plane_depth(const T& a, const T& b, const T& c, const T& d, const T& x, const T& y) {
  return -(a * x + b * y + d) / c;
}

/// What depth gains on a plane where one coordinate p of the raster grows by 1 and the other, q, stays: -A/C along x,
/// -B/C along y (004), from the differences of two of the plane's vertices to a third.
template <class T>
T plane_slope(const T& q_1, const T& z_1, const T& q_2, const T& z_2, const T& p_1, const T& p_2) {
  return (z_1 * q_2 - z_2 * q_1) / (p_1 * q_2 - p_2 * q_1);
}

/// The depth at (x, y) from that of the vertex at (x_0, y_0).
template <class T>
T along_plane(const T& z_0, const T& dz_dx, const T& x, const T& x_0, const T& dz_dy, const T& y, const T& y_0) {
  return z_0 + (dz_dx * (x - x_0) + dz_dy * (y - y_0));
}

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

/// Has an outline of `count` corners its lowest point, or one of several, at this corner, also where that is a
/// horizontal edge? y goes down; y(i) is that of a corner, nothing where it is not known. Nothing where rounding may
/// decide.
template <class Y>
std::optional<bool> turns_down(std::size_t count, std::size_t corner, const Y& y) {
  constexpr double as_high = 1e-6;  // of itself, as float32 has it
  const std::optional<double> here = y(corner);
  if (!here) return std::nullopt;
  for (const std::size_t way : {std::size_t{1}, count - 1}) {
    std::size_t beside = 1;
    std::optional<double> other = y((corner + way) % count);
    while (other && *other == *here && ++beside < count) other = y((corner + beside * way) % count);
    if (!other || std::abs(*other - *here) <= as_high * (std::abs(*here) + 1)) return std::nullopt;
    if (*other > *here) return false;
  }
  return true;
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

// How an outline lies to a rectangle of the picture (002, "Warnock's Algorithm"): for the method, for the codec that
// foretells it and for those who judge it.

/// A side of an outline, from its end with the smaller y, so that polygons that share it compute the same bits.
struct Segment {
  glm::dvec2 start{0}, end{0};

  static Segment between(glm::dvec2 a, glm::dvec2 b) { return a.y > b.y ? Segment{b, a} : Segment{a, b}; }
  bool meets_row(double y) const { return start.y <= y && y < end.y; }
  double x_at(double y) const { return on_line(start.x, end.x, y, start.y, end.y); }
};

struct Rectangle {
  glm::dvec2 low, high;

  bool holds(glm::dvec2 p) const { return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y; }
  bool is_apart(glm::dvec2 other_low, glm::dvec2 other_high) const {
    return other_high.x < low.x || other_low.x > high.x || other_high.y < low.y || other_low.y > high.y;
  }
  /// A segment meets it unless its extents are apart from it or it lies on one side of the segment's line.
  bool meets(const Segment& segment) const {
    const glm::dvec2 &start = segment.start, &end = segment.end;
    if (is_apart({std::min(start.x, end.x), start.y}, {std::max(start.x, end.x), end.y})) return false;
    if (holds(start) || holds(end)) return true;
    const glm::dvec2 along = end - start;
    const auto side = [&](double x, double y) { return along.x * (y - start.y) - along.y * (x - start.x); };
    const double a = side(low.x, low.y), b = side(high.x, low.y), c = side(low.x, high.y), d = side(high.x, high.y);
    return std::min({a, b, c, d}) <= 0 && std::max({a, b, c, d}) >= 0;
  }
};

/// The squares around the centres of an area's pixels; or reaching otherwise before the first and after the last one.
template <class Area>
Rectangle rectangle_of(const Area& area, double before = 0.5, double after = 0.5) {
  return {{area.first_column - before, area.first_row - before},
          {area.end_column - 1 + after, area.end_row - 1 + after}};
}

/// Is the point in it? Even-odd rule; of edges, the left and upper ones count.
inline bool covers(std::span<const Segment> outline, double x, double y) {
  bool inside = false;
  for (const Segment& segment : outline)
    if (segment.meets_row(y) && segment.x_at(y) <= x) inside = !inside;
  return inside;
}

struct Crossed {
  Bin bin = Bin::disjoint;
  std::int32_t crossings = 0, corners_inside = 0;
  bool operator==(const Crossed&) const = default;
};
inline Crossed crossed_by(const Rectangle& area, std::span<const Segment> outline) {
  Crossed crossed;
  bool all_inside = true;
  for (const Segment& segment : outline) {
    crossed.crossings += area.meets(segment);
    all_inside = all_inside && area.holds(segment.start) && area.holds(segment.end);
  }
  if (crossed.crossings == 0) {  // no edge comes between any two points of the area, so one of them speaks for all
    const glm::dvec2 middle = (area.low + area.high) * 0.5;
    if (covers(outline, middle.x, middle.y)) crossed = {Bin::surrounding, 0, 4};
    return crossed;
  }
  for (const double x : {area.low.x, area.high.x})
    for (const double y : {area.low.y, area.high.y}) crossed.corners_inside += covers(outline, x, y);
  crossed.bin = all_inside ? Bin::contained : Bin::intersecting;
  return crossed;
}

}  // namespace zstep::formulas
