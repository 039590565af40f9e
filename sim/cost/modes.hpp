// Ways of interpolating beside each other on one scene: how far each is from exact, what it decides wrongly, what it
// costs (docs/interpolation.md).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/cost/operations.hpp"
#include "traces/oracle/attribute_errors.hpp"
#include "traces/scene.hpp"

namespace zstep::compare {

/// One way: some conventions, and the words that tell it from the others.
struct Mode {
  std::string text;  ///< "reciprocal, plane, fixed16"
  Conventions conventions;
};

/// Every combination of the words given for each convention: {"depth", {"view", "reciprocal"}}, … Those that the scene
/// cannot be drawn in are left out, with a line for each in `left_out`.
std::vector<Mode> modes_of(const Scene& scene, const Conventions& conventions,
                           const std::vector<std::pair<std::string, std::vector<std::string>>>& words,
                           std::vector<std::string>& left_out);

struct ModeErrors {
  std::int64_t depths = 0;           ///< that were computed and have an exact one
  double largest = 0, rms = 0;       ///< off the polygon itself, in units of z_v
  double rounding = 0;               ///< the largest error of rounding alone, in last digits of the number format
  double rounding_depth = 0;         ///< of the depths that stay in the buffer, in its own units;
  double bound = 0;                  ///< and what theory bounds it by: the largest of all pixels
  bool within_bounds = true;         ///< every stored depth is as near to its exact one as its own bound says
  std::int64_t wrong_pixels = 0;     ///< that do not show the nearest polygon
  std::int64_t fighting_pixels = 0;  ///< in which rounding turned a compare
  std::int64_t bent_pixels = 0;      ///< in which a compare goes wrong without rounding, as z_v is interpolated as if
                                     ///< it were linear on the picture
  std::optional<double> least_gap;   ///< the smallest z_v between polygons that met in a pixel
  double gap_at = 0;                 ///< and where
  double unit_at_gap = 0;            ///< how far apart in z_v two neighbouring numbers of the buffer are there
  Operations operations;
  oracle::AttributeErrors attribute;     ///< where one is interpolated
  Operations attribute_operations;       ///< and what that costs beyond the depths
  double attribute_bound = 0;            ///< what theory bounds its rounding by: the largest of all pixels
  bool attributes_within_bounds = true;  ///< each is as near to its exact one as its own bound says
};
ModeErrors errors_of_mode(const Scene& scene, const Mode& mode);

}  // namespace zstep::compare
