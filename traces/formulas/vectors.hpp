// Points and directions of any type of number, and the planes of polygons by their corners. Products and sums are made
// in the order in which GLM makes them, so that with doubles they agree with the engine to the bit.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::formulas {

template <class T>
struct Vector {
  T x, y, z;
};
template <class T>
Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vector<T> operator+(const Vector<T>& a, const Vector<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

/// The fields that hold a vertex at one stage of its way to the raster.
using Stage = std::array<std::string_view, 3>;
inline constexpr Stage world_stage{"x_w", "y_w", "z_w"}, view_stage{"x_v", "y_v", "z_v"},
    raster_stage{"x_s", "y_s", "z"};

/// The three operands x, y and z of a point: "x_0", "y_0", "z_0" with the suffix "_0".
template <class Out>
Vector<typename Out::Number> vector_of(Out& out, std::string_view suffix, const glm::dvec3& value, const Place& place,
                                       const Stage& stage) {
  const std::string end(suffix);
  return {out.number("x" + end, value.x, place[stage[0]]), out.number("y" + end, value.y, place[stage[1]]),
          out.number("z" + end, value.z, place[stage[2]])};
}

// The plane of a polygon by its corners: Newell's normal, through their mean. Programs make it of any length and either
// way round; that does not make it another plane.

inline Vector<Rounded> rounded(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
inline Vector<Rounded> operator*(const Vector<Rounded>& v, Rounded factor) {
  return {v.x * factor, v.y * factor, v.z * factor};
}

template <class T>
T length_of(const Vector<T>& v) {
  using std::sqrt;
  return sqrt(dot(v, v));
}
/// D of the plane that has this normal and goes through the mean of corner(0), … of `count`.
template <class T, class Corner>
T d_through_mean(const Vector<T>& normal, std::size_t count, const Corner& corner, const T& corners) {
  Vector<T> sum{T(0.0), T(0.0), T(0.0)};
  for (std::size_t i = 0; i < count; ++i) sum = sum + corner(i);
  return -dot(normal, Vector<T>{sum.x / corners, sum.y / corners, sum.z / corners});
}

struct CornersPlane {
  Vector<Rounded> normal;  ///< of length 1
  Rounded d;
  double length = 0;  ///< of Newell's sum, twice the area

  /// As it would be where this is its normal: as long, and the same way round.
  CornersPlane as_long_as(const glm::dvec3& recorded) const {
    const double along = recorded.x * normal.x.value + recorded.y * normal.y.value + recorded.z * normal.z.value;
    const double size = std::sqrt(recorded.x * recorded.x + recorded.y * recorded.y + recorded.z * recorded.z);
    return times(along < 0 ? -1 : 1, size);
  }
  /// The same of a number that is as large as the normal.
  CornersPlane times(double sign, double size) const {
    constexpr double near = 1e-3;
    const double factor = sign * (std::abs(size - 1) < near                 ? 1
                                  : std::abs(size - length) < near * length ? length
                                                                            : size);
    const Rounded by(factor, 0);
    return {normal * by, d * by, length};
  }
};

/// corner(i) of `count` corners; nothing where they enclose no area.
template <class Corner>
std::optional<CornersPlane> plane_of_corners(std::size_t count, Corner&& corner) {
  if (count < 3) return std::nullopt;
  const Vector<Rounded> none{0.0, 0.0, 0.0};
  const auto corner_at = [&](std::size_t i) { return rounded(corner(i)); };
  const Vector<Rounded> sum = newell_normal(none, count, corner_at);
  const Rounded length = length_of(sum);
  if (!(length.value > 0)) return std::nullopt;
  CornersPlane plane{{sum.x / length, sum.y / length, sum.z / length}, {}, length.value};
  plane.d = d_through_mean(plane.normal, count, corner_at, Rounded(static_cast<double>(count), 0));
  return plane;
}

/// Of what a number may be, the one that is nearest to what is recorded.
inline Rounded nearest_of(double recorded, std::span<const Rounded> all) {
  const Rounded* best = &all.front();
  for (const Rounded& one : all)
    if (one.value == recorded || std::abs(one.value - recorded) < std::abs(best->value - recorded)) best = &one;
  return *best;
}
inline Rounded nearest_of(double recorded, std::initializer_list<Rounded> all) {
  return nearest_of(recorded, std::span(all.begin(), all.size()));
}

}  // namespace zstep::formulas
