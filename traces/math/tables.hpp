// The values of elementary functions at the 64ths, and what finds the nearest of them.
#pragma once

#include <array>
#include <cmath>

#include "traces/math/kernels.hpp"

namespace zstep::portable {

inline constexpr int parts = 64;
inline constexpr double log2_of_e = 0x1.71547652b82fep+0;
// ln 2 in parts of 42 bits: a whole number of 11 bits times one is exact.
inline constexpr double ln_2[3] = {0x1.62e42fefa3800p-1, 0x1.ef35793c76000p-45, 0x1.cc01f97b57a08p-87};

inline int nearest_whole(double value) { return static_cast<int>(value < 0 ? value - 0.5 : value + 0.5); }

/// A number as a power of two and a factor between the roots of one half and of two.
struct Scaled {
  double mantissa = 1;
  int exponent = 0;
};
inline Scaled near_one(double x) {
  Scaled s;
  s.mantissa = std::frexp(x, &s.exponent);
  if (s.mantissa < 0x1.6a09e667f3bcdp-1) s.mantissa *= 2, --s.exponent;
  return s;
}

struct AtParts {
  std::array<SineCosine, 52> turn;           // 0 … pi / 4
  std::array<DoubleDouble, 47> exponential;  // -23 … 23
  std::array<DoubleDouble, 92> logarithm;    // 45 … 91
  std::array<DoubleDouble, 65> arc_tangent;  // 0 … 1
  AtParts();
};
const AtParts& at_parts();

}  // namespace zstep::portable
