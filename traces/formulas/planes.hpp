// Planes: A x + B y + C z + D (001, 002), and the depth that one has at a pixel. Templates for the reason in lines.hpp.
#pragma once

namespace zstep::formulas {

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

}  // namespace zstep::formulas
