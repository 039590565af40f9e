// The number types of the laboratory: their rounding, and the bounds that go with it.
#include "algorithms/interpolation/interpolation.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "traces/formulas/attributes.hpp"
#include "traces/formulas/outlines.hpp"

using namespace zstep;

namespace {

TEST_CASE("fixed point: a quotient is the nearest unit, or the one below, whatever the signs") {
  using detail::quotient;
  using enum Conventions::Rounding;
  CHECK(static_cast<int>(quotient(7, 2, nearest)) == 4);  // halves upwards
  CHECK(static_cast<int>(quotient(-7, 2, nearest)) == -3);
  CHECK(static_cast<int>(quotient(7, -2, nearest)) == -3);
  CHECK(static_cast<int>(quotient(7, 2, down)) == 3);
  CHECK(static_cast<int>(quotient(-7, 2, down)) == -4);
  CHECK(static_cast<int>(quotient(8, 3, nearest)) == 3);
  CHECK(static_cast<int>(quotient(-8, 3, nearest)) == -3);
  CHECK(static_cast<int>(quotient(-6, 3, down)) == -2);
}

TEST_CASE("fixed point: a line rounds once, at its end") {
  // 1 + (2 - 1)(1 - 0)/(3 - 0) in depths of 1/16: 21.33 sixteenths.
  const auto z = [](double value) { return FixedNearest::of(value, 1.0 / 16); };
  const FixedNearest third = formulas::on_line(z(1), z(2), FixedNearest(1), FixedNearest(0), FixedNearest(3));
  CHECK(static_cast<double>(third) == 21.0 / 16);
  CHECK(static_cast<double>(formulas::slope(z(1), z(2), FixedNearest(0), FixedNearest(3))) == 5.0 / 16);
  // Three slopes added are 15 sixteenths, not 16: what increments lose.
  FixedNearest along = z(1);
  for (int k = 0; k < 3; ++k) along += formulas::slope(z(1), z(2), FixedNearest(0), FixedNearest(3));
  CHECK(static_cast<double>(along) == 31.0 / 16);
}

TEST_CASE("fixed point: numbers out of range stay at its end") {
  CHECK(static_cast<double>(FixedNearest::of(1e300, 1)) == detail::most_units);
  CHECK(static_cast<double>(FixedNearest::of(-1e300, 1)) == -detail::most_units);
  CHECK(static_cast<double>(FixedNearest::divided(1, 0, 1)) == 0);
}

template <class Fixed>
void hold_ends(double least, double size, double most) {
  const double unit = size / most;
  CHECK(Fixed::of(least, unit, least).units() == 0);
  CHECK(Fixed::of(least + size, unit, least).units() == most);
  for (const double units : {1.0, 3.0, std::floor(most / 3), most - 1})  // what is held is held again
    CHECK(Fixed::of(least + units * unit, unit, least).units() == units);
  CHECK(static_cast<double>(Fixed::of(least, unit, least)) == least);
  CHECK(static_cast<double>(Fixed::of(least + size, unit, least)) == doctest::Approx(least + size).epsilon(1e-15));
  const auto half = Fixed::of(least + size / 2, unit, least), first = Fixed::of(least, unit, least);
  CHECK(static_cast<double>(half - first) == (half.units() - first.units()) * unit);  // no origin left
}

TEST_CASE("fixed point: the least depth is 0, the greatest 2^N - 1, nearest or cut off") {
  std::mt19937_64 random(65535);
  std::uniform_real_distribution<double> least(-100, 100), exponent(-3, 12);
  for (const int bits : {16, 18, 20, 24, 32})
    for (int k = 0; k < 200; ++k) {
      const double from = k == 0 ? -1 : least(random), size = k == 0 ? 2 : std::exp2(exponent(random));
      CAPTURE(bits);
      CAPTURE(from);
      CAPTURE(size);
      hold_ends<FixedNearest>(from, size, std::ldexp(1.0, bits) - 1);
      hold_ends<FixedDown>(from, size, std::ldexp(1.0, bits) - 1);
    }
}

/// The largest error, as a share of its bound, of many random spans; `adds`: by increments.
template <class T>
double worst_share(bool adds, int spans, const scan_conversion::NumbersOf<T>& numbers) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(0, 8), width(0.5, 40), depth(-1, 1);
  double worst = 0;
  for (int k = 0; k < spans; ++k) {
    const double from = place(random), wide = width(random), near = depth(random);
    // Of every tenth span the depths are next to each other: then the last digit is all there is.
    const double far = k % 10 == 0 ? near + 1e-5 * depth(random) : depth(random);
    const Bounded<T> x_left(numbers.position(from), 0), x_right(numbers.position(from + wide), 0),
        z_left(numbers.depth(near), 0), z_right(numbers.depth(far), 0);
    const double x_0 = x_left, x_1 = x_right, z_0 = z_left, z_1 = z_right;
    const int first = static_cast<int>(std::ceil(x_0)), last = static_cast<int>(std::ceil(x_1)) - 1;
    if (x_0 == x_1 || first > last) continue;
    Bounded<T> z = interpolation::depth_on(x_left, z_left, x_right, z_right, adds ? first : last);
    if (adds) {
      const Bounded<T> slope = formulas::slope(z_left, z_right, x_left, x_right);
      for (int x = first; x < last; ++x) z += slope;
    }
    // What long double, of 64 bits, has of it is exact for what a bound of 53 bits or fewer can tell.
    const long double exact = static_cast<long double>(z_0) + (static_cast<long double>(z_1) - z_0) *
                                                                  (static_cast<long double>(last) - x_0) /
                                                                  (static_cast<long double>(x_1) - x_0);
    const double off = static_cast<double>(std::abs(static_cast<long double>(static_cast<double>(z)) - exact));
    worst = std::max(worst, z.error > 0 ? off / z.error : off);
  }
  return worst;
}

/// For each format and each way; by hand another number.
int how_many(int usual) {
  const char* by_hand = std::getenv("ZSTEP_BOUNDS");
  return by_hand ? std::atoi(by_hand) : usual;
}
void hold(const std::string& format, double share) {
  CAPTURE(format);
  MESSAGE(format, ": ", share, " of the bound");
  CHECK(share <= 1.001);
  CHECK(share >= 0.25);
}

TEST_CASE("bounds: of random spans in each format none is farther off than its bound, and some are a quarter as far") {
  const int spans = how_many(250'000);
  const scan_conversion::NumbersOf<FixedNearest> fixed16{2 / (std::ldexp(1.0, 16) - 1), 1, -1},
      fixed32{2 / (std::ldexp(1.0, 32) - 1), 1, -1};
  const scan_conversion::NumbersOf<FixedDown> cut16{2 / (std::ldexp(1.0, 16) - 1), 1, -1};
  for (const bool adds : {false, true}) {
    CAPTURE(adds);
    hold("float64", worst_share<double>(adds, spans, {}));
    hold("float32", worst_share<float>(adds, spans, {}));
    hold("fixed16", worst_share<FixedNearest>(adds, spans, fixed16));
    hold("fixed32", worst_share<FixedNearest>(adds, spans, fixed32));
    hold("fixed16, cut off", worst_share<FixedDown>(adds, spans, cut16));
  }
}

/// The same of planes: of random triangles, at a random pixel inside; `adds`: from its first line to that line, and
/// along it from where the line before began.
template <class T>
double worst_share_of_planes(bool adds, int planes, const scan_conversion::NumbersOf<T>& numbers) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(0, 40), depth(-1, 1);
  double worst = 0;
  for (int k = 0; k < planes; ++k) {
    // Of every tenth plane the depths are next to each other; of every third one all vertices lie on pixels' centres.
    const double level = depth(random), range = k % 10 == 0 ? 1e-5 : 1;
    std::array<std::array<double, 3>, 3> v;
    for (auto& [x, y, z] : v) {
      x = place(random), y = place(random), z = k % 10 == 0 ? level + range * depth(random) : depth(random);
      if (k % 3 == 0) x = std::round(x), y = std::round(y);
      x = numbers.position(x), y = numbers.position(y), z = numbers.depth(z);
    }
    const auto known = [&](double value, bool is_depth) {
      return Bounded<T>(is_depth ? numbers.depth(value) : numbers.position(value), 0);  // as it was made above
    };
    const Bounded<T> x_0 = known(v[0][0], false), y_0 = known(v[0][1], false), z_0 = known(v[0][2], true);
    const Bounded<T> x_1 = known(v[1][0], false) - x_0, y_1 = known(v[1][1], false) - y_0,
                     z_1 = known(v[1][2], true) - z_0, x_2 = known(v[2][0], false) - x_0,
                     y_2 = known(v[2][1], false) - y_0, z_2 = known(v[2][2], true) - z_0;
    if (static_cast<double>(x_1 * y_2 - x_2 * y_1) == 0) continue;
    const Bounded<T> dz_dx = formulas::plane_slope(y_1, z_1, y_2, z_2, x_1, x_2),
                     dz_dy = formulas::plane_slope(x_1, z_1, x_2, z_2, y_1, y_2);
    // A pixel inside: by random weights of the vertices.
    std::uniform_real_distribution<double> weight(0, 1);
    const double a = weight(random), b = weight(random) * (1 - a);
    const int x = static_cast<int>(std::floor(v[0][0] + a * (v[1][0] - v[0][0]) + b * (v[2][0] - v[0][0]))),
              y = static_cast<int>(std::floor(v[0][1] + a * (v[1][1] - v[0][1]) + b * (v[2][1] - v[0][1])));
    const auto along = [&](std::int32_t column, std::int32_t line) {
      return formulas::along_plane(z_0, dz_dx, Bounded<T>(column), x_0, dz_dy, Bounded<T>(line), y_0);
    };
    Bounded<T> z = along(x, y);
    if (adds) {
      const int first_line = std::min(y, static_cast<int>(std::ceil(std::min({v[0][1], v[1][1], v[2][1]}))));
      const int from = static_cast<int>(std::floor(v[0][0]));
      z = along(from, first_line);
      for (int line = first_line; line < y; ++line) z += dz_dy;
      const int start = from < x ? from + static_cast<int>(weight(random) * (x - from)) : x;
      z = z + dz_dx * Bounded<T>(start - from);
      for (int column = start; column < x; ++column) z += dz_dx;
    }
    const auto of = [&](int vertex, int axis) {
      return static_cast<long double>(v[static_cast<std::size_t>(vertex)][static_cast<std::size_t>(axis)]) -
             v[0][static_cast<std::size_t>(axis)];
    };
    const long double det = of(1, 0) * of(2, 1) - of(2, 0) * of(1, 1);
    const long double exact = v[0][2] + ((of(1, 2) * of(2, 1) - of(2, 2) * of(1, 1)) * (x - v[0][0]) +
                                         (of(2, 2) * of(1, 0) - of(1, 2) * of(2, 0)) * (y - v[0][1])) /
                                            det;
    const double off = static_cast<double>(std::abs(static_cast<long double>(static_cast<double>(z)) - exact));
    worst = std::max(worst, z.error > 0 ? off / z.error : off);
  }
  return worst;
}

TEST_CASE("bounds: of random planes in each format none is farther off than its bound, and some are a quarter as far") {
  const int planes = how_many(20'000);
  const scan_conversion::NumbersOf<FixedNearest> fixed16{2 / (std::ldexp(1.0, 16) - 1), 1, -1},
      fixed32{2 / (std::ldexp(1.0, 32) - 1), 1, -1};
  const scan_conversion::NumbersOf<FixedDown> cut16{2 / (std::ldexp(1.0, 16) - 1), 1, -1};
  for (const bool adds : {false, true}) {
    CAPTURE(adds);
    hold("float64", worst_share_of_planes<double>(adds, planes, {}));
    hold("float32", worst_share_of_planes<float>(adds, planes, {}));
    hold("fixed16", worst_share_of_planes<FixedNearest>(adds, planes, fixed16));
    hold("fixed32", worst_share_of_planes<FixedNearest>(adds, planes, fixed32));
    hold("fixed16, cut off", worst_share_of_planes<FixedDown>(adds, planes, cut16));
  }
}

/// The same of attributes: of two random edges on a random scan line, at the pixel of the span between them that is
/// `share` of the way along.
struct EdgePair {
  struct End {
    double x, y, a, z;
  };
  std::array<End, 4> ends;  ///< of the left edge, of the right edge
  int line, pixel;
};
template <class T, class Position, class Depth>
T attribute_of(const EdgePair& of, bool divides, Position&& position, Depth&& depth) {
  const auto on_edge = [&](const EdgePair::End& p, const EdgePair::End& q) {
    const auto over = [&](const EdgePair::End& end) {
      const T a = depth(end.a);
      return divides ? formulas::over_depth<T>(a, depth(end.z)) : formulas::OverDepth<T>{a, T(1)};
    };
    const T y_0 = position(p.y), y_1 = position(q.y), y = T(of.line);
    return std::pair(formulas::on_line<T>(over(p), over(q), y, y_0, y_1),
                     formulas::on_line<T>(position(p.x), position(q.x), y, y_0, y_1));
  };
  const auto [left, x_left] = on_edge(of.ends[0], of.ends[1]);
  const auto [right, x_right] = on_edge(of.ends[2], of.ends[3]);
  const auto here = formulas::on_line<T>(left, right, T(of.pixel), x_left, x_right);
  return divides ? here.over_z / here.one_over_z : here.over_z;
}

template <class T>
double worst_share_of_attributes(bool divides, int spans, const scan_conversion::NumbersOf<T>& numbers) {
  std::mt19937_64 random(1992);
  std::uniform_real_distribution<double> left(0, 8), wide(1, 40), above(0.25, 12), attribute(-10, 10), exponent(-2, 3),
      share(0, 1);
  double worst = 0;
  for (int k = 0; k < spans; ++k) {
    EdgePair of{};
    of.line = 20;
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = i < 2 ? left(random) : 9 + wide(random);
      const double y = i % 2 == 0 ? of.line - above(random) : of.line + above(random);
      // Of every tenth span the depths are nearly equal, of every third one the attributes have one sign.
      const double z = std::exp2(k % 10 == 0 ? 1e-5 * exponent(random) : exponent(random));
      const double a = attribute(random);
      of.ends[i] = {numbers.position(x), numbers.position(y), numbers.depth(k % 3 == 0 ? std::abs(a) : a),
                    numbers.depth(z)};
    }
    of.pixel = 9 + static_cast<int>(share(random) * 3);
    const auto known = [](double value) { return Bounded<T>(static_cast<T>(value), 0); };
    const auto exactly = [](double value) { return static_cast<long double>(value); };
    const Bounded<T> a = attribute_of<Bounded<T>>(of, divides, known, known);
    const auto exact = attribute_of<long double>(of, divides, exactly, exactly);
    const double off = static_cast<double>(std::abs(static_cast<long double>(static_cast<double>(a)) - exact));
    worst = std::max(worst, a.error > 0 ? off / a.error : off);
  }
  return worst;
}

TEST_CASE(
    "bounds: of attributes on a million spans none is farther off than its bound, and some are a quarter as far") {
  const int spans = how_many(250'000);
  for (const bool divides : {false, true}) {
    CAPTURE(divides);
    hold("float64", worst_share_of_attributes<double>(divides, spans, {}));
    hold("float32", worst_share_of_attributes<float>(divides, spans, {}));
  }
}

}  // namespace
