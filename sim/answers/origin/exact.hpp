// What the numbers of a chain would be without any rounding, and where the error of the first one came in.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/answers/origin/chain.hpp"
#include "sim/classroom/expression.hpp"
#include "traces/file/trace.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/oracle/exact_geometry.hpp"
#include "traces/text.hpp"

namespace zstep::answers {

// What a formula of a chain gives, in any type of number: rounded as it was computed, or exact.

namespace detail {

inline bool in_name(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

inline std::string name_at(const std::string& formula, std::size_t from) {
  std::size_t end = from;
  while (end < formula.size() && in_name(formula[end])) ++end;
  return formula.substr(from, end - from);
}

inline const Operand* operand_of(const ChainValue& value, const std::string& symbol) {
  for (const Operand& operand : value.operands)
    if (operand.symbol == symbol) return &operand;
  return nullptr;
}

}  // namespace detail

/// What + - * / do not say. Others are specialised where the type of number is.
template <class T>
struct Functions;
template <>
struct Functions<formulas::Rounded> {
  using Rounded = formulas::Rounded;
  static bool less(const Rounded& a, const Rounded& b) { return a.value < b.value; }
  static bool equal(const Rounded& a, const Rounded& b) { return a.value == b.value; }
  static Rounded floor(const Rounded& a) { return formulas::floor(a); }
  static Rounded ceil(const Rounded& a) { return formulas::ceil(a); }
  static Rounded round(const Rounded& a) { return formulas::round(a); }
  static Rounded sqrt(const Rounded& a) { return formulas::sqrt(a); }
};

/// In the order of the formula's text.
template <class T>
class Evaluation {
 public:
  using OfOperand = std::function<T(const Operand&)>;

  Evaluation(const ChainValue& value, OfOperand of_operand) : value_(value), of_operand_(std::move(of_operand)) {}
  T run() { return of(classroom::parse_formula(value_.formula, "formula")); }

 private:
  using Expression = classroom::Expression;

  T of(const Expression& part) {
    if (part.kind == Expression::Kind::number) return T(part.number);
    if (part.kind == Expression::Kind::name)
      if (const Operand* operand = detail::operand_of(value_, part.text)) return of_operand_(*operand);
    std::vector<T> given;
    for (const Expression& one : part.parts) given.push_back(of(one));
    if (given.empty()) wrong();
    return part.kind == Expression::Kind::call
               ? called(part.text, given)
               : classroom::computed<Functions<T>>(part.kind, given.front(), given.back());
  }
  T called(const std::string& name, const std::vector<T>& given) {
    using F = Functions<T>;
    if (name == "floor") return F::floor(given[0]);
    if (name == "ceil") return F::ceil(given[0]);
    if (name == "round") return F::round(given[0]);
    if (name == "sqrt") return F::sqrt(given[0]);
    if (name == "abs") return F::less(given[0], T(0.0)) ? T(-given[0]) : given[0];
    if (name == "min") return *std::min_element(given.begin(), given.end(), F::less);
    if (name == "max") return *std::max_element(given.begin(), given.end(), F::less);
    wrong();
  }
  [[noreturn]] void wrong() const { throw std::logic_error(fmt::format("'{}' is no formula", value_.formula)); }

  const ChainValue& value_;
  OfOperand of_operand_;
};

// A number without rounding: a fraction where it is one, and where square roots are behind it, between two fractions.

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

/// A number of a chain, held against what + − × ÷ and square roots give from the scene's numbers without rounding.
struct Exact {
  bool known = false;
  std::string why;        ///< where it is not known: what stands in the way
  bool enclosed = false;  ///< it has a square root behind it, and is known to lie in an interval narrower than its
                          ///< 2⁻¹⁰⁰th part; the digits are those of the middle
  std::string digits;     ///< "1/3 = 0.3333333333333333333333333"
  double error = 0;       ///< the recorded number − the exact one
  double ulps = 0;        ///< the same, in units of the last digit that the trace's number format has there
  double brought = 0;     ///< what rounding at this very step adds to the error of the chain's first number
};

struct Exactness {
  std::vector<std::vector<Exact>> of;  ///< by link and by value
  struct Where {
    std::size_t link, value;
  };
  double buffer_unit = 0;     ///< the last bit of the depth buffer at the first number, where that is a depth; else 0
  std::optional<Where> most;  ///< where most of the first number's error came in, if it has one
};

Exactness exactness_of(const Chain& chain, const Trace& trace);

/// Two digits, with signs as they are printed.
std::string roughly(double value);
/// "exactly 1/3 = 0.3333…; error −1.9e−17, −0.33 ulp"
std::string exact_text(const ChainValue& value, const Exact& exact);

}  // namespace zstep::answers
