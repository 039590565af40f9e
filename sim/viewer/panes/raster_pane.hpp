// What framebuffer and depth buffer share: zoom, pan, rulers, marks, the mouse.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/draw/raster_canvas.hpp"
#include "sim/viewer/ui.hpp"

namespace zstep::viewer {

/// Draws the raster into what is left of the pane. `refill` recolours the cells (called only when the state changed);
/// `cell_text` says what stands in a cell; `cell_tip` what the mouse is told there. With `question` a click on the
/// selected cell asks where its number comes from. With `counts`, one for each cell, cells smaller than a pixel show the
/// greatest one instead of the mean of their colours.
void draw_raster(Ui& ui, const char* id, float reserve_below, const std::function<void(std::vector<Pixel32>&)>& refill,
                 const std::function<std::string(std::size_t, int)>& cell_text, int most_decimals,
                 const std::function<std::vector<std::string>(Cell)>& cell_tip,
                 const std::function<std::optional<answers::Question>(Cell)>& question = {}, const std::vector<double>* counts = nullptr);

/// How many decimals a cell's numbers are written with, from `most` down to the fewest that say something: two, or all that they
/// have. `widest` tells the width of the widest of them; nullopt when not even the shortest has room.
std::optional<int> decimals_that_fit(int most, double room, const std::function<double(int)>& widest);

/// Marks over the raster: changed, selected, pointed at, now.
void draw_marks(Ui& ui, const RasterMap& map, ImVec2 origin);

}  // namespace zstep::viewer
