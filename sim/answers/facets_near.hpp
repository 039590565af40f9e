// Which facets of a scene could cover a pixel, by squares of the raster.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::answers {

class FacetsNear {
 public:
  /// Looks at each facet once.
  explicit FacetsNear(const Trace& trace);

  /// All facets that could cover this pixel, and some others; in order.
  std::vector<std::int32_t> near(Trace::Pixel pixel) const;

 private:
  std::int32_t squares_across_ = 0;
  std::vector<std::size_t> first_;       ///< of each square, where its facets begin; one more at the end
  std::vector<std::int32_t> facets_;     ///< square after square
  std::vector<std::int32_t> anywhere_;   ///< facets with a corner that is not before the eye
};

}  // namespace zstep::answers
