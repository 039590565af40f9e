// The law of agreement's judge: may a method show this polygon at this pixel, and why do two pictures differ there?
//
// The rule, for all exact methods alike: at a pixel's centre the nearest facet is seen, but
// - a facet with an edge within 1.5/256 px of the centre may count as covering it or not;
// - of facets whose depths z_v there differ by no more than 1e-5 of the depth, any may be seen.
// Each difference must follow from these two with the polygons at that very pixel, not from some other edge nearby.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/truth/truth.hpp"
#include "traces/scene.hpp"

namespace zstep::compare {

inline constexpr double tie_tolerance = 1e-5;    ///< of the depth
inline constexpr double depth_tolerance = 1e-9;  ///< of the depth, for what stands in a depth buffer in float64
inline constexpr double depth_shift = 1e-9;      ///< pixels by which a line of sight may be off for the same reason

enum class Reason : std::uint8_t {
  none,   ///< it is the nearest, and nothing else could be seen
  edge,   ///< an edge runs within edge_tolerance
  tie,    ///< two depths are equal within tie_tolerance
  wrong,  ///< it cannot be seen there: unexplained
};

struct Explanation {
  Reason reason = Reason::none;
  std::string text;  ///< "edge of polygon 7 at distance 0.0021 px", "tie of 3 and 9: relative depth difference 2e-16"
};

/// Why `polygon` (or no_polygon) may or may not be seen at a pixel.
Explanation explain(const Truth& truth, std::int32_t x, std::int32_t y, std::int32_t polygon);

/// A pixel at which something is to be explained.
struct Difference {
  std::int32_t x = 0, y = 0, one = no_polygon, other = no_polygon;
  Explanation explanation;
};

/// What became of a picture's pixels.
struct Verdict {
  int equal = 0;  ///< pixels that needed no explanation and show a polygon
  int empty = 0;  ///< … and show none
  int at_edges = 0, ties = 0;
  int unexplained = 0, wrong_depths = 0;
  double worst_depth = 0;               ///< largest relative error of the depths that are right
  std::vector<Difference> differences;  ///< the explained and the unexplained ones, in the order of rows

  bool holds() const { return unexplained == 0 && wrong_depths == 0; }
  int explained() const { return at_edges + ties; }
  /// The unexplained ones, a line each, no more than `most`.
  std::string complaints(std::size_t most = 5) const;
};

/// Lists each pixel at which two pictures of the scene differ in their polygon. Those pixels must be wanted of `truth`.
Verdict explain_difference(const Truth& truth, const Picture& one, const Picture& other);
Verdict explain_difference(const Scene& scene, const Conventions& conventions, const Picture& one,
                           const Picture& other);

/// Holds one picture against what is visible by brute force (`one` is the picture's polygon, `other` the nearest one).
/// With `depths`, each stored depth must be that of the polygon's plane, too, within depth_tolerance and what a shift
/// of the line of sight by depth_shift makes of it.
Verdict hold_against_truth(const Truth& truth, const Scene& scene, const Conventions& conventions,
                           const Picture& picture, bool depths = true);

}  // namespace zstep::compare
