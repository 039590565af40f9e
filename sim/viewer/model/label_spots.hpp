// Where a polygon's letter goes in a picture whose pixels are too small for letters of their own.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/viewer/model/moment.hpp"
#include "sim/viewer/model/raster_view.hpp"

namespace zstep::viewer {

struct LabelSpot {
  std::int32_t polygon = no_polygon;
  Cell cell;                ///< the pixel that lies farthest inside what is seen of the polygon
  std::int64_t pixels = 0;  ///< how many of it are seen, about
};

/// One for each polygon that is seen in this part of the framebuffer, the largest first.
void find_label_spots(std::vector<LabelSpot>& spots, const RasterMap& map, const Moment& moment);
void find_label_spots(std::vector<LabelSpot>& spots, const RasterMap& map, const Picture& picture);

}  // namespace zstep::viewer
