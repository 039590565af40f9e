// Points and directions of any type of number. Products and sums are made in the order in which GLM makes them, so that
// with doubles they agree with the engine to the bit.
#pragma once

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

/// The three operands x, y and z of a point: "x_0", "y_0", "z_0" with the suffix "_0".
template <class Out>
Vector<typename Out::Number> vector_of(Out& out, std::string_view suffix, const glm::dvec3& value, const Place& place) {
  const std::string end(suffix);
  return {out.number("x" + end, value.x, place), out.number("y" + end, value.y, place),
          out.number("z" + end, value.z, place)};
}

}  // namespace zstep::formulas
