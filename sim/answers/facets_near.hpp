// What the history of any pixel asks of a whole trace, found once: which facets of the scene could cover the pixel, by
// squares of the raster, and on which polygons work never begins.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::answers {

class FacetsNear {
 public:
  /// Looks at each facet and each polygon's beginning once.
  explicit FacetsNear(const Trace& trace);

  /// All facets that could cover this pixel, and some others; in order.
  std::vector<std::int32_t> near(Trace::Pixel pixel) const;

  /// By polygon: work on it begins. Empty where it begins on all, or others than these are drawn or dropped.
  const std::vector<bool>& begun() const { return begun_; }

 private:
  std::int32_t squares_across_ = 0;
  std::vector<std::size_t> first_;      ///< of each square, where its facets begin; one more at the end
  std::vector<std::int32_t> facets_;    ///< square after square
  std::vector<std::int32_t> anywhere_;  ///< facets with a corner that is not before the eye
  std::vector<bool> begun_;
};

}  // namespace zstep::answers
