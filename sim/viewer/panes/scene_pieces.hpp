// What the scene's pane shows of pieces: those that cutting made, and the pair under test.
#pragma once

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// Over the wireframe.
void draw_pieces(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, double thin);
/// P with its letter to its left, Q to its right; and where their projections were found to overlap.
void label_pair(Ui& ui, const RasterMap& map, ImVec2 origin);

}  // namespace zstep::viewer
