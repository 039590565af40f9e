// Elementary functions a first time: in double-double only what leads, the rest in double. An error below 2^-64 leaves
// the last bit open once in a thousand times; then kernels.hpp has it, at several times the price.
#pragma once

#include <optional>

#include "traces/math/double_double.hpp"

namespace zstep::portable {

inline constexpr double quick_error = 0x1p-64;  ///< of what is found here, relative to it

/// The double that a value rounds to, if that is the same one wherever the true value lies within its error.
inline std::optional<double> if_certain(DoubleDouble value, double relative_error = quick_error) {
  const double error = relative_error * value.high;
  const double one = value.high + (value.low - error), other = value.high + (value.low + error);
  if (one != other) return std::nullopt;
  return one;
}

std::optional<double> quick_sine(double x, int quarters);                   ///< of x and so many quarter turns
std::optional<double> quick_exponential(DoubleDouble x, double error = 0);  ///< the error of x is absolute
DoubleDouble quick_logarithm(double x);                                     ///< finite, x > 0
DoubleDouble quick_angle(DoubleDouble y, DoubleDouble x);                   ///< as angle()
std::optional<double> quick_power(double base, int exponent);               ///< base is finite and not 0

}  // namespace zstep::portable
