// The scene's pane as seen from outside: polygons, the run's eye, and what the step at work does in space.
#pragma once

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// Whether the scene is seen so: as the reader chose; else unless pieces are compared on the raster, as in depth sort,
/// or there are too many polygons to be drawn at every move.
bool seen_from_outside(const Ui& ui);
/// Whether its vertices can be pulled there: few enough to be told apart, and not given by a formula.
bool can_pull_vertices(const Scene& scene);
/// Draws it, and takes the mouse: drag, wheel, and what is pointed at.
void draw_outside(Ui& ui, ImVec2 size);

}  // namespace zstep::viewer
