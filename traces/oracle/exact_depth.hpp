// The depth of a span without any rounding: from its edges' vertices as the trace has them, in whole numbers of any
// size; where a run records no vertices, by the plane that is seen.
//
// All that interpolation does is + − × ÷, so from doubles, which are fractions, the exact depth is a fraction, too.
// Along one scan line it is a quotient of two linear functions of x with whole coefficients, found once a span; where
// the depth itself is linear, the one below is a constant.
#pragma once

#include <cstdint>
#include <optional>

#include <boost/multiprecision/cpp_int.hpp>

#include "traces/conventions.hpp"
#include "traces/oracle/exact_geometry.hpp"
#include "traces/scene.hpp"

namespace zstep::oracle {

using Whole = boost::multiprecision::cpp_int;

/// A vertex on the raster, with its depth.
struct Vertex {
  double x = 0, y = 0, z = 0;
};
struct Edge {
  Vertex from, to;
};

/// What is linear on the raster, and what the depth is then.
enum class Along : std::uint8_t {
  depth,             ///< the depth of the vertices, and the depth is that
  reciprocal,        ///< what the vertices have, and the depth is its reciprocal: 1/z_v gives z_v
  through_inverses,  ///< the reciprocals of the vertices' depths: z_v as it is on the surface, in perspective
};

/// numerator/denominator, rounded once to a double; the denominator is not 0.
double quotient(const Whole& numerator, const Whole& denominator);

class ExactDepth {
 public:
  /// Between two edges on scan line y. Nothing where an edge is horizontal or a number is not finite; or where a
  /// depth is 0 of which the reciprocal would be needed.
  static std::optional<ExactDepth> between(const Edge& left, const Edge& right, std::int32_t y,
                                           Along along = Along::depth);

  /// On scan line y of the plane through three vertices; nothing where they lie in a line on the raster. Of `along`,
  /// only depth and reciprocal.
  static std::optional<ExactDepth> on_plane(const Vertex& a, const Vertex& b, const Vertex& c, std::int32_t y,
                                            Along along = Along::depth);

  /// Between two edges whose ends are fractions: what cutting and clipping leave. Nothing where an edge is horizontal.
  static std::optional<ExactDepth> between(const Point& left_0, const Point& left_1, const Point& right_0,
                                           const Point& right_1, std::int32_t y, Along along = Along::depth);
  /// The same in every column.
  static ExactDepth of(const Rational& depth) { return linear(depth, 0, Along::depth); }

  /// The exact depth at column x; nothing where it is infinite.
  std::optional<Rational> exactly(std::int32_t x) const {
    const Whole under = below(x);
    return under == 0 ? std::nullopt : std::optional(Rational(above(x)) / Rational(under));
  }
  /// The same, rounded once.
  double at(std::int32_t x) const;
  /// By how much z is off there: z − exact, of which all digits of a double are right.
  double error_of(double z, std::int32_t x) const;
  /// The sign of the exact difference of two depths in column x: −1, 0, 1.
  int compare(const ExactDepth& other, std::int32_t x) const;

 private:
  static ExactDepth linear(const Rational& at_0, const Rational& slope, Along along);
  void finish(Along along, int digits_z, const Whole& product);
  Whole above(std::int32_t x) const { return a_0_ + a_1_ * x; }
  Whole below(std::int32_t x) const { return b_0_ + b_1_ * x; }
  Whole a_0_, a_1_ = 0, b_0_, b_1_ = 0;  ///< (a_0 + a_1 x)/(b_0 + b_1 x)
};

// The plane of a facet as it is seen: where a run does not record its vertices, its depths are held against that.

/// Found without rounding, then rounded once.
struct SeenPlane {
  double dz_dx = 0, dz_dy = 0;  ///< of the depth along the raster
  double bend = 0;              ///< by how much the depth of a corner is off the plane at most: of three corners, 0
};
/// Nothing where the plane is seen edge-on, has a corner in the plane of the eye, or where its depth is not linear on
/// the raster.
std::optional<SeenPlane> seen_plane(const Scene& scene, Conventions::Depth depth, std::int32_t facet);

}  // namespace zstep::oracle
