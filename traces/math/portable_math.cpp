#include "traces/math/portable_math.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "traces/math/kernels.hpp"

namespace zstep::portable {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
constexpr DoubleDouble one_over_ln_10{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};

// Below it, sine, tangent, their inverses and the hyperbolic ones differ from x by less than half of its last bit.
constexpr double tiny = 0x1p-27;

/// The nearest double to a number times a power of two, subnormal ones too: there the last bit is that of 2^-1074.
double nearest(DoubleDouble a, int exponent) {
  const int magnitude = std::ilogb(a.high) + exponent;
  if (magnitude >= -1022 || a.high == 0) return std::ldexp(a.high, exponent);
  if (magnitude < -1076) return std::copysign(0, a.high);
  const double rounder = std::copysign(std::ldexp(1.0, -1074 - exponent + 52), a.high);
  const DoubleDouble sum = exact_sum(rounder, a.high);
  return std::ldexp(sum.high + (sum.low + a.low) - rounder, exponent);
}

double power_of_e(DoubleDouble x) {
  if (x.high > 710) return infinity;
  if (x.high < -746) return 0;
  const Exponential e = exponential(x);
  return nearest(value(e), e.exponent);
}

/// A power may lie exactly between two doubles, or be one. What is so near to that can be nothing else.
DoubleDouble settled(DoubleDouble a) {
  const double eighth = std::ldexp(1.0, std::ilogb(a.high) - 55), whole = std::nearbyint(a.low / eighth) * eighth;
  return std::abs(a.low - whole) < 0x1p-36 * eighth ? DoubleDouble(a.high, whole) : a;
}

bool is_whole(double a) { return std::floor(a) == a; }
bool is_odd(double a) { return is_whole(a) && std::fmod(a, 2) != 0; }

/// By multiplications, which leave nothing out while the result has less than 107 bits.
double whole_power(double base, int n) {
  if (const auto quick = quick_power(base, n)) return *quick;
  int exponent = 0;
  DoubleDouble square = std::frexp(base, &exponent), product = 1;
  for (int left = std::abs(n); left > 0; left >>= 1, square = square * square)
    if (left & 1) product = product * square;
  if (n < 0) product = 1 / product;
  return nearest(settled(product), exponent * n);
}

double power(double base, double exponent) {  // base > 0
  if (is_whole(exponent) && std::abs(exponent) <= 64) return whole_power(base, static_cast<int>(exponent));
  if (base == 1) return 1;
  const DoubleDouble tried = quick_logarithm(base) * exponent;
  if (const auto quick = quick_exponential(tried, std::abs(tried.high) * quick_error)) return *quick;
  const DoubleDouble of_base = logarithm(base);
  const double about = of_base.high * exponent;
  if (about > 710) return infinity;
  if (about < -746) return 0;
  if (std::abs(about) < 0x1p-60) return 1;
  const Exponential e = zstep::portable::exponential(of_base * exponent);
  return nearest(settled(value(e)), e.exponent);
}

/// The angle of a vector that is not negative, or of its mirror image to the left.
double rounded_angle(DoubleDouble y, DoubleDouble x, bool mirrored) {
  const auto whole = [mirrored](DoubleDouble turned) { return mirrored ? pi - turned : turned; };
  if (const auto quick = if_certain(whole(quick_angle(y, x)))) return *quick;
  return whole(angle(y, x)).high;
}

/// Both as multiples of one power of two, so that nothing overflows.
double angle_of(double y, double x) {  // both finite and not 0
  const double up = std::abs(y), right = std::abs(x);
  const int apart = std::ilogb(up) - std::ilogb(right);
  if (apart < -60 && x > 0) return y / x;
  if (apart > 60) return std::copysign(half_pi.high, y);
  if (apart < -60) return std::copysign(pi.high, y);
  const int scale = -std::max(std::ilogb(up), std::ilogb(right));
  return std::copysign(rounded_angle(std::ldexp(up, scale), std::ldexp(right, scale), x < 0), y);
}

}  // namespace

double sin(double x) {
  if (std::abs(x) < tiny) return x;
  if (const auto quick = quick_sine(x, 0)) return *quick;
  return std::isfinite(x) ? sine_cosine(x).sine.high : none;
}

double cos(double x) {
  if (const auto quick = quick_sine(x, 1)) return *quick;
  return std::isfinite(x) ? sine_cosine(x).cosine.high : none;
}

double tan(double x) {
  if (std::abs(x) < tiny) return x;
  if (!std::isfinite(x)) return none;
  const SineCosine turned = sine_cosine(x);
  return (turned.sine / turned.cosine).high;
}

double asin(double x) {
  if (std::abs(x) < tiny) return x;
  if (!(std::abs(x) <= 1)) return none;
  const double size = std::abs(x);
  return std::copysign(rounded_angle(size, square_root(exact_sum(1, -size) * exact_sum(1, size)), false), x);
}

double acos(double x) {
  if (!(std::abs(x) <= 1)) return none;
  const double size = std::abs(x);
  return rounded_angle(square_root(exact_sum(1, -size) * exact_sum(1, size)), size, x < 0);
}

double atan(double x) {
  if (std::abs(x) < tiny || std::isnan(x)) return x;
  if (std::abs(x) > 0x1p60) return std::copysign(half_pi.high, x);
  return std::copysign(rounded_angle(std::abs(x), 1, false), x);
}

double atan2(double y, double x) {
  if (std::isfinite(x) && std::isfinite(y) && x != 0 && y != 0) return angle_of(y, x);
  if (std::isnan(x) || std::isnan(y)) return none;
  const double up = std::isinf(y) ? 1 : 0, right = std::isinf(x) ? 1 : 0;  // which of them counts
  DoubleDouble turned = half_pi;
  if (std::isinf(x) && std::isinf(y)) turned = {half_pi.high / 2, half_pi.low / 2};
  else if (up < right || y == 0) turned = 0;
  if (std::signbit(x) && (x != 0 || y == 0)) turned = pi - turned;
  return std::copysign(turned.high, y);
}

double exp(double x) {
  if (std::abs(x) <= 0x1p-53) return x > 0 ? 1 + x * (1 + 0x1p-52) : 1 + x;  // 1 + x, and a little more
  if (const auto quick = quick_exponential(x)) return *quick;
  return std::isnan(x) ? none : power_of_e(x);
}

double log(double x) {
  if (x == 0) return -infinity;
  if (!(x > 0)) return none;
  if (std::isinf(x)) return x;
  const auto quick = if_certain(quick_logarithm(x));
  return quick ? *quick : logarithm(x).high;
}

double log10(double x) {
  if (x == 0) return -infinity;
  if (!(x > 0)) return none;
  if (std::isinf(x)) return x;
  const auto quick = if_certain(quick_logarithm(x) * one_over_ln_10);
  return quick ? *quick : (logarithm(x) * one_over_ln_10).high;
}

double pow(double base, double exponent) {
  if (exponent == 0 || base == 1) return 1;
  if (std::isnan(base) || std::isnan(exponent)) return none;
  const bool special = base == 0 || std::isinf(base) || std::isinf(exponent);
  if (special) return std::pow(base, exponent);  // 0, 1 or infinite, as Annex F says
  if (base > 0) return power(base, exponent);
  if (!is_whole(exponent)) return none;
  return is_odd(exponent) ? -power(-base, exponent) : power(-base, exponent);
}

double sinh(double x) {
  const double size = std::abs(x);
  if (size < tiny || std::isnan(x)) return x;
  if (size > 712) return std::copysign(infinity, x);
  if (size < 40) {
    const DoubleDouble more = exp_minus_1(size);
    return std::copysign((more + more / (1 + more)).high / 2, x);
  }
  const Exponential e = exponential(size);  // e^-x is lost
  return std::copysign(nearest(value(e), e.exponent - 1), x);
}

double cosh(double x) {
  const double size = std::abs(x);
  if (std::isnan(x)) return none;
  if (size > 712) return infinity;
  const Exponential e = exponential(size);
  if (size >= 40) return nearest(value(e), e.exponent - 1);
  const DoubleDouble grown = scaled(value(e), e.exponent);
  return (grown + 1 / grown).high / 2;
}

double tanh(double x) {
  const double size = std::abs(x);
  if (size < tiny || std::isnan(x)) return x;
  if (size > 20) return std::copysign(1, x);
  const DoubleDouble more = exp_minus_1(2 * size);
  return std::copysign((more / (2 + more)).high, x);
}

double length(double x, double y) { return std::sqrt(x * x + y * y); }
float length(float x, float y) { return std::sqrt(x * x + y * y); }

}  // namespace zstep::portable

namespace zstep {
namespace {

/// How many digits there are from `at` on.
std::size_t digits(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
  return end - at;
}

}  // namespace

std::size_t read_number(std::string_view text, double& value) {
  const auto is = [&](std::size_t at, std::string_view signs) {
    return at < text.size() && signs.find(text[at]) != std::string_view::npos;
  };
  std::size_t end = is(0, "-") ? 1 : 0;
  const std::size_t whole = digits(text, end);
  end += whole;
  const std::size_t part = is(end, ".") ? digits(text, end + 1) : 0;
  if (whole + part == 0) return 0;
  if (is(end, ".")) end += 1 + part;
  if (is(end, "eE")) {
    const std::size_t sign = is(end + 1, "+-") ? 1 : 0, power = digits(text, end + 1 + sign);
    if (power > 0) end += 1 + sign + power;
  }
  const double read = std::strtod(std::string(text.substr(0, end)).c_str(), nullptr);
  if (!std::isfinite(read)) return 0;
  value = read;
  return end;
}

}  // namespace zstep
