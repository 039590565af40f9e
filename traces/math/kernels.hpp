// Elementary functions in double-double, to 2^-96, with the number type, tables and reductions that they need; and
// first tries, which mostly suffice and cost a fraction. Each argument is the nearest 64th, whose value a table has,
// and a rest of at most 2^-7, for which a few terms of the series are enough. Terms that move the result by less than
// 2^-52 are summed up in double.
#pragma once

#include <array>
#include <cmath>
#include <optional>

namespace zstep::portable {

// A number as the sum of two doubles, which do not overlap: 106 bits. T. J. Dekker, "A floating-point technique for
// extending the available precision", 1971; D. E. Knuth's sum, "The Art of Computer Programming", vol. 2, 4.2.2.
// Right as long as nothing overflows or is subnormal: callers scale.

struct DoubleDouble {
  double high = 0, low = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : high(value) {}  // not explicit: every double is one
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}

  constexpr DoubleDouble operator-() const { return {-high, -low}; }
};

/// a + b without error where |a| >= |b|.
constexpr DoubleDouble sum_of_ordered(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b without error.
constexpr DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// The upper 26 bits of a number.
constexpr double upper_half(double a) {
  const double shifted = 0x1p27 * a + a;
  return shifted - (shifted - a);
}

/// a * b without error. Not by std::fma: where the processor has none it takes ten times as long.
constexpr DoubleDouble exact_product(double a, double b) {
  const double product = a * b, a_1 = upper_half(a), a_2 = a - a_1, b_1 = upper_half(b), b_2 = b - b_1;
  return {product, ((a_1 * b_1 - product) + a_1 * b_2 + a_2 * b_1) + a_2 * b_2};
}

constexpr DoubleDouble operator+(DoubleDouble a, double b) {
  const DoubleDouble sum = exact_sum(a.high, b);
  return sum_of_ordered(sum.high, sum.low + a.low);
}
constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
  const DoubleDouble sum = sum_of_ordered(high.high, high.low + low.high);
  return sum_of_ordered(sum.high, sum.low + low.low);
}
constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }

constexpr DoubleDouble operator*(DoubleDouble a, double b) {
  const DoubleDouble product = exact_product(a.high, b);
  return sum_of_ordered(product.high, product.low + a.low * b);
}
constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble product = exact_product(a.high, b.high);
  return sum_of_ordered(product.high, product.low + (a.high * b.low + a.low * b.high));
}

constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * first;
  const double second = rest.high / b.high;
  const DoubleDouble rest_2 = rest - b * second;
  return sum_of_ordered(first, second) + rest_2.high / b.high;
}

inline DoubleDouble square_root(DoubleDouble a) {
  if (a.high == 0) return {};
  const double root = std::sqrt(a.high);
  const DoubleDouble rest = a - exact_product(root, root);
  return sum_of_ordered(root, rest.high / (2 * root));
}

/// a times a power of two.
inline DoubleDouble scaled(DoubleDouble a, int power) { return {std::ldexp(a.high, power), std::ldexp(a.low, power)}; }

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

// The values of elementary functions at the 64ths, and what finds the nearest of them.

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

// An angle as quarter turns and a rest, without loss however large it is.

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

// Elementary functions a first time: in double-double only what leads, the rest in double. An error below 2^-64 leaves
// the last bit open once in a thousand times; then the kernels above have it, at several times the price.

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
