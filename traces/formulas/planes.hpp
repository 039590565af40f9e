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

}  // namespace zstep::formulas
