// Triangles as three half-planes, and what is linear on them: J. Pineda, "A Parallel Algorithm for Polygon
// Rasterization", SIGGRAPH 1988; barycentric weights; the top-left rule of Foley et al., section 3.6.
#pragma once

#include <cstdint>

#include "traces/file/header.hpp"
#include "traces/formulas/coverage.hpp"

namespace zstep::formulas {

/// Twice the area of a triangle on the raster; positive where the vertices run so that all edge functions are positive
/// inside.
template <class T>
T twice_area(const T& x_0, const T& y_0, const T& x_1, const T& y_1, const T& x_2, const T& y_2) {
  return (x_1 - x_0) * (y_2 - y_0) - (x_2 - x_0) * (y_1 - y_0);
}

/// Is the first of an edge's ends the one by which its function is computed? So triangles that share an edge have
/// functions of it that are opposite to the last bit, and at both ends exactly 0.
template <class T>
bool is_first_end(const T& x_0, const T& y_0, const T& x_1, const T& y_1) {
  return y_0 < y_1 || (y_0 == y_1 && x_0 <= x_1);
}

/// E(x, y) of the edge with these A and B through (X, Y).
template <class T>
T edge_value(const T& a, const T& b, const T& x, const T& end_x, const T& y, const T& end_y) {
  return a * (x - end_x) + b * (y - end_y);
}
/// C in E(x, y) = A x + B y + C.
template <class T>
T edge_constant(const T& a, const T& b, const T& end_x, const T& end_y) {
  return -(a * end_x + b * end_y);
}

/// The side of a tile, in pixels. Where E is stepped it is computed anew at the corner of each tile of the raster, so
/// that triangles that share an edge add the same numbers.
inline constexpr std::int32_t tile_side = 8;
constexpr std::int32_t tile_start(std::int32_t pixel) { return pixel - pixel % tile_side; }

/// E at a pixel's centre, by B from line to line and by A from pixel to pixel.
template <class T>
T edge_value_stepped(const T& a, const T& b, std::int32_t x, const T& end_x, std::int32_t y, const T& end_y) {
  T e = edge_value(a, b, T(static_cast<double>(tile_start(x))), end_x, T(static_cast<double>(tile_start(y))), end_y);
  for (std::int32_t row = tile_start(y); row < y; ++row) e = e + b;
  for (std::int32_t column = tile_start(x); column < x; ++column) e = e + a;
  return e;
}

/// The first column, or row, of a bounding box, and the one just beyond it, within the raster.
inline std::int32_t box_first(double least, std::int32_t size) { return row_from(least, size); }
inline std::int32_t box_end(double greatest, std::int32_t size) {
  if (!(greatest >= 0)) return 0;
  return greatest >= size ? size : floor_int(greatest) + 1;
}

/// A centre on the line belongs to the triangle to the right of it, or below.
inline bool owns_line(double a, double b) { return a > 0 || (a == 0 && b > 0); }
inline bool is_on_side(double e, bool owns) { return e > 0 || (e == 0 && owns); }

/// What is linear on a triangle, from its values at the vertices: w_0 p_0 + w_1 p_1 + w_2 p_2. As w_0 is 1 - w_1 - w_2
/// but for rounding, it is computed from vertex 0, so that what is the same at all vertices is so at each pixel.
template <class T>
T by_weights(const T& p_0, const T& w_1, const T& p_1, const T& w_2, const T& p_2) {
  return p_0 + (w_1 * (p_1 - p_0) + w_2 * (p_2 - p_0));
}

/// Are edge functions added to from pixel to pixel, rather than computed at each?
inline bool steps_edges(const Conventions& conventions) {
  const auto stepping = conventions.options.find("stepping");
  return stepping != conventions.options.end() && stepping->second == "increments";
}

}  // namespace zstep::formulas
