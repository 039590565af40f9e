// Fixed-point depths: N bits hold 2ᴺ numbers, 0 for the least depth that there can be and 2ᴺ − 1 for the greatest.
// depth_unit() is how far apart they are.
#pragma once

#include "traces/scene.hpp"

namespace zstep::formulas {

/// The greatest number that a depth of the format can be, 2ᴺ − 1; 0 where the format is floating point.
constexpr double greatest_number(NumberFormat format) {
  return static_cast<double>((std::uint64_t{1} << bits_of(format)) - 1);
}

/// What fixed-point depths are counted from: the least one between the near plane and the far one; in a screen scene,
/// the least z of its points. depth_range() is the distance from it to the greatest.
double least_depth(const Scene& scene, Conventions::Depth depth);

}  // namespace zstep::formulas
