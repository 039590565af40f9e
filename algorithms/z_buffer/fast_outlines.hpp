// The first half of run_fast: from the scene to the outlines that are drawn.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::z_buffer {

struct RasterPoint {
  double x, y, z;
  std::int32_t outside;  ///< outcode; `unsound` if it cannot be drawn
};

struct FastOutline {
  std::int32_t polygon;
  std::int32_t first, count;  ///< its vertices: Scene::corners[first .. first + count), or of Outlines::made
  bool clipped;               ///< which of the two
};

struct Outlines {
  std::vector<RasterPoint> points;    ///< the scene's by index, then those that clipping made
  std::vector<std::int32_t> made;     ///< corners of the outlines that were clipped; indices into points, too
  std::vector<FastOutline> outlines;  ///< in the order in which they are drawn
};

/// What find_outline gives for each facet that is to be drawn.
Outlines find_outlines(const Scene& scene, const Conventions& conventions);

}  // namespace zstep::z_buffer
