// Paints a raster's cells into a canvas of a pane's size.
#pragma once

#include <vector>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/model/raster_view.hpp"

namespace zstep::viewer {

/// A cell without a colour of its own: drawn hatched.
inline constexpr Pixel32 hatched_cell = 0;

struct RasterInk {
  Pixel32 outside, grid, hatch, hatch_line;
};

/// `cells` is row-major, row 0 first; cells smaller than a pixel are averaged. Draws a grid when cells are large
/// enough. With `counts`, one for each cell and NaN for none, a pixel shows the colour of the greatest one under it
/// instead: a single marked cell stays in sight, and no colour is shown that is not on the scale.
void paint_raster(Canvas& canvas, const RasterMap& map, const std::vector<Pixel32>& cells, const RasterInk& ink,
                  const std::vector<double>* counts = nullptr);

inline constexpr double grid_from = 5;      ///< pixels a cell needs for a grid
inline constexpr double numbers_from = 16;  ///< … for numbers to be tried

}  // namespace zstep::viewer
