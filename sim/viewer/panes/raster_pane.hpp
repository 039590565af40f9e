// What framebuffer and depth buffer share: zoom, pan, marks, the mouse.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

struct RasterTalk {
  std::function<std::optional<answers::Question>(Cell)> question = {};  ///< what a click on the selected pixel asks
  bool polygons = false;  ///< pixels have the colours of polygons: each polygon gets its letter where they are too
                          ///< small for one each
};

/// Draws the raster into what is left of the pane. `cell_text` says what stands in a pixel, with so many decimals,
/// if anything; `cell_tip` what the mouse shows there.
void draw_raster(Ui& ui, const char* id, float reserve_below, const Kept<Cells>& cells,
                 const std::function<std::string(std::size_t, int)>& cell_text,
                 const std::function<std::vector<std::string>(Cell)>& cell_tip, const RasterTalk& talk);

}  // namespace zstep::viewer
