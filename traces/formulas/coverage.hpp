// Which pixels lie between two edges, and which scan lines an edge meets (000; the top-left rule of Foley et al.,
// section 3.6). Templates for the reason in outlines.hpp.
#pragma once

#include <cmath>
#include <cstdint>

#include "traces/file/header.hpp"
#include "traces/math/whole.hpp"

namespace zstep::formulas {

/// x to the nearest whole number, halves upwards: the textbook's floor(x + 0.5).
template <class T>
T to_nearest(const T& x) {
  using std::floor;
  return floor(x + T(0.5));
}

/// The nearest of the places that vertices may have on the raster.
template <class T>
T snapped(const T& x, Conventions::Positions positions) {
  const int parts = parts_of_pixel(positions);
  return parts == 0 ? x : parts == 1 ? to_nearest(x) : to_nearest(x * T(parts)) / T(parts);
}

/// Does coverage along a scan line go by the pixels nearest to its ends?
inline bool rounds(Conventions::Coverage coverage) {
  return coverage == Conventions::Coverage::round || coverage == Conventions::Coverage::round_half_open;
}

/// The first pixel at or right of x_L; with coverage `round`, half-open or not, the nearest.
template <class T>
T first_pixel(const T& x_left, Conventions::Coverage coverage) {
  using std::ceil;
  return rounds(coverage) ? to_nearest(x_left) : ceil(x_left);
}

/// The last one before x_R; with inclusive coverage and ceil–floor, at or before it; with `round`, the nearest, or the
/// one before that.
template <class T>
T last_pixel(const T& x_right, Conventions::Coverage coverage) {
  using std::ceil, std::floor;
  switch (coverage) {
    case Conventions::Coverage::top_left:
      break;
    case Conventions::Coverage::round:
      return to_nearest(x_right);
    case Conventions::Coverage::round_half_open:
      return to_nearest(x_right) - T(1);
    case Conventions::Coverage::inclusive:
    case Conventions::Coverage::ceil_floor:
      return floor(x_right);
  }
  return ceil(x_right) - T(1);
}

/// The coverage that gives recorded whole numbers: the one that is declared, unless none is and only another one gives
/// them.
template <class Gives>
Conventions::Coverage coverage_of(const Header& header, const Gives& gives) {
  const Conventions::Coverage usual = header.conventions.coverage;
  if (header.declares(Convention::coverage) || gives(usual)) return usual;
  using enum Conventions::Coverage;
  for (const Conventions::Coverage other : {top_left, inclusive, round, round_half_open})
    if (gives(other)) return other;
  return usual;
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
  return ceil_int(y);
}

}  // namespace zstep::formulas
