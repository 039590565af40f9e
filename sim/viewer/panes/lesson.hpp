// What a stop asks to be marked by hand: in the lesson's text, and over the buffers.
#pragma once

#include "sim/viewer/model/raster_view.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// What is asked, what came of it, and buttons to check and to be helped.
void draw_marking(Ui& ui, const Marking& marking);
/// Marked pixels, or the scan line: brackets at their corners; once checked, wrong ones are crossed out; what is right
/// has a dot, where it is shown.
void draw_hand_marks(Ui& ui, const RasterMap& map, ImVec2 origin);

}  // namespace zstep::viewer
