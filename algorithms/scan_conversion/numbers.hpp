// The types of number that scan conversion is compiled for, each with its rounding: double and float as the processor
// rounds them, and fixed point, where every number is a whole multiple of a unit.
//
// Formulas are written once (traces/formulas) for any of them. Which type an expression has follows from it: the
// product of two fixed-point numbers keeps all its digits until it is divided, so that p_0 + (p_1 - p_0)(q - q_0)/(q_1
// - q_0) rounds once.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#include "algorithms/scan_conversion/edge_table.hpp"

namespace zstep {

namespace detail {

__extension__ typedef __int128 Wide;  // of a product and of what is divided

/// The whole number next to a quotient: the nearest, halves upwards, or the one below.
inline Wide quotient(Wide above, Wide below, Conventions::Rounding rounding) {
  if (below < 0) above = -above, below = -below;
  if (rounding == Conventions::Rounding::nearest) above = 2 * above + below, below = 2 * below;
  const Wide whole = above / below;
  return whole - (above % below < 0 ? 1 : 0);
}

/// What fixed point can hold here: products of three such numbers still fit into Wide.
constexpr double most_units = 70368744177664.0;  // 2^46
inline std::int64_t limited_units(double units) {
  return static_cast<std::int64_t>(std::clamp(units, -most_units, most_units));
}
inline std::int64_t limited_units(Wide units) {
  constexpr auto most = static_cast<Wide>(most_units);
  return static_cast<std::int64_t>(std::clamp(units, -most, most));
}

}  // namespace detail

/// The product of two fixed-point numbers, and sums of such: exact.
template <Conventions::Rounding rounding>
struct FixedProduct {
  detail::Wide units = 0;
  double unit = 1;
  explicit operator double() const { return static_cast<double>(units) * unit; }
  friend FixedProduct operator+(FixedProduct a, FixedProduct b) { return {a.units + b.units, a.unit}; }
  friend FixedProduct operator-(FixedProduct a, FixedProduct b) { return {a.units - b.units, a.unit}; }
};

/// A fixed-point number: so many units, of a size that goes with it, counted from an origin. Positions count 1/65536 of
/// a pixel, depths what depth_unit() says, from the least depth that there can be; of a difference the origin is 0, and
/// slopes count the unit of what they are added to.
template <Conventions::Rounding rounding>
class Fixed {
 public:
  static constexpr double positions = fixed_positions_a_pixel;

  Fixed() = default;
  template <std::same_as<std::int32_t> Whole>
  Fixed(Whole pixels) : units_(pixels * static_cast<std::int64_t>(positions)) {}  // NOLINT: a pixel is one
  static Fixed of(double value, double unit, double origin = 0) {
    const double units = (value - origin) / unit;
    if constexpr (rounding == Conventions::Rounding::nearest)
      return {detail::limited_units(std::floor(units + 0.5)), unit, origin};
    // What is a whole number of units but for the last bits of these doubles loses none of them.
    const double last_bits = (std::abs(units) + std::abs(origin / unit)) * 0x1p-51;
    return {detail::limited_units(std::floor(units + last_bits)), unit, origin};
  }
  operator double() const { return origin_ + static_cast<double>(units_) * unit_; }  // NOLINT: events hold doubles

  Fixed& operator+=(Fixed other) { return *this = *this + other; }
  friend Fixed operator+(Fixed a, Fixed b) { return {a.units_ + b.units_, a.unit_, a.origin_ + b.origin_}; }
  friend Fixed operator-(Fixed a, Fixed b) { return {a.units_ - b.units_, a.unit_, a.origin_ - b.origin_}; }
  /// Of differences: what is counted from an origin has no product.
  friend FixedProduct<rounding> operator*(Fixed a, Fixed b) {
    return {static_cast<detail::Wide>(a.units_) * b.units_, a.unit_ * b.unit_};
  }
  /// A slope: by how many units of a per pixel, b being a distance in pixels.
  friend Fixed operator/(Fixed a, Fixed b) {
    return divided(static_cast<detail::Wide>(a.units_) * static_cast<detail::Wide>(positions), b.units_, a.unit_);
  }
  friend Fixed operator/(FixedProduct<rounding> a, Fixed b) { return divided(a.units, b.units_, a.unit * positions); }
  friend Fixed operator+(Fixed a, FixedProduct<rounding> b) {
    return a + divided(b.units, static_cast<detail::Wide>(positions), a.unit_);
  }
  double unit() const { return unit_; }
  double units() const { return static_cast<double>(units_); }

  static Fixed divided(detail::Wide above, detail::Wide below, double unit) {
    if (below == 0) return {0, unit, 0};
    return {detail::limited_units(detail::quotient(above, below, rounding)), unit, 0};
  }

 private:
  Fixed(std::int64_t units, double unit, double origin) : units_(units), unit_(unit), origin_(origin) {}

  std::int64_t units_ = 0;
  double unit_ = 1 / positions, origin_ = 0;
};
template <Conventions::Rounding rounding>
Fixed<rounding> operator/(FixedProduct<rounding> a, FixedProduct<rounding> b) {
  constexpr double positions = Fixed<rounding>::positions;
  return Fixed<rounding>::divided(a.units * static_cast<detail::Wide>(positions), b.units, a.unit * positions);
}
using FixedNearest = Fixed<Conventions::Rounding::nearest>;
using FixedDown = Fixed<Conventions::Rounding::down>;

/// How far rounding moves a sum, a product or a quotient of this value at most.
struct RoundingOf {
  double sum = 0, product = 0, quotient = 0;
};
template <class T>
RoundingOf rounding_of_result(const T& result) {
  const double share = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2;
  const double off =
      share * std::abs(static_cast<double>(result)) + static_cast<double>(std::numeric_limits<T>::denorm_min());
  return {off, off, off};
}
template <Conventions::Rounding rounding>
RoundingOf rounding_of_result(const Fixed<rounding>& result) {
  // What is out of range stays at its end, however far off that is. With what it is added to, it is beyond half of it.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (std::abs(result.units()) >= detail::most_units / 2) return {infinity, infinity, infinity};
  const double off = rounding == Conventions::Rounding::nearest ? result.unit() / 2 : result.unit();
  return {0, 0, off};
}
template <Conventions::Rounding rounding>
RoundingOf rounding_of_result(const FixedProduct<rounding>&) {
  return {};
}

/// A number, and how far it can be from the one that exact arithmetic has in its place (running error analysis:
/// N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, section 3.3; docs/interpolation.md).
template <class T>
struct Bounded {
  T value{};
  double error = 0;

  Bounded() = default;
  template <std::same_as<std::int32_t> Whole>
  Bounded(Whole whole) : value(static_cast<T>(whole)) {}  // NOLINT: exact
  Bounded(T known, double off) : value(known), error(off) {}
  explicit Bounded(double known) : value(static_cast<T>(known)) {}  ///< of a formula, which T holds as it is
  operator double() const { return static_cast<double>(value); }    // NOLINT: events hold doubles
  Bounded& operator+=(const Bounded& other) { return *this = *this + other; }
};

namespace detail {
template <class T>
double size_of(const Bounded<T>& of) {
  return std::abs(static_cast<double>(of.value));
}
/// 0 times a number that has no bound has none.
inline double bound(double off) { return std::isnan(off) ? std::numeric_limits<double>::infinity() : off; }
}  // namespace detail

template <class A, class B>
auto operator+(const Bounded<A>& a, const Bounded<B>& b) {
  const auto value = a.value + b.value;
  double off = a.error + b.error + rounding_of_result(value).sum;
  if constexpr (!std::is_same_v<A, B>) off += rounding_of_result(value).quotient;  // the product becomes a number
  return Bounded<std::remove_cv_t<decltype(value)>>{value, off};
}
template <class A>
auto operator-(const Bounded<A>& a, const Bounded<A>& b) {
  const auto value = a.value - b.value;
  return Bounded<std::remove_cv_t<decltype(value)>>{value, a.error + b.error + rounding_of_result(value).sum};
}
template <class A>
Bounded<A> operator-(const Bounded<A>& a) {
  return {-a.value, a.error};
}
template <class A>
auto operator*(const Bounded<A>& a, const Bounded<A>& b) {
  const auto value = a.value * b.value;
  return Bounded<std::remove_cv_t<decltype(value)>>{
      value, detail::bound(detail::size_of(a) * b.error + detail::size_of(b) * a.error + a.error * b.error +
                           rounding_of_result(value).product)};
}
template <class A, class B>
auto operator/(const Bounded<A>& a, const Bounded<B>& b) {
  const auto value = a.value / b.value;
  const double below = detail::size_of(b) - b.error, ratio = detail::size_of(a) / detail::size_of(b);
  const double off = below > 0 ? (a.error + ratio * b.error) / below : std::numeric_limits<double>::infinity();
  return Bounded<std::remove_cv_t<decltype(value)>>{value, detail::bound(off + rounding_of_result(value).quotient)};
}

}  // namespace zstep

namespace zstep::scan_conversion {

/// `reciprocal` is what makes z_v of 1/z_v at a pixel.
template <Conventions::Rounding rounding>
struct NumbersOf<Fixed<rounding>> {
  double depth_unit = 1, reciprocal_unit = 1;      ///< of what is interpolated, and of its reciprocal
  double depth_origin = 0, reciprocal_origin = 0;  ///< what they are counted from
  Fixed<rounding> position(double x) const { return Fixed<rounding>::of(x, 1 / Fixed<rounding>::positions); }
  Fixed<rounding> depth(double z) const { return Fixed<rounding>::of(z, depth_unit, depth_origin); }
  Fixed<rounding> reciprocal(Fixed<rounding> w) const {
    return Fixed<rounding>::of(1 / static_cast<double>(w), reciprocal_unit, reciprocal_origin);
  }
};
template <class T>
struct NumbersOf<Bounded<T>> {
  NumbersOf<T> of{};
  static Bounded<T> known(T value, double exact) { return {value, std::abs(static_cast<double>(value) - exact)}; }
  Bounded<T> position(double x) const { return known(of.position(x), x); }
  Bounded<T> depth(double z) const { return known(of.depth(z), z); }
  Bounded<T> reciprocal(const Bounded<T>& w) const {
    const T value = of.reciprocal(w.value);
    const double size = detail::size_of(w), below = size - w.error;
    const double off = below > 0 ? w.error / (size * below) : std::numeric_limits<double>::infinity();
    return {value, off + rounding_of_result(value).quotient};
  }
};

}  // namespace zstep::scan_conversion

/// X(R, T) for each recorder and each type of number. Errors are bounded where nothing is recorded.
#define ZSTEP_FOR_EACH_NUMBER(X)                                    \
  ZSTEP_FOR_EACH_RECORDER_OF(X, double)                             \
  ZSTEP_FOR_EACH_RECORDER_OF(X, float)                              \
  ZSTEP_FOR_EACH_RECORDER_OF(X, ::zstep::FixedNearest)              \
  ZSTEP_FOR_EACH_RECORDER_OF(X, ::zstep::FixedDown)                 \
  X(::zstep::NullRecorder, ::zstep::Bounded<double>)                \
  X(::zstep::NullRecorder, ::zstep::Bounded<float>)                 \
  X(::zstep::NullRecorder, ::zstep::Bounded<::zstep::FixedNearest>) \
  X(::zstep::NullRecorder, ::zstep::Bounded<::zstep::FixedDown>)
#define ZSTEP_FOR_EACH_RECORDER_OF(X, T) \
  X(::zstep::NullRecorder, T)            \
  X(::zstep::CountRecorder, T)           \
  X(::zstep::CollectRecorder, T)         \
  X(::zstep::TraceRecorder, T)
