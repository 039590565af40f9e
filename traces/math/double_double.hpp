// A number as the sum of two doubles, which do not overlap: 106 bits. T. J. Dekker, "A floating-point technique for
// extending the available precision", 1971; D. E. Knuth's sum, "The Art of Computer Programming", vol. 2, 4.2.2.
// Right as long as nothing overflows or is subnormal: callers scale.
#pragma once

#include <cmath>

namespace zstep::portable {

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

}  // namespace zstep::portable
