// How far the attributes of a run are from the exact ones: from the edges' vertices as the trace has them, in
// fractions, by the formulas of traces/formulas/attributes.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::oracle {

struct AttributeErrors {
  std::int64_t attributes = 0;  ///< that were interpolated and have an exact one
  std::int64_t not_judged = 0;  ///< of which the trace does not have span and edges
  std::int64_t not_finite = 0;  ///< NaN and infinities, whose error is infinite
  // Off the attribute that the polygon itself has.
  double largest = 0, sum_of_squares = 0;
  std::int64_t largest_step = 0;
  double rounding = 0;                    ///< the largest error by rounding alone: off what the run's formulas give
  std::vector<double> rounding_of_pixel;  ///< [height*width], Picture::at: the same of the last one there; NaN: none
  double root_mean_square() const;
};

/// Throws InputError where the trace cannot be read.
AttributeErrors attribute_errors_of(const Trace& trace);

}  // namespace zstep::oracle
