#include "traces/math/kernels.hpp"

#include <cmath>
#include <cstddef>

#include "traces/math/quarter_turns.hpp"
#include "traces/math/tables.hpp"

namespace zstep::portable {

namespace {

constexpr DoubleDouble one_in(double n) { return DoubleDouble(1) / n; }

constexpr DoubleDouble half{0.5}, third = one_in(3), fifth = one_in(5), seventh = one_in(7);
constexpr DoubleDouble one_in_6 = one_in(6), one_in_24 = one_in(24), one_in_120 = one_in(120);

// --- Series for |d| <= 2^-7

struct SineVersine {
  DoubleDouble sine, versine;  ///< versine: 1 - cosine
};
SineVersine small_turn(DoubleDouble d) {
  const DoubleDouble s = d * d;
  const double t = s.high;
  const double tail_7 = t * (1.0 / 5040 - t * (1.0 / 362880 - t * (1.0 / 39916800)));
  const double tail_6 = t * (1.0 / 720 - t * (1.0 / 40320 - t * (1.0 / 3628800)));
  const DoubleDouble sine = d - d * (s * (one_in_6 - s * (one_in_120 + -tail_7)));
  return {sine, s * (half - s * (one_in_24 + -tail_6))};
}

/// e^d - 1.
DoubleDouble small_exponential(DoubleDouble d) {
  const double t = d.high;
  const double tail = t * (1.0 / 720 + t * (1.0 / 5040 + t * (1.0 / 40320 + t * (1.0 / 362880 + t / 3628800))));
  return d + d * d * (half + d * (one_in_6 + d * (one_in_24 + d * (one_in_120 + tail))));
}

/// d + k d^3 / 3 + d^5 / 5 + k d^7 / 7 …: the hyperbolic arc tangent (k = 1), the arc tangent (k = -1).
DoubleDouble small_arc_tangent(DoubleDouble d, double k) {
  const DoubleDouble s = d * d * k;
  const double t = s.high;
  const double tail = t * (1.0 / 9 + t * (1.0 / 11 + t * (1.0 / 13 + t * (1.0 / 15))));
  return d + d * (s * (third + s * (fifth + s * (seventh + tail))));
}

}  // namespace

// --- Values at the 64ths, each from the one before it

AtParts::AtParts() {
  const SineVersine step = small_turn(1.0 / 128);
  const DoubleDouble sine = 2 * step.sine * (1 - step.versine), cosine = 1 - 2 * step.sine * step.sine;
  turn[0] = {0, 1};
  for (std::size_t i = 1; i < turn.size(); ++i) {
    const SineCosine& last = turn[i - 1];
    turn[i] = {last.sine * cosine + last.cosine * sine, last.cosine * cosine - last.sine * sine};
  }
  const DoubleDouble root = 1 + small_exponential(1.0 / 128), growth = root * root;
  exponential[23] = 1;
  for (std::size_t i = 1; i <= 23; ++i) {
    exponential[23 + i] = exponential[22 + i] * growth;
    exponential[23 - i] = 1 / exponential[23 + i];
  }
  const auto ratio = [](std::size_t i) { return 2 * small_arc_tangent(one_in(2 * static_cast<double>(i) + 1), 1); };
  logarithm[parts] = 0;
  for (std::size_t i = parts; i + 1 < logarithm.size(); ++i) logarithm[i + 1] = logarithm[i] + ratio(i);
  for (std::size_t i = parts; i-- > 45;) logarithm[i] = logarithm[i + 1] - ratio(i);
  arc_tangent[0] = 0;
  for (std::size_t i = 1; i < arc_tangent.size(); ++i) {
    const double n = static_cast<double>(i);
    const DoubleDouble between = DoubleDouble(parts) / (parts * parts + n * (n - 1));
    const DoubleDouble half_way = between / (1 + square_root(1 + between * between));
    arc_tangent[i] = arc_tangent[i - 1] + 2 * small_arc_tangent(half_way, -1);
  }
}

const AtParts& at_parts() {
  static const AtParts table;
  return table;
}

// --- Functions

SineCosine sine_cosine(double x) {
  const QuarterTurns turns = quarter_turns(x);
  const bool negative = turns.rest.high < 0;
  const DoubleDouble rest = negative ? -turns.rest : turns.rest;
  const int part = nearest_whole(parts * rest.high);
  const SineCosine& at = at_parts().turn[static_cast<std::size_t>(part)];
  const SineVersine small = small_turn(rest + -(part / double{parts}));
  DoubleDouble sine = at.sine + (at.cosine * small.sine - at.sine * small.versine);
  const DoubleDouble cosine = at.cosine - (at.sine * small.sine + at.cosine * small.versine);
  if (negative) sine = -sine;
  return after_quarter_turns(turns.count, SineCosine{sine, cosine});
}

Exponential exponential(DoubleDouble x) {
  const int exponent = nearest_whole(x.high * log2_of_e);
  for (const double part : ln_2) x = x + DoubleDouble(-exponent * part);
  const int part = nearest_whole(parts * x.high);
  return {at_parts().exponential[static_cast<std::size_t>(part + 23)], small_exponential(x + -(part / double{parts})),
          exponent};
}

DoubleDouble value(const Exponential& e) { return e.at_64th + e.at_64th * e.more; }

DoubleDouble exp_minus_1(DoubleDouble x) {
  const Exponential e = exponential(x);
  if (e.exponent == 0) return (e.at_64th + -1) + e.at_64th * e.more;
  return scaled(value(e), e.exponent) + -1;
}

DoubleDouble logarithm(double x) {
  const auto [mantissa, exponent] = near_one(x);
  const int part = nearest_whole(parts * mantissa);
  const double at = part / double{parts};
  DoubleDouble sum = at_parts().logarithm[static_cast<std::size_t>(part)] +
                     2 * small_arc_tangent((mantissa - at) / exact_sum(mantissa, at), 1);
  for (std::size_t i = 3; exponent != 0 && i-- > 0;) sum = sum + DoubleDouble(exponent * ln_2[i]);
  return sum;
}

DoubleDouble angle(DoubleDouble y, DoubleDouble x) {
  if (y.high > x.high) return half_pi - angle(x, y);
  const DoubleDouble tangent = y / x;
  const int part = nearest_whole(parts * tangent.high);
  const double at = part / double{parts};
  return at_parts().arc_tangent[static_cast<std::size_t>(part)] +
         small_arc_tangent((tangent + -at) / (1 + at * tangent), -1);
}

}  // namespace zstep::portable
