// How far the depths of a run are from the exact ones, and what that decided.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::oracle {

/// Of the depths of one polygon, or of all.
struct ErrorOf {
  std::int32_t polygon = no_polygon;
  std::int64_t depths = 0;    ///< that were computed and could be held against the exact ones
  double largest = 0;         ///< error in units of the last digit of the number format
  double largest_depth = 0;   ///< the same in units of depth
  double sum_of_squares = 0;  ///< of the errors in last digits
  double largest_view = 0;    ///< in units of z_v
  double sum_of_squares_view = 0;
  std::int64_t decided_wrong = 0;  ///< compares that the exact depths decide otherwise than the run and its own numbers
  double root_mean_square() const;
  double root_mean_square_view() const;
};

/// A compare that the run decided as its own numbers do, and the exact depths decide otherwise.
struct WrongDecision {
  std::int64_t step = 0;
  std::int32_t x = 0, y = 0, polygon = no_polygon;
  double z = 0, stored = 0;              ///< as they were compared
  double z_exact = 0, stored_exact = 0;  ///< rounded once
  std::string z_digits, stored_digits;   ///< the exact ones, with as many digits as tell them apart
};

struct Errors {
  NumberFormat format{};    ///< whose digits are counted: as the header declares, else as the numbers look
  std::string format_text;  ///< "float64, as the header declares"
  double unit = 0;          ///< of fixed-point depths, else 0
  ErrorOf all;
  std::vector<ErrorOf> polygons;       ///< by their number; those without depths are left out
  std::int64_t not_judged = 0;         ///< depths of which nothing says what they are exactly
  std::int64_t by_polygon = 0;         ///< held against the polygon itself, as the trace has no span with its edges
  std::int64_t not_finite = 0;         ///< NaN and infinities, whose error is infinite
  std::int64_t not_finite_step = 0;    ///< the first of them
  std::int64_t stored_not_finite = 0;  ///< the same of what is written into the depth buffer
  std::int64_t stored_not_finite_step = 0;  ///< the first of them
  std::int64_t steepest_step = 0;           ///< with the largest error in last digits
  std::int64_t deepest_step = 0;            ///< with the largest one in depth
  std::vector<WrongDecision> decisions;     ///< the first ones, at most 100
  std::int64_t compares = 0;                ///< of which the exact outcome is known
  std::int64_t left_open = 0;               ///< of these, what conventions decide that the header does not declare
  std::int64_t wrong_pixels = 0;     ///< that show another polygon than the one that is exactly the nearest, and not
                                     ///< by a mistake: the run's own numbers say that it is not
  std::int64_t fighting_pixels = 0;  ///< in which a compare was decided otherwise
  std::vector<bool> fighting;        ///< [height*width], which these are
  struct Turned {
    double error = 0;               ///< in depth
    std::int32_t scene_facet = -1;  ///< whose plane in the scene says what it is exactly, -1 where something else does
  };
  std::vector<Turned> turned;       ///< [height*width], of the depths of such compares the one that is farthest off
  std::optional<double> least_gap;  ///< the smallest z_v by which two polygons that met in a pixel differ
  double gap_at = 0;                ///< and the z_v of the nearer of them
  /// Errors in last digits of the pixels of the longest span, and of the first pixels of spans on the lines of the
  /// longest left edge: what increments add up.
  std::vector<double> along_span, along_edge;
  std::vector<std::int32_t> polygon_of_pixel;  ///< [height*width], whose depth is stored at the end
  /// The facet whose plane in the scene its depth is held against; -1: the run has what it follows from on the raster.
  std::vector<std::int32_t> scene_facet_of_pixel;
  /// And its error in units of depth, infinite of what is not finite; NaN: nothing is stored, or nothing says what it
  /// is exactly.
  std::vector<double> depth_error_of_pixel;
  std::vector<double> of_pixel;  ///< [height*width], Picture::at: error of the stored depth in last digits; NaN: none
};

/// One depth of a span, held against the exact one.
struct DepthError {
  std::int64_t step = 0;  ///< that computed it
  std::int64_t span = 0;  ///< that began its span
  std::int64_t edge = 0;  ///< that put the span's left edge into the edge table
  std::int32_t x = 0, y = 0;
  std::int32_t along_span = 0;  ///< pixels from the first of the span
  std::int32_t along_edge = 0;  ///< scan lines from the first of the edge
  double z = 0;
  double error = 0;  ///< what was computed − what is exact, in last digits of the number format
};

/// What a depth is held against. The two differ where z_v is interpolated as if it were linear on the picture.
enum class Truth : std::uint8_t {
  formula,  ///< what the run's own formulas give without rounding
  surface,  ///< the depth of the polygon itself
};

/// Goes through a run that interpolates along spans, takes depths from planes, or casts rays. Where polygons are cut,
/// what cutting makes is exact, too; cut in the world, all vertices are followed from there, and rays begin in the eye
/// of the camera. A depth without a span and its edges is held against the plane by the slopes that the trace has, else
/// against the plane of the facet at work. `on_way` is told the steps that are done now and then; true ends it.
/// `on_depth` is told each depth of a span whose left edge the trace has. The light's pass is left out. Throws
/// InputError where the trace cannot be read.
Errors errors_of(const Trace& trace, const std::function<bool(std::int64_t)>& on_way = nullptr,
                 Truth truth = Truth::formula, const std::function<void(const DepthError&)>& on_depth = nullptr);

}  // namespace zstep::oracle
