// Points, planes and outlines in fractions: what is decided about them has no rounding.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>
#include <glm/vec3.hpp>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/vectors.hpp"

namespace zstep::oracle {

/// A fraction. Without expression templates, so that `auto` holds a number as it does with doubles.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
using Point = formulas::Vector<Rational>;

/// As it is, every digit; throws std::domain_error where it is not finite.
Rational exactly(double value);
Point exactly(const glm::dvec3& point);
/// Rounded once to the nearest double.
double rounded(const Rational& exact);
/// So many digits, rounded: "0.3333", "\u22123.333e-12".
std::string decimals_of(const Rational& exact, int count);
/// The largest whole number that is not above it, and the least that is not below.
Rational floor(const Rational& exact);
Rational ceil(const Rational& exact);

/// A x + B y + C z + D; (A, B, C) of any length, so that there is no square root.
struct Plane {
  Rational a, b, c, d;
  Rational value(const Point& p) const { return a * p.x + b * p.y + c * p.z + d; }
  Rational depth(const Rational& x, const Rational& y) const { return -(a * x + b * y + d) / c; }
  double length() const;  ///< of (A, B, C)
};
/// Newell's normal through the mean of the corners.
Plane plane_of(std::span<const Point> corners);

using Outline = std::span<const Point>;  ///< on the raster; z is left out of account

/// Do the corners turn one way only?
bool is_convex(Outline outline);
/// Is (x, y) inside by the even-odd rule? Of edges the left and the upper ones count.
bool covers(Outline outline, const Rational& x, const Rational& y);
/// Does the edge from `a` to `b` meet the closed rectangle?
bool meets(const Point& a, const Point& b, const Rational& x_0, const Rational& y_0, const Rational& x_1,
           const Rational& y_1);
/// What two convex outlines have in common; empty where it has no area.
std::vector<Point> common_part(Outline one, Outline other);
/// Twice the area, with its sign.
Rational area_of(Outline outline);

}  // namespace zstep::oracle

namespace zstep::formulas {
template <>
inline oracle::Rational to_nearest(const oracle::Rational& x) {
  return oracle::floor(x + oracle::Rational(1, 2));
}
}  // namespace zstep::formulas
