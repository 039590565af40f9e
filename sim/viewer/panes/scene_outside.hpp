// The scene's pane as seen from outside: polygons, the run's eye, and what the step at work does in space.
#pragma once

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// Whether the scene is seen so: as the reader chose; else unless pieces are compared on the raster, as in depth sort,
/// or there are too many polygons to be drawn at every move.
bool seen_from_outside(const Ui& ui);
/// Whether its vertices can be pulled there: few enough to be told apart, and not given by a formula.
bool can_pull_vertices(const Scene& scene);
/// Letters of polygons, then the other words, each where no other stands.
void write_words(Ui& ui, const OutsideSeen& seen, const ChartPicture& picture, ImVec2 at);
/// The mouse over the last item, which is of this size, turns what is seen, moves it and brings it nearer.
void walk_round(Ui& ui, Look& look, ImVec2 size, const char* help);
/// Draws it, and takes the mouse: drag, wheel, and what is pointed at.
void draw_outside(Ui& ui, ImVec2 size);

}  // namespace zstep::viewer
