// How far the depths of a run are from the exact ones, and what that decided.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::oracle {

/// Of the depths of one polygon, or of all.
struct ErrorOf {
  std::int32_t polygon = no_polygon;
  std::int64_t depths = 0;        ///< that were computed and could be held against the exact ones
  double largest = 0;             ///< error in units of the last digit of the number format
  double largest_depth = 0;       ///< the same in units of depth
  double sum_of_squares = 0;      ///< of the errors in last digits
  std::int64_t decided_wrong = 0; ///< compares that the exact depths decide otherwise
  double root_mean_square() const;
};

/// A compare that the exact depths decide otherwise.
struct WrongDecision {
  std::int64_t step = 0;
  std::int32_t x = 0, y = 0, polygon = no_polygon;
  double z = 0, stored = 0;              ///< as they were compared
  double z_exact = 0, stored_exact = 0;  ///< rounded once
};

struct Errors {
  ErrorOf all;
  std::vector<ErrorOf> polygons;        ///< by their number; those without depths are left out
  std::int64_t not_judged = 0;          ///< depths of which the trace does not have span and edges
  std::int64_t steepest_step = 0;       ///< with the largest error
  std::vector<WrongDecision> decisions; ///< the first ones, at most 100
  std::int64_t wrong_pixels = 0;        ///< that show another polygon than the one that is exactly the nearest
  std::vector<double> of_pixel;  ///< [height*width], Picture::at: error of the stored depth in last digits; NaN: none
};

/// Goes through a run that interpolates along spans. `on_way` is told the steps that are done now and then; true ends
/// it. The light's pass is left out. Throws InputError where the trace cannot be read.
Errors errors_of(const Trace& trace, const std::function<bool(std::int64_t)>& on_way = nullptr);

}  // namespace zstep::oracle
