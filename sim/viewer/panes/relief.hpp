// The depth buffer as a relief: a column for each pixel, the nearer the higher, seen from outside; ∞ is the floor.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// So many columns at most to a side; a larger buffer has one for a block of pixels, as high as the nearest of them.
inline constexpr std::int32_t most_columns = 64;
/// How many pixels wide and high such a block is.
std::int32_t relief_block(const Raster& raster);

/// As a room: polygon 3 k is the top of column k, the next two are walls. Columns count along rows, from row 0.
Room relief_of(const Picture& picture, const Raster& raster, const DepthRange& range, const DepthScale& scale,
               Color floor);

/// Draws it, and takes the mouse: it is turned as the scene is, and a click selects a pixel. `tip`: what the
/// tooltip of a pixel says.
void draw_relief(Ui& ui, ImVec2 size, const DepthRange& range,
                 const std::function<std::vector<std::string>(Cell)>& tip);

}  // namespace zstep::viewer
