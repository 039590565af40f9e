// An angle as quarter turns and a rest, without loss however large it is.
#pragma once

#include "traces/math/double_double.hpp"

namespace zstep::portable {

struct QuarterTurns {
  int count = 0;      ///< modulo 4
  DoubleDouble rest;  ///< -pi/4 … pi/4
};
QuarterTurns quarter_turns(double x);  ///< x is finite

}  // namespace zstep::portable
