// Warnock's algorithm: quarter the picture until each area is simple.
//
// J. E. Warnock, "A Hidden Surface Algorithm for Computer Generated Halftone Pictures", TR 4-15, University of Utah,
// 1969; as taught in 002, "Warnock's Algorithm" (Foley, van Dam, Feiner and Hughes, section 15.7.1). Departures from
// the page: a single pixel is decided at its own centre, where 002 says "at the center of the polygon"; rasters need
// not be powers of two; and what surrounds or misses an area is not tested again in its quarters.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/pieces/pieces.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of Warnock's algorithm.

#define ZSTEP_MODULE warnock
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/warnock/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::warnock {

// An area of the picture, and how a polygon lies to it.
//
// The area of the pixels first_column <= x < end_column, first_row <= y < end_row is the rectangle of their squares:
// half a pixel wider than their centres on each side, edges included. So an edge that does not meet the area stays half
// a pixel away from every centre in it, and no rounding can put a centre on the wrong side. What a polygon covers is
// decided at the centres, with the bits of scan conversion (top-left rule).

struct Area {
  std::int32_t first_column, first_row, end_column, end_row;

  bool is_pixel() const { return end_column - first_column == 1 && end_row - first_row == 1; }
};

/// The area's quarters: upper left, upper right, lower left, lower right. An odd row or column goes to the second half;
/// an area one pixel wide or high has two.
std::vector<Area> quarters(const Area& area);

/// A polygon's outline on the raster.
class Shape {
 public:
  explicit Shape(const std::vector<glm::dvec3>& corners);

  /// The bin of this polygon in an area. With `boxes`, its bounding box is asked first: it knows the disjoint ones that
  /// lie well away, and all contained ones.
  struct Judgement : formulas::Crossed {  ///< counts are -1 where the box decided
    bool by_box = false;
  };
  Judgement judge(const Area& area, bool boxes) const;

  bool covers(double x, double y) const { return formulas::covers(edges_, x, y); }
  /// Where edges cross the line of centres of row y, from left to right: it covers the centres x with
  /// crossings[0] <= x < crossings[1] and so on.
  void find_crossings(std::int32_t y, std::vector<double>& crossings) const;
  std::int32_t edge_count() const { return size32(edges_); }

 private:
  std::vector<formulas::Segment> edges_;
  glm::dvec2 low_, high_;
};

inline constexpr std::array options{
    Option{"boxes", "off|on", "off", "bounding boxes tell disjoint and contained polygons first"}};

/// Draws the scene. Nearest wins; of depths equal to twelve digits the polygon that comes first.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::warnock
