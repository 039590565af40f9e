#include "traces/oracle/exact_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "traces/formulas/outlines.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/oracle/exact_geometry.hpp"

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

/// An edge on one scan line, in the scaled numbers: x = x/d, z = z/d. z_0 and z_1: what its ends have.
struct Crossing {
  Whole x, z, d;
};
Crossing crossing(const Edge& edge, const Whole& y, int digits_xy, const Whole& z_0, const Whole& z_1) {
  const Whole x_0 = scaled(edge.from.x, digits_xy), y_0 = scaled(edge.from.y, digits_xy), down = y - y_0;
  Crossing at;
  at.d = scaled(edge.to.y, digits_xy) - y_0;
  at.x = x_0 * at.d + down * (scaled(edge.to.x, digits_xy) - x_0);
  at.z = z_0 * at.d + down * (z_1 - z_0);
  if (at.d < 0) at.d = -at.d, at.x = -at.x, at.z = -at.z;
  return at;
}

}  // namespace

double quotient(const Whole& numerator, const Whole& denominator) {
  if (numerator == 0) return 0;
  // 64 bits of the quotient, the last of which also stands for all that is left: rounding these to a double rounds
  // once.
  Whole above = abs(numerator), below = abs(denominator), whole, left;
  const int shift = 63 - static_cast<int>(msb(above)) + static_cast<int>(msb(below));
  if (shift > 0) above <<= shift;
  else below <<= -shift;
  divide_qr(above, below, whole, left);
  const std::uint64_t bits = static_cast<std::uint64_t>(whole) | static_cast<std::uint64_t>(left != 0);
  const double value = std::ldexp(static_cast<double>(bits), -shift);
  return (numerator < 0) != (denominator < 0) ? -value : value;
}

namespace {

/// The digits behind the point that these vertices need; nothing where one is not finite.
struct DigitsOf {
  int xy = 0, z = 0;
};
std::optional<DigitsOf> digits_of(std::initializer_list<Vertex> vertices) {
  DigitsOf digits;
  for (const Vertex& vertex : vertices) {
    if (!std::isfinite(vertex.x) || !std::isfinite(vertex.y) || !std::isfinite(vertex.z)) return std::nullopt;
    digits.xy = std::max({digits.xy, dyadic(vertex.x).digits, dyadic(vertex.y).digits});
    digits.z = std::max(digits.z, dyadic(vertex.z).digits);
  }
  return digits;
}

}  // namespace

std::optional<ExactDepth> ExactDepth::on_plane(const Vertex& a, const Vertex& b, const Vertex& c, std::int32_t y,
                                               Along along) {
  const auto digits = digits_of({a, b, c});
  if (!digits) return std::nullopt;
  const Whole x_0 = scaled(a.x, digits->xy), y_0 = scaled(a.y, digits->xy), z_0 = scaled(a.z, digits->z);
  const Whole p_1 = scaled(b.x, digits->xy) - x_0, q_1 = scaled(b.y, digits->xy) - y_0,
              r_1 = scaled(b.z, digits->z) - z_0;
  const Whole p_2 = scaled(c.x, digits->xy) - x_0, q_2 = scaled(c.y, digits->xy) - y_0,
              r_2 = scaled(c.z, digits->z) - z_0;
  ExactDepth depth;
  depth.b_0_ = p_1 * q_2 - p_2 * q_1;
  if (depth.b_0_ == 0) return std::nullopt;
  const Whole slope_x = r_1 * q_2 - r_2 * q_1, slope_y = r_2 * p_1 - r_1 * p_2;  // over b_0
  depth.a_0_ = z_0 * depth.b_0_ - slope_x * x_0 + slope_y * ((Whole(y) << digits->xy) - y_0);
  depth.a_1_ = slope_x << digits->xy;
  depth.finish(along, digits->z, 1);
  return depth;
}

/// Of what is linear, scaled by 2^digits_z, makes the depth.
void ExactDepth::finish(Along along, int digits_z, const Whole& product) {
  if (along == Along::depth) {
    b_0_ <<= digits_z;
    return;
  }
  // The reciprocal, of what was scaled by 2^digits_z; through inverses, of 1/z times the product, which was scaled by
  // a third power and divides into a fourth.
  std::swap(a_0_, b_0_), std::swap(a_1_, b_1_);
  if (along == Along::reciprocal) a_0_ <<= digits_z;
  else a_0_ *= product, b_0_ <<= digits_z, b_1_ <<= digits_z;
}

std::optional<ExactDepth> ExactDepth::between(const Edge& left, const Edge& right, std::int32_t y, Along along) {
  const auto digits = digits_of({left.from, left.to, right.from, right.to});
  if (!digits || left.from.y == left.to.y || right.from.y == right.to.y) return std::nullopt;
  const int digits_xy = digits->xy, digits_z = digits->z;
  std::array<Whole, 4> z{scaled(left.from.z, digits_z), scaled(left.to.z, digits_z), scaled(right.from.z, digits_z),
                         scaled(right.to.z, digits_z)};
  Whole product = 1;
  if (along == Along::through_inverses) {  // 1/z is the product of the other three over that of all
    const std::array<Whole, 4> depths = z;
    for (std::size_t i = 0; i < z.size(); ++i) {
      product *= depths[i];
      z[i] = depths[(i + 1) % 4] * depths[(i + 2) % 4] * depths[(i + 3) % 4];
    }
    if (product == 0) return std::nullopt;
  }
  const Whole line = Whole(y) << digits_xy;
  const Crossing l = crossing(left, line, digits_xy, z[0], z[1]), r = crossing(right, line, digits_xy, z[2], z[3]);
  // z = z_L + (z_R − z_L)(x − x_L)/(x_R − x_L), over one denominator.
  const Whole width = r.x * l.d - l.x * r.d, rise = r.z * l.d - l.z * r.d;
  ExactDepth depth;
  if (width == 0) {
    depth.a_0_ = l.z, depth.b_0_ = l.d;
  } else {
    depth.a_0_ = l.z * width - rise * l.x, depth.a_1_ = rise * l.d << digits_xy, depth.b_0_ = l.d * width;
  }
  depth.finish(along, digits_z, product);
  return depth;
}

ExactDepth ExactDepth::linear(const Rational& at_0, const Rational& slope, Along along) {
  const Whole below_0 = denominator(at_0), below_1 = denominator(slope);
  ExactDepth depth;
  depth.a_0_ = Whole(numerator(at_0)) * below_1, depth.a_1_ = Whole(numerator(slope)) * below_0;
  depth.b_0_ = below_0 * below_1;
  depth.finish(along, 0, 1);
  return depth;
}

std::optional<ExactDepth> ExactDepth::between(const Point& left_0, const Point& left_1, const Point& right_0,
                                              const Point& right_1, std::int32_t y, Along along) {
  if (left_0.y == left_1.y || right_0.y == right_1.y) return std::nullopt;
  const Rational line(y);
  const auto on_edge = [&](const Point& a, const Point& b, Rational Point::*part) {
    return formulas::on_line(a.*part, b.*part, line, a.y, b.y);
  };
  const Rational x_left = on_edge(left_0, left_1, &Point::x), z_left = on_edge(left_0, left_1, &Point::z),
                 x_right = on_edge(right_0, right_1, &Point::x), z_right = on_edge(right_0, right_1, &Point::z);
  if (x_left == x_right) return linear(z_left, 0, along);
  const Rational slope = formulas::slope(z_left, z_right, x_left, x_right);
  return linear(z_left - slope * x_left, slope, along);
}

double ExactDepth::at(std::int32_t x) const {
  const Whole under = below(x);
  return under == 0 ? std::numeric_limits<double>::infinity() : quotient(above(x), under);
}

double ExactDepth::error_of(double z, std::int32_t x) const {
  Whole under = below(x);
  if (!std::isfinite(z) || under == 0) return z;
  const Dyadic parts = dyadic(z);
  Whole theirs = under * parts.mantissa, exact = above(x);
  if (parts.digits > 0) exact <<= parts.digits, under <<= parts.digits;
  else theirs <<= -parts.digits;
  return quotient(theirs - exact, under);
}

int ExactDepth::compare(const ExactDepth& other, std::int32_t x) const {
  const Whole under = below(x), other_under = other.below(x);
  const Whole difference = above(x) * other_under - other.above(x) * under;
  return difference.sign() * under.sign() * other_under.sign();
}

namespace {

/// A point of the scene on the raster, with its depth; nothing where it lies in the plane of the eye.
std::optional<Point> on_raster(const Scene& scene, Conventions::Depth depth, const glm::dvec3& at) {
  const Camera& camera = scene.camera;
  const Point p = exactly(at);
  if (camera.kind == Camera::Kind::screen) return p;
  const auto row = [&](int i) {
    const auto t = [&](int k) { return exactly(camera.view[k][i]); };
    return formulas::matrix_row(t(0), t(1), t(2), t(3), p.x, p.y, p.z);
  };
  Rational x = row(0), y = row(1);
  const Rational z_v = row(2), w_y = exactly(camera.window), width = scene.raster.width, height = scene.raster.height;
  if (camera.kind == Camera::Kind::perspective) {
    if (z_v == 0) return std::nullopt;
    x = formulas::projected(exactly(camera.d), x, z_v), y = formulas::projected(exactly(camera.d), y, z_v);
  }
  return Point{formulas::screen_x(x, formulas::window_width(w_y, width, height), width, scene.raster),
               formulas::screen_y(y, w_y, height, scene.raster), depth_of_view(camera, depth, z_v)};
}

}  // namespace

std::optional<SeenPlane> seen_plane(const Scene& scene, Conventions::Depth depth, std::int32_t facet) {
  const bool bent = depth == Conventions::Depth::corrected || depth == Conventions::Depth::view;
  if (bent && scene.camera.kind == Camera::Kind::perspective) return std::nullopt;
  ExactRays rays(scene, depth);
  const auto t = rays.meet(facet, 0, 0), t_x = rays.meet(facet, 1, 0), t_y = rays.meet(facet, 0, 1);
  if (!t || !t_x || !t_y) return std::nullopt;
  if (scene.camera.kind == Camera::Kind::perspective && (*t == 0 || *t_x == 0 || *t_y == 0)) return std::nullopt;
  const Rational z = rays.depth(*t), dz_dx = rays.depth(*t_x) - z, dz_dy = rays.depth(*t_y) - z;
  SeenPlane plane{rounded(dz_dx), rounded(dz_dy), 0};
  const Facet& shape = scene.facets[facet];
  for (std::int32_t i = 0; i < shape.corner_count; ++i) {
    const std::int32_t corner = scene.corners[shape.first_corner + i];
    const auto at = on_raster(scene, depth, scene.points[corner]);
    if (!at) return std::nullopt;
    plane.bend = std::max(plane.bend, std::abs(rounded(at->z - (z + dz_dx * at->x + dz_dy * at->y))));
  }
  return plane;
}

}  // namespace zstep::oracle
