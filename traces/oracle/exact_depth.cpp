#include "traces/oracle/exact_depth.hpp"

#include <algorithm>
#include <cmath>

namespace zstep::oracle {

namespace {

/// A double is mantissa · 2^-digits with a whole mantissa.
struct Dyadic {
  std::int64_t mantissa = 0;
  int digits = 0;
};
Dyadic dyadic(double value) {
  if (value == 0) return {};
  constexpr int bits = 53;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  Dyadic parts{static_cast<std::int64_t>(std::ldexp(fraction, bits)), bits - exponent};
  while ((parts.mantissa & 1) == 0) parts.mantissa /= 2, --parts.digits;
  return parts;
}
/// value · 2^digits, which must be whole.
Whole scaled(double value, int digits) {
  const Dyadic parts = dyadic(value);
  Whole whole = parts.mantissa;
  return parts.mantissa == 0 ? whole : whole << (digits - parts.digits);
}

/// An edge on one scan line, in the scaled numbers: x = x/d, z = z/d.
struct Crossing {
  Whole x, z, d;
};
Crossing crossing(const Edge& edge, const Whole& y, int digits_xy, int digits_z) {
  const Whole x_0 = scaled(edge.from.x, digits_xy), y_0 = scaled(edge.from.y, digits_xy),
              z_0 = scaled(edge.from.z, digits_z), down = y - y_0;
  Crossing at;
  at.d = scaled(edge.to.y, digits_xy) - y_0;
  at.x = x_0 * at.d + down * (scaled(edge.to.x, digits_xy) - x_0);
  at.z = z_0 * at.d + down * (scaled(edge.to.z, digits_z) - z_0);
  if (at.d < 0) at.d = -at.d, at.x = -at.x, at.z = -at.z;
  return at;
}

}  // namespace

double quotient(const Whole& numerator, const Whole& denominator) {
  if (numerator == 0) return 0;
  // 64 bits of the quotient, the last of which also stands for all that is left: rounding these to a double rounds
  // once.
  Whole above = abs(numerator), below = denominator, whole, left;
  const int shift = 63 - static_cast<int>(msb(above)) + static_cast<int>(msb(below));
  if (shift > 0) above <<= shift;
  else below <<= -shift;
  divide_qr(above, below, whole, left);
  const std::uint64_t bits = static_cast<std::uint64_t>(whole) | static_cast<std::uint64_t>(left != 0);
  const double value = std::ldexp(static_cast<double>(bits), -shift);
  return numerator < 0 ? -value : value;
}

std::optional<ExactDepth> ExactDepth::between(const Edge& left, const Edge& right, std::int32_t y) {
  int digits_xy = 0, digits_z = 0;
  for (const Edge* edge : {&left, &right}) {
    if (edge->from.y == edge->to.y) return std::nullopt;
    for (const Vertex* vertex : {&edge->from, &edge->to}) {
      if (!std::isfinite(vertex->x) || !std::isfinite(vertex->y) || !std::isfinite(vertex->z)) return std::nullopt;
      digits_xy = std::max({digits_xy, dyadic(vertex->x).digits, dyadic(vertex->y).digits});
      digits_z = std::max(digits_z, dyadic(vertex->z).digits);
    }
  }
  const Whole line = Whole(y) << digits_xy;
  const Crossing l = crossing(left, line, digits_xy, digits_z), r = crossing(right, line, digits_xy, digits_z);
  // z = z_L + (z_R − z_L)(x − x_L)/(x_R − x_L), over one denominator.
  const Whole width = r.x * l.d - l.x * r.d, rise = r.z * l.d - l.z * r.d;
  ExactDepth depth;
  if (width == 0) {
    depth.c_0_ = l.z, depth.c_1_ = 0, depth.d_ = l.d;
  } else {
    depth.c_0_ = l.z * width - rise * l.x, depth.c_1_ = rise * l.d << digits_xy, depth.d_ = l.d * width;
    if (depth.d_ < 0) depth.c_0_ = -depth.c_0_, depth.c_1_ = -depth.c_1_, depth.d_ = -depth.d_;
  }
  depth.d_ <<= digits_z;
  return depth;
}

double ExactDepth::at(std::int32_t x) const { return quotient(numerator(x), d_); }

double ExactDepth::error_of(double z, std::int32_t x) const {
  if (!std::isfinite(z)) return z;
  const Dyadic parts = dyadic(z);
  Whole theirs = d_ * parts.mantissa, exact = numerator(x), below = d_;
  if (parts.digits > 0) exact <<= parts.digits, below <<= parts.digits;
  else theirs <<= -parts.digits;
  return quotient(theirs - exact, below);
}

int ExactDepth::compare(const ExactDepth& other, std::int32_t x) const {
  const Whole difference = numerator(x) * other.d_ - other.numerator(x) * d_;
  return difference.sign();
}

}  // namespace zstep::oracle
