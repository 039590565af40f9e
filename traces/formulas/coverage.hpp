// Which pixels lie between two edges, and which scan lines an edge meets (000; the top-left rule of Foley et al.,
// section 3.6). Templates for the reason in lines.hpp.
#pragma once

#include <cmath>
#include <cstdint>

#include "traces/file/header.hpp"

namespace zstep::formulas {

/// The first pixel at or right of x_L.
template <class T>
T first_pixel(const T& x_left) {
  using std::ceil;
  return ceil(x_left);
}

/// The last one before x_R; with inclusive coverage, at or before it.
template <class T>
T last_pixel(const T& x_right, Conventions::Coverage coverage) {
  using std::ceil, std::floor;
  return coverage == Conventions::Coverage::inclusive ? floor(x_right) : ceil(x_right) - T(1);
}

/// The coverage that gives a recorded whole number: the one that is declared, unless none is and only the other one
/// gives it.
template <class Gives>
Conventions::Coverage coverage_of(const Header& header, const Gives& gives) {
  using enum Conventions::Coverage;
  const Conventions::Coverage usual = header.conventions.coverage, other = usual == inclusive ? top_left : inclusive;
  return !header.declares(Convention::coverage) && !gives(usual) && gives(other) ? other : usual;
}

/// The first scan line that an edge meets whose upper end is at y_0.
template <class T>
T first_row(const T& y_0) {
  using std::ceil;
  return ceil(y_0);
}

/// The scan line at which an edge leaves whose lower end is at y_1. `past_end`: with inclusive coverage an edge goes on
/// through scan line y_1 itself where its polygon has its lowest point; elsewhere the next edge begins on it.
template <class T>
T end_row(const T& y_1, bool past_end) {
  using std::ceil, std::floor;
  return past_end ? floor(y_1) + T(1) : ceil(y_1);
}

/// May an edge that ends on a scan line go on through it?
inline bool may_include_end(const Header& header) {
  return header.conventions.coverage == Conventions::Coverage::inclusive || !header.declares(Convention::coverage);
}

/// A whole number as a column, limited to -1 … width.
inline std::int32_t limited_column(double whole, std::int32_t width) {
  if (!(whole > -1)) return -1;
  if (whole >= width) return width;
  return static_cast<std::int32_t>(whole);
}

/// The first row at or below y, limited to the raster.
inline std::int32_t row_from(double y, std::int32_t height) {
  if (!(y > 0)) return 0;
  if (y >= height) return height;
  return static_cast<std::int32_t>(std::ceil(y));
}

}  // namespace zstep::formulas
