// What the scene's pane shows of pieces: those that cutting made, and the pair under test.
#pragma once

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// The piece that the step is about, or that is being drawn; -1 if none.
std::int32_t piece_shown(const Moment& now);
/// Over the wireframe.
void draw_pieces(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, double thin);
/// P with its letter to its left, Q to its right; and where their projections were found to overlap.
void label_pair(Ui& ui, const RasterMap& map, ImVec2 origin);

}  // namespace zstep::viewer
