// Boxes around facets, the cells of a grid, and where a ray comes to their sides (002, "Simple Ray Tracing"). Templates
// for the reason in lines.hpp.
#pragma once

namespace zstep::formulas {

/// A side of the box around a coordinate, which reaches somewhat farther.
template <class T>
T side_of_box(const T& p, const T& pad, bool low) {
  return low ? p - pad : p + pad;
}

/// The side between the k-th cell and the one before, of `cells` from `low` to `high`.
template <class T>
T side_of_cells(const T& low, const T& high, const T& k, const T& cells) {
  return low + (high - low) * k / cells;
}

/// t where a ray comes to a side.
template <class T>
T ray_at_side(const T& side, const T& from, const T& along) {
  return (side - from) / along;
}

}  // namespace zstep::formulas
