#include "traces/math/kernels.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>

#include "traces/math/quarter_turns.hpp"

namespace zstep::portable {

namespace {

constexpr DoubleDouble one_in(double n) { return DoubleDouble(1) / n; }

constexpr DoubleDouble half{0.5}, third = one_in(3), fifth = one_in(5), seventh = one_in(7);
constexpr DoubleDouble one_in_6 = one_in(6), one_in_24 = one_in(24), one_in_120 = one_in(120);
constexpr double log2_of_e = 0x1.71547652b82fep+0;
// ln 2 in parts of 42 bits: a whole number of 11 bits times one is exact.
constexpr double ln_2[3] = {0x1.62e42fefa3800p-1, 0x1.ef35793c76000p-45, 0x1.cc01f97b57a08p-87};

constexpr int parts = 64;

int nearest(double value) { return static_cast<int>(value < 0 ? value - 0.5 : value + 0.5); }

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

// --- Values at the 64ths, each from the one before it

struct AtParts {
  std::array<SineCosine, 52> turn;           // 0 … pi / 4
  std::array<DoubleDouble, 47> exponential;  // -23 … 23
  std::array<DoubleDouble, 92> logarithm;    // 45 … 91
  std::array<DoubleDouble, 65> arc_tangent;  // 0 … 1

  AtParts() {
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
};

const AtParts& at_parts() {
  static const AtParts table;
  return table;
}

// --- First tries

/// base + slope · step + rest, if that rounds to one number whatever the error is.
std::optional<double> if_certain(DoubleDouble base, DoubleDouble slope, double step, double rest) {
  const DoubleDouble product = exact_product(slope.high, step), sum = exact_sum(base.high, product.high);
  const double low = sum.low + (base.low + product.low + (slope.low * step + rest)), error = 0x1p-64 * sum.high;
  const double one = sum.high + (low - error), other = sum.high + (low + error);
  if (one != other) return std::nullopt;
  return one;
}

}  // namespace

std::optional<double> quick_sine(double x, int quarters) {
  // pi / 2 in parts of 33 bits: a whole number of 20 bits times one is exact.
  constexpr double parts_of_half_pi[3] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
  if (!(std::abs(x) < 0x1p20)) return std::nullopt;
  const int turns = nearest(x * two_over_pi);
  DoubleDouble rest = exact_sum(x - turns * parts_of_half_pi[0], -turns * parts_of_half_pi[1]);
  rest = sum_of_ordered(rest.high, rest.low - turns * parts_of_half_pi[2]);
  if (turns != 0 && std::abs(rest.high) < 0x1p-20) return std::nullopt;  // too many digits went
  const double sign = rest.high < 0 ? -1 : 1;
  const int part = nearest(sign * parts * rest.high), quadrant = turns + quarters;
  const double d = sign * rest.high - part / double{parts}, low = sign * rest.low, s = d * d;
  const double sine = low + d * (s * (-1.0 / 6 + s * (1.0 / 120 - s * (1.0 / 5040))));  // without d
  const double versine = s * (0.5 - s * (1.0 / 24 - s * (1.0 / 720))) + d * low;
  const SineCosine& at = at_parts().turn[static_cast<std::size_t>(part)];
  const bool of_sine = (quadrant & 1) == 0, minus = ((quadrant & 2) != 0) != (of_sine && sign < 0);
  const auto found = of_sine ? if_certain(at.sine, at.cosine, d, at.cosine.high * sine - at.sine.high * versine)
                             : if_certain(at.cosine, -at.sine, d, -at.sine.high * sine - at.cosine.high * versine);
  return found && minus ? std::optional(-*found) : found;
}

std::optional<double> quick_exponential(double x) {
  if (!(std::abs(x) < 700)) return std::nullopt;
  const int exponent = nearest(x * log2_of_e);
  const DoubleDouble rest = exact_sum(x - exponent * ln_2[0], -exponent * ln_2[1]);
  const int part = nearest(parts * rest.high);
  const double d = rest.high - part / double{parts};
  const double more =
      rest.low * (1 + d) +
      d * d * (0.5 + d * (1.0 / 6 + d * (1.0 / 24 + d * (1.0 / 120 + d * (1.0 / 720 + d * (1.0 / 5040 + d / 40320))))));
  const DoubleDouble& at = at_parts().exponential[static_cast<std::size_t>(part + 23)];
  const auto found = if_certain(at, at, d, at.high * more);
  return found ? std::optional(std::ldexp(*found, exponent)) : found;
}

SineCosine sine_cosine(double x) {
  const QuarterTurns turns = quarter_turns(x);
  const bool negative = turns.rest.high < 0;
  const DoubleDouble rest = negative ? -turns.rest : turns.rest;
  const int part = nearest(parts * rest.high);
  const SineCosine& at = at_parts().turn[static_cast<std::size_t>(part)];
  const SineVersine small = small_turn(rest + -(part / double{parts}));
  DoubleDouble sine = at.sine + (at.cosine * small.sine - at.sine * small.versine);
  const DoubleDouble cosine = at.cosine - (at.sine * small.sine + at.cosine * small.versine);
  if (negative) sine = -sine;
  switch (turns.count) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

Exponential exponential(DoubleDouble x) {
  const int exponent = nearest(x.high * log2_of_e);
  for (const double part : ln_2) x = x + DoubleDouble(-exponent * part);
  const int part = nearest(parts * x.high);
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
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < 0x1.6a09e667f3bcdp-1) mantissa *= 2, --exponent;  // below the root of one half
  const int part = nearest(parts * mantissa);
  const double at = part / double{parts};
  DoubleDouble sum = at_parts().logarithm[static_cast<std::size_t>(part)] +
                     2 * small_arc_tangent((mantissa - at) / exact_sum(mantissa, at), 1);
  for (std::size_t i = 3; exponent != 0 && i-- > 0;) sum = sum + DoubleDouble(exponent * ln_2[i]);
  return sum;
}

DoubleDouble angle(DoubleDouble y, DoubleDouble x) {
  if (y.high > x.high) return half_pi - angle(x, y);
  const DoubleDouble tangent = y / x;
  const int part = nearest(parts * tangent.high);
  const double at = part / double{parts};
  return at_parts().arc_tangent[static_cast<std::size_t>(part)] +
         small_arc_tangent((tangent + -at) / (1 + at * tangent), -1);
}

}  // namespace zstep::portable
