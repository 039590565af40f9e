// A number without rounding: a fraction where it is one, and where square roots are behind it, between two fractions.
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/answers/origin/evaluate.hpp"
#include "traces/oracle/exact_geometry.hpp"

namespace zstep::answers {

using oracle::Rational;

/// Why a number has no exact value here.
struct NotExact {
  std::string why;
};

struct Enclosed {
  Rational low, high;  ///< the same where the number is a fraction

  explicit Enclosed(double value) : Enclosed(Rational(value)) {}
  explicit Enclosed(const Rational& exact) : low(exact), high(exact) {}
  Enclosed(Rational least, Rational greatest) : low(std::move(least)), high(std::move(greatest)) {}
  bool is_fraction() const { return low == high; }
  Rational middle() const { return is_fraction() ? low : Rational((low + high) / 2); }
  /// Is the interval narrower than 2⁻¹⁰⁰ of the number? Then 25 digits are right.
  bool is_narrow() const {
    return is_fraction() ||
           (high - low) * Rational(boost::multiprecision::cpp_int(1) << 100) <= std::min<Rational>(abs(low), abs(high));
  }
};

inline Enclosed operator+(const Enclosed& a, const Enclosed& b) { return {a.low + b.low, a.high + b.high}; }
inline Enclosed operator-(const Enclosed& a, const Enclosed& b) { return {a.low - b.high, a.high - b.low}; }
inline Enclosed operator-(const Enclosed& a) { return {-a.high, -a.low}; }
inline Enclosed operator*(const Enclosed& a, const Enclosed& b) {
  if (a.is_fraction() && b.is_fraction()) return Enclosed(Rational(a.low * b.low));
  const std::array<Rational, 4> all{a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  const auto [least, greatest] = std::minmax_element(all.begin(), all.end());
  return {*least, *greatest};
}
inline Enclosed operator/(const Enclosed& a, const Enclosed& b) {
  if (b.is_fraction() && b.low == 0) throw std::overflow_error("a division by 0");
  if (b.low.sign() * b.high.sign() <= 0) throw NotExact{"a division by what may be 0"};
  return a * Enclosed(1 / b.high, 1 / b.low);
}

/// The largest fraction of some 200 bits that is not above the root, and the least that is not below it.
inline Enclosed root_of(const Rational& square) {
  using Whole = boost::multiprecision::cpp_int;
  if (square < 0) throw NotExact{"the square root of a negative number"};
  if (square == 0) return Enclosed(square);
  // The root of n/d is that of n·d, over d.
  const Whole below = denominator(square), product = Whole(numerator(square)) * below;
  constexpr unsigned bits = 200;
  const unsigned shift =
      std::max(bits, static_cast<unsigned>(msb(product)) / 2) - static_cast<unsigned>(msb(product)) / 2;
  Whole left;
  const Whole root = boost::multiprecision::sqrt(Whole(product << (2 * shift)), left), unit = below << shift;
  const Rational least(root, unit);
  return left == 0 ? Enclosed(least) : Enclosed(least, Rational(Whole(root + 1), unit));
}

template <>
struct Functions<Enclosed> {
  static bool less(const Enclosed& a, const Enclosed& b) {
    if (a.high < b.low) return true;
    if (a.low >= b.high) return false;
    throw NotExact{"a comparison of what is closer than square roots are known"};
  }
  static bool equal(const Enclosed& a, const Enclosed& b) {
    if (a.high < b.low || b.high < a.low) return false;
    if (a.is_fraction() && b.is_fraction()) return true;
    throw NotExact{"a comparison of what is closer than square roots are known"};
  }
  static Enclosed floor(const Enclosed& a) {
    return whole(a, [](const Rational& r) { return oracle::floor(r); });
  }
  static Enclosed ceil(const Enclosed& a) {
    return whole(a, [](const Rational& r) { return oracle::ceil(r); });
  }
  static Enclosed round(const Enclosed& a) {
    return whole(a, [](const Rational& r) {
      const Rational half(1, 2);
      return r < 0 ? Rational(-oracle::floor(half - r)) : oracle::floor(r + half);
    });
  }
  static Enclosed sqrt(const Enclosed& a) { return {root_of(a.low).low, root_of(a.high).high}; }

 private:
  template <class To>
  static Enclosed whole(const Enclosed& a, To&& to) {
    const Rational low = to(a.low);
    if (low != to(a.high)) throw NotExact{"a whole number closer than square roots are known"};
    return Enclosed(low);
  }
};

}  // namespace zstep::answers
