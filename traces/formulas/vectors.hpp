// Points and directions of any type of number. Products and sums are made in the order in which GLM makes them, so that
// with doubles they agree with the engine to the bit.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

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

}  // namespace zstep::formulas
