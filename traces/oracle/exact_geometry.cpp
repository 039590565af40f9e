#include "traces/oracle/exact_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "traces/formulas/lines.hpp"
#include "traces/oracle/exact_depth.hpp"

namespace zstep::oracle {

namespace {

Rational turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
const Point& next_of(Outline outline, std::size_t i) { return outline[i + 1 < outline.size() ? i + 1 : 0]; }

}  // namespace

Rational exactly(double value) {
  if (!std::isfinite(value)) throw std::domain_error("a number that is not finite");
  return Rational(value);
}
Point exactly(const glm::dvec3& point) { return {exactly(point.x), exactly(point.y), exactly(point.z)}; }

double rounded(const Rational& exact) { return quotient(Whole(numerator(exact)), Whole(denominator(exact))); }

std::string decimals_of(const Rational& exact, int count) {
  if (exact == 0) return "0";
  const Whole over = abs(Whole(numerator(exact))), under = denominator(exact);
  constexpr double tenfold = 0.30102999566398120;  // log10 2
  int exponent = static_cast<int>((static_cast<double>(msb(over)) - static_cast<double>(msb(under))) * tenfold);
  std::string digits;
  for (bool fits = false; !fits;) {
    Whole above = over, below = under;
    const int places = count - 1 - exponent;
    (places > 0 ? above : below) *= pow(Whole(10), static_cast<unsigned>(std::abs(places)));
    digits = Whole((2 * above + below) / (2 * below)).str();
    fits = static_cast<int>(digits.size()) == count;
    if (!fits) exponent += static_cast<int>(digits.size()) > count ? 1 : -1;
  }
  const std::string sign = exact < 0 ? "\u2212" : "";
  if (exponent < -6 || exponent >= count - 1)
    return sign + digits.substr(0, 1) + "." + digits.substr(1) + "e" + std::to_string(exponent);
  if (exponent < 0) return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  const auto whole = static_cast<std::size_t>(exponent + 1);
  return sign + digits.substr(0, whole) + "." + digits.substr(whole);
}

Rational floor(const Rational& exact) {
  const Rational towards_zero(Whole(Whole(numerator(exact)) / Whole(denominator(exact))));
  return exact < towards_zero ? Rational(towards_zero - 1) : towards_zero;
}
Rational ceil(const Rational& exact) { return -floor(-exact); }

double Plane::length() const { return std::sqrt(rounded(a * a + b * b + c * c)); }

Plane plane_of(std::span<const Point> corners) {
  Point normal{0, 0, 0}, sum = corners[0];
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (i + 1 < corners.size()) normal = normal + cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    sum = sum + corners[i];
  }
  return {normal.x, normal.y, normal.z, -dot(normal, sum) / Rational(corners.size())};
}

bool is_convex(Outline outline) {
  int way = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const int sign = turn(outline[i], next_of(outline, i), next_of(outline, (i + 1) % outline.size())).sign();
    if (sign != 0 && way != 0 && sign != way) return false;
    if (sign != 0) way = sign;
  }
  // Five corners and more may go round twice and turn one way all along.
  return way != 0 && outline.size() <= 4;
}

bool covers(Outline outline, const Rational& x, const Rational& y) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point &a = outline[i], &b = next_of(outline, i);
    if ((a.y <= y) == (b.y <= y)) continue;
    if (formulas::on_line(a.x, b.x, y, a.y, b.y) <= x) inside = !inside;
  }
  return inside;
}

bool meets(const Point& a, const Point& b, const Rational& x_0, const Rational& y_0, const Rational& x_1,
           const Rational& y_1) {
  if (std::max(a.x, b.x) < x_0 || std::min(a.x, b.x) > x_1 || std::max(a.y, b.y) < y_0 || std::min(a.y, b.y) > y_1)
    return false;
  bool above = false, below = false;
  for (const Rational& x : {x_0, x_1})
    for (const Rational& y : {y_0, y_1}) {
      const int side = turn(a, b, {x, y, 0}).sign();
      above = above || side >= 0, below = below || side <= 0;
    }
  return above && below;
}

Rational area_of(Outline outline) {
  Rational area = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) area += turn(outline[0], outline[i], outline[i + 1]);
  return area;
}

std::vector<Point> common_part(Outline one, Outline other) {
  const int way = area_of(other).sign();
  std::vector<Point> part(one.begin(), one.end());
  for (std::size_t i = 0; i < other.size() && way != 0; ++i) {
    std::vector<Point> kept;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Point &from = part[k], &to = next_of(part, k);
      const Point &a = other[i], &b = next_of(other, i);
      const Rational d_0 = turn(a, b, from) * way, d_1 = turn(a, b, to) * way;
      if (d_0 >= 0) kept.push_back(from);
      if (d_0.sign() * d_1.sign() >= 0) continue;
      const Rational t = formulas::where_zero(d_0, d_1);
      kept.push_back({formulas::part_of_way(from.x, to.x, t), formulas::part_of_way(from.y, to.y, t), 0});
    }
    part = std::move(kept);
    if (part.empty()) return part;
  }
  if (way == 0 || area_of(part) == 0) part.clear();
  return part;
}

}  // namespace zstep::oracle
