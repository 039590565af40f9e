// The first half of run_fast: from the scene to the outlines that are drawn.
#pragma once

#include <cstddef>
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
  std::int32_t row, end_row;  ///< the scan lines that it meets, on the raster
};

/// A part of a list: from `first` on, up to but not including `end`.
struct Range {
  std::size_t first, end;
};
/// The k-th of `parts` parts of a list of `count`; each begins at a multiple of `step`.
Range part_of(std::size_t count, std::size_t k, std::size_t parts, std::size_t step);

/// The outlines of a scene, found in three turns: view() for all parts of its points, find() for all parts of its
/// facets, and finish(), once. Calls within one of the first two turns may run at the same time.
class Outlines {
 public:
  Outlines(const Scene& scene, const Conventions& conventions, std::size_t parts);
  void view(std::size_t part);
  void find(std::size_t part);
  /// Those facets that want clipping, or a closer look, by the taught code.
  void finish();

  const Scene& scene;
  const Conventions& conventions;
  std::vector<RasterPoint> points;              ///< the scene's by index, then those that clipping made
  std::vector<std::int32_t> made;               ///< corners of the outlines that were clipped; indices into points, too
  std::vector<std::vector<FastOutline>> parts;  ///< after finish(): what find_outline gives, in the order of drawing
};

}  // namespace zstep::z_buffer
