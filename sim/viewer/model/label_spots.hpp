// Where a polygon's letter goes in a picture whose pixels are too small for letters of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/viewer/model/moment.hpp"
#include "sim/viewer/model/raster_view.hpp"
#include "sim/viewer/model/summary.hpp"
#include "traces/file/header.hpp"

namespace zstep::viewer {

struct LabelSpot {
  std::int32_t polygon = no_polygon;
  Cell cell;                ///< the pixel that lies farthest inside what is seen of the polygon
  std::int64_t pixels = 0;  ///< how many of it are seen, about
};

/// One for each polygon that is seen in this part of the framebuffer, the largest first.
void find_label_spots(std::vector<LabelSpot>& spots, const RasterMap& map, const Moment& moment);
void find_label_spots(std::vector<LabelSpot>& spots, const RasterMap& map, const Picture& picture);

// Which lines of the pseudo-code matter at a step: what a class is shown, and what stays where there is no room for
// all.

/// The line at work, the lines it stands in, its neighbours in the same block and what it holds. Where it stands in its
/// block alone, the neighbours of the line around it, too, as one of them comes next.
std::vector<bool> lines_near(const Page& page, std::size_t now);

// Why the timeline shows no scan lines where a method has some.

/// Of an interval without scan lines, at a position in it: "no scan lines of polygon K yet".
std::string why_no_lines(const Trace& trace, const ScanLineMarks::Interval& interval, std::int64_t position);

}  // namespace zstep::viewer
