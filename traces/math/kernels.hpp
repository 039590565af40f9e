// Elementary functions in double-double: each argument is the nearest 64th, whose value a table has, and a rest of at
// most 2^-7, for which a few terms of the series are enough. Terms that move the result by less than 2^-52 are summed
// up in double. The error of all is below 2^-96, relative to the result.
#pragma once

#include "traces/math/double_double.hpp"

namespace zstep::portable {

inline constexpr DoubleDouble pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
inline constexpr DoubleDouble half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

struct SineCosine {
  DoubleDouble sine, cosine;
};

SineCosine sine_cosine(double x);  ///< of any finite angle

/// power_of_2 · 2^exponent · (1 + more): e^x, and e^x - 1 without cancellation.
struct Exponential {
  DoubleDouble at_64th, more;
  int exponent = 0;
};
Exponential exponential(DoubleDouble x);             ///< |x| < 1000
DoubleDouble value(const Exponential& e);            ///< without its power of two
DoubleDouble exp_minus_1(DoubleDouble x);            ///< |x| < 100
DoubleDouble logarithm(double x);                    ///< natural, x > 0
DoubleDouble angle(DoubleDouble y, DoubleDouble x);  ///< atan2 of two that are not negative and not both 0

}  // namespace zstep::portable
