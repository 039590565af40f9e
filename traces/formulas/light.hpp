// How light goes on where it meets a face, and what a polygon keeps of its colour in shadow. Templates for the reason
// in lines.hpp.
#pragma once

#include <cmath>
#include <optional>

#include "traces/formulas/rounding.hpp"
#include "traces/formulas/vectors.hpp"

namespace zstep::formulas {

/// How much of its colour a polygon keeps in shadow.
inline constexpr double in_shadow = 0.4;

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

}  // namespace zstep::formulas
