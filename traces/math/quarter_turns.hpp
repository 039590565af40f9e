// An angle as quarter turns and a rest, without loss however large it is.
#pragma once

#include "traces/math/double_double.hpp"

namespace zstep::portable {

struct QuarterTurns {
  int count = 0;      ///< modulo 4
  DoubleDouble rest;  ///< -pi/4 … pi/4
};
QuarterTurns quarter_turns(double x);  ///< x is finite

/// Sine and cosine of an angle, {sine, cosine}, from those of its rest after so many quarter turns.
template <class SineAndCosine>
SineAndCosine after_quarter_turns(int count, const SineAndCosine& rest) {
  switch (count & 3) {
    case 0:
      return rest;
    case 1:
      return {rest.cosine, -rest.sine};
    case 2:
      return {-rest.sine, -rest.cosine};
    default:
      return {-rest.cosine, rest.sine};
  }
}

}  // namespace zstep::portable
