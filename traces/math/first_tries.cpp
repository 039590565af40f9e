#include "traces/math/first_tries.hpp"

#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "traces/math/tables.hpp"

namespace zstep::portable {

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
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
  if (!(std::abs(x) < 0x1p20)) return std::nullopt;
  const int turns = nearest_whole(x * two_over_pi);
  DoubleDouble rest = exact_sum(x - turns * parts_of_half_pi[0], -turns * parts_of_half_pi[1]);
  rest = sum_of_ordered(rest.high, rest.low - turns * parts_of_half_pi[2]);
  if (turns != 0 && std::abs(rest.high) < 0x1p-20) return std::nullopt;  // too many digits went
  const double sign = rest.high < 0 ? -1 : 1;
  const int part = nearest_whole(sign * parts * rest.high), quadrant = turns + quarters;
  const double d = sign * rest.high - part / double{parts}, low = sign * rest.low, s = d * d;
  const double sine = low + d * (s * (-1.0 / 6 + s * (1.0 / 120 - s * (1.0 / 5040))));  // without d
  const double versine = s * (0.5 - s * (1.0 / 24 - s * (1.0 / 720))) + d * low;
  const SineCosine& at = at_parts().turn[static_cast<std::size_t>(part)];
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
  const DoubleDouble& at = at_parts().exponential[static_cast<std::size_t>(part + 23)];
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
  const DoubleDouble& log_at = at_parts().logarithm[static_cast<std::size_t>(part)];
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
  const DoubleDouble& of_at = at_parts().arc_tangent[static_cast<std::size_t>(part)];
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
