#include "traces/math/kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "traces/scene.hpp"

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
  const SineCosine& at = at_parts().turn[part];
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
  return {at_parts().exponential[part + 23], small_exponential(x + -(part / double{parts})), exponent};
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
  DoubleDouble sum = at_parts().logarithm[part] + 2 * small_arc_tangent((mantissa - at) / exact_sum(mantissa, at), 1);
  for (std::size_t i = 3; exponent != 0 && i-- > 0;) sum = sum + DoubleDouble(exponent * ln_2[i]);
  return sum;
}

DoubleDouble angle(DoubleDouble y, DoubleDouble x) {
  if (y.high > x.high) return half_pi - angle(x, y);
  const DoubleDouble tangent = y / x;
  const int part = nearest_whole(parts * tangent.high);
  const double at = part / double{parts};
  return at_parts().arc_tangent[part] + small_arc_tangent((tangent + -at) / (1 + at * tangent), -1);
}

namespace {

// The digits of 2 / pi behind the point, 32 bits each.
constexpr std::uint32_t two_over_pi[] = {
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561,
    0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
    0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
    0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b,
    0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab, 0xf0cfbc20, 0x9af4361d};

constexpr std::size_t used = 8, digits = used + 2;
using Digits = std::array<std::uint32_t, digits>;  // the greatest last

}  // namespace

// M. H. Payne and R. N. Hanek, "Radian reduction for trigonometric functions", 1983: digits of 2 / pi that make whole
// turns are left out, and eight of the others leave 108 right bits of any rest.
QuarterTurns quarter_turns(double x) {
  if (std::abs(x) <= half_pi.high / 2) return {0, x};
  int exponent = 0;
  const auto whole = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  exponent -= 53;
  const int first = std::max(0, (exponent - 2) / 32);

  Digits product{};
  for (std::size_t word = 0; word < 2; ++word) {
    const std::uint64_t factor = word == 0 ? whole & 0xffffffff : whole >> 32;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < used; ++i) {
      carry += product[i + word] + factor * two_over_pi[static_cast<std::size_t>(first) + used - 1 - i];
      product[i + word] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    product[used + word] = static_cast<std::uint32_t>(carry);
  }

  // Moved so that the two bits of the count are the uppermost ones; what is above them is whole turns.
  const int behind_point = 32 * (index32(used) + first) - exponent;
  const int move = 32 * index32(digits) - 2 - behind_point;
  Digits moved{};
  for (std::size_t i = move / 32; i < digits; ++i) {
    const std::size_t from = i - static_cast<std::size_t>(move / 32);
    const std::uint64_t two = std::uint64_t{product[from]} << 32 | (from > 0 ? product[from - 1] : 0);
    moved[i] = static_cast<std::uint32_t>(two << (move % 32) >> 32);
  }
  std::uint32_t& top = moved[digits - 1];
  int count = static_cast<int>(top >> 30);
  top &= 0x3fffffff;
  const bool beyond_half = (top >> 29) != 0;  // nearer to the next quarter turn
  if (beyond_half) {
    ++count;
    std::uint64_t borrow = 1;
    for (std::uint32_t& digit : moved) {
      borrow += static_cast<std::uint32_t>(~digit);
      digit = static_cast<std::uint32_t>(borrow);
      borrow >>= 32;
    }
    top &= 0x3fffffff;
  }
  DoubleDouble rest;
  std::size_t last = digits;
  while (last > 0 && moved[last - 1] == 0) --last;
  for (std::size_t i = last; i-- > 0 && i + 5 > last;)
    rest = rest + std::ldexp(static_cast<double>(moved[i]), 2 - 32 * static_cast<int>(digits - i));
  if (beyond_half != (x < 0)) rest = -rest;
  if (x < 0) count = -count;
  return {count & 3, rest * half_pi};
}

namespace {

/// base + slope · step + rest, where each is far below the one before it.
DoubleDouble sum_of(DoubleDouble base, DoubleDouble slope, double step, double rest) {
  const DoubleDouble product = exact_product(slope.high, step), sum = exact_sum(base.high, product.high);
  return {sum.high, sum.low + (base.low + product.low + (slope.low * step + rest))};
}

}  // namespace

std::optional<double> quick_sine(double x, int quarters) {
  // pi / 2 in parts of 33 bits: a whole number of 20 bits times one is exact.
  constexpr double parts_of_half_pi[3] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
  constexpr double quarters_a_radian = 0x1.45f306dc9c883p-1;
  if (!(std::abs(x) < 0x1p20)) return std::nullopt;
  const int turns = nearest_whole(x * quarters_a_radian);
  DoubleDouble rest = exact_sum(x - turns * parts_of_half_pi[0], -turns * parts_of_half_pi[1]);
  rest = sum_of_ordered(rest.high, rest.low - turns * parts_of_half_pi[2]);
  if (turns != 0 && std::abs(rest.high) < 0x1p-20) return std::nullopt;  // too many digits went
  const double sign = rest.high < 0 ? -1 : 1;
  const int part = nearest_whole(sign * parts * rest.high), quadrant = turns + quarters;
  const double d = sign * rest.high - part / double{parts}, low = sign * rest.low, s = d * d;
  const double sine = low + d * (s * (-1.0 / 6 + s * (1.0 / 120 - s * (1.0 / 5040))));  // without d
  const double versine = s * (0.5 - s * (1.0 / 24 - s * (1.0 / 720))) + d * low;
  const SineCosine& at = at_parts().turn[part];
  const bool of_sine = (quadrant & 1) == 0, minus = ((quadrant & 2) != 0) != (of_sine && sign < 0);
  const auto found = of_sine
                         ? if_certain(sum_of(at.sine, at.cosine, d, at.cosine.high * sine - at.sine.high * versine))
                         : if_certain(sum_of(at.cosine, -at.sine, d, -at.sine.high * sine - at.cosine.high * versine));
  return found && minus ? std::optional(-*found) : found;
}

std::optional<double> quick_exponential(DoubleDouble x, double error) {
  if (!(std::abs(x.high) < 700)) return std::nullopt;
  const int exponent = nearest_whole(x.high * log2_of_e);
  const DoubleDouble rest = exact_sum(x.high - exponent * ln_2[0], -exponent * ln_2[1]);
  const int part = nearest_whole(parts * rest.high);
  const double d = rest.high - part / double{parts}, low = rest.low + x.low;
  const double more =
      low * (1 + d) +
      d * d * (0.5 + d * (1.0 / 6 + d * (1.0 / 24 + d * (1.0 / 120 + d * (1.0 / 720 + d * (1.0 / 5040 + d / 40320))))));
  const DoubleDouble& at = at_parts().exponential[part + 23];
  const auto found = if_certain(sum_of(at, at, d, at.high * more), quick_error + error);
  return found ? std::optional(std::ldexp(*found, exponent)) : found;
}

// log x = e ln 2 + log a + log(1 + r), a the nearest 64th; r and r^2 / 2 in double-double, from r^3 / 3 on in double.
DoubleDouble quick_logarithm(double x) {
  const Scaled s = near_one(x);
  const int part = nearest_whole(parts * s.mantissa);
  const double at = part / double{parts}, step = s.mantissa - at, r = step / at;
  const DoubleDouble back = exact_product(r, at), square = exact_product(r, r);
  const double r_low = ((step - back.high) - back.low) / at, t = square.high;
  const double odd = 1.0 / 3 + t * (1.0 / 5 + t * (1.0 / 7 + t * (1.0 / 9)));
  const double even = 1.0 / 4 + t * (1.0 / 6 + t * (1.0 / 8 + t * (1.0 / 10)));
  const DoubleDouble& log_at = at_parts().logarithm[part];
  const DoubleDouble base = exact_sum(s.exponent * ln_2[0], log_at.high), sum = exact_sum(base.high, r);
  const DoubleDouble all = exact_sum(sum.high, -t / 2);
  const double low = s.exponent * ln_2[1] + log_at.low + (base.low + sum.low + all.low);
  return sum_of_ordered(all.high, low + (r_low * (1 - r) - square.low / 2 + r * t * (odd - r * even)));
}

// atan(y / x) = atan a + atan u, a the nearest 64th and u = (y - a x) / (x + a y); from u^3 / 3 on in double.
DoubleDouble quick_angle(DoubleDouble y, DoubleDouble x) {
  if (y.high > x.high) return half_pi - quick_angle(x, y);
  const int part = nearest_whole(parts * (y.high / x.high));
  const double at = part / double{parts};
  const DoubleDouble a_x = exact_product(at, x.high), a_y = exact_product(at, y.high);
  DoubleDouble above = exact_sum(y.high, -a_x.high), below = exact_sum(x.high, a_y.high);
  above = exact_sum(above.high, above.low + (y.low - a_x.low - at * x.low));
  below.low += a_y.low + (x.low + at * y.low);
  const double u = above.high / below.high, s = u * u;
  const DoubleDouble back = exact_product(u, below.high);
  const double u_low = ((above.high - back.high) - back.low + (above.low - u * below.low)) / below.high;
  const double tail = u * s * (1.0 / 3 - s * (1.0 / 5 - s * (1.0 / 7 - s * (1.0 / 9))));
  const DoubleDouble& of_at = at_parts().arc_tangent[part];
  const DoubleDouble sum = exact_sum(of_at.high, u);
  return sum_of_ordered(sum.high, sum.low + (of_at.low + (u_low - tail)));
}

std::optional<double> quick_power(double base, int exponent) {
  if (exponent == 1) return base;
  if (exponent == 2) return base * base;  // rounded once
  // Nothing on the way overflows or is subnormal.
  if (!(std::abs(base) < 0x1p12 && std::abs(base) > 0x1p-12)) return std::nullopt;
  DoubleDouble square = base, product = (exponent & 1) != 0 ? base : 1;
  for (int left = std::abs(exponent) >> 1; left > 0; left >>= 1) {
    square = square * square;
    if ((left & 1) != 0) product = product * square;
  }
  return if_certain(exponent < 0 ? 1 / product : product, 0x1p-90);
}

}  // namespace zstep::portable
