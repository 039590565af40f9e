// The variant of 001, slide 12: "Requires a depth buffer equal to only one scan line". Every polygon that is active on
// the line is interpolated and compared pixel by pixel, as by the Z-buffer, but with all polygons on one line at a
// time.
#pragma once

#include "algorithms/scan_line/steps.hpp"
#include "algorithms/scan_line/tables.hpp"

namespace zstep::scan_line {

/// Draws scan line y into the picture. `line` is the depth buffer, one number a column; polygons come in their order,
/// and strictly nearer wins, so that the picture is the Z-buffer's to the bit. The picture's depths are kept for
/// comparison; the method never reads them.
template <Recorder R>
void draw_line(const Tables& tables, const std::vector<std::int32_t>& active, std::int32_t y, const Raster& raster,
               const Conventions& conventions, std::vector<double>& line, Picture& picture, R& record);

}  // namespace zstep::scan_line
