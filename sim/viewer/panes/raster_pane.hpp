// What framebuffer and depth buffer share: zoom, pan, rulers, marks, the mouse.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/draw/raster_canvas.hpp"
#include "sim/viewer/ui.hpp"

namespace zstep::viewer {

/// Draws the raster into what is left of the pane. `refill` recolours the cells (called only when the state changed);
/// `cell_text` says what stands in a cell; `cell_tip` what the mouse is told there. With `question` a click on the
/// selected cell asks where its number comes from.
void draw_raster(Ui& ui, const char* id, float reserve_below, const std::function<void(std::vector<Pixel32>&)>& refill,
                 const std::function<std::string(std::size_t, int)>& cell_text, int most_decimals,
                 const std::function<std::vector<std::string>(Cell)>& cell_tip,
                 const std::function<std::optional<answers::Question>(Cell)>& question = {});

/// Marks over the raster: changed, selected, pointed at, now.
void draw_marks(Ui& ui, const RasterMap& map, ImVec2 origin);

}  // namespace zstep::viewer
