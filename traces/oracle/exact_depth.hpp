// The depth of a span without any rounding: from its edges' vertices as the trace has them, in whole numbers of any
// size.
//
// All that interpolation does is + − × ÷, so from doubles, which are fractions, the exact depth is a fraction, too.
// Along one scan line it is linear in x: (c_0 + c_1 x)/d with whole c_0, c_1, d, found once a span.
#pragma once

#include <cstdint>
#include <optional>

#include <boost/multiprecision/cpp_int.hpp>

namespace zstep::oracle {

using Whole = boost::multiprecision::cpp_int;

/// A vertex on the raster, with its depth.
struct Vertex {
  double x = 0, y = 0, z = 0;
};
struct Edge {
  Vertex from, to;
};

/// numerator/denominator, rounded once to a double; the denominator is positive.
double quotient(const Whole& numerator, const Whole& denominator);

class ExactDepth {
 public:
  /// Between two edges on scan line y. Nothing where an edge is horizontal or a number is not finite.
  static std::optional<ExactDepth> between(const Edge& left, const Edge& right, std::int32_t y);

  /// The exact depth at column x, rounded once.
  double at(std::int32_t x) const;
  /// By how much z is off there: z − exact, of which all digits of a double are right.
  double error_of(double z, std::int32_t x) const;
  /// The sign of the exact difference of two depths in column x: −1, 0, 1.
  int compare(const ExactDepth& other, std::int32_t x) const;

 private:
  Whole numerator(std::int32_t x) const { return c_0_ + c_1_ * x; }
  Whole c_0_, c_1_, d_;  ///< d_ > 0
};

}  // namespace zstep::oracle
