// The scene's pane as seen from outside: polygons, the run's eye, and what the step at work does in space.
#pragma once

#include "sim/viewer/model/outside.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/scene_in_space.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

// Vertices and edges in the scene that is seen from outside: which one the mouse would pick, and how the picked one is
// shown.

/// What a click there would pick: a vertex within reach, or else an edge; what is seen before what a polygon hides.
ScenePart part_under(const Ui& ui, const Outside& outside, const Room& room, const Picture& seen, ImVec2 mouse,
                     ImVec2 at);
/// Draws what is picked filled, and what would be picked hollow; picks it on a click. True where there is something
/// under the mouse.
bool pick_parts(Ui& ui, const Room& room, const Picture& seen, ImVec2 size, ImVec2 at);

// What the scene's pane shows of pieces: those that cutting made, and the pair under test.

/// The piece that the step is about, or that is being drawn; -1 if none.
std::int32_t piece_shown(const Moment& now);
/// Over the wireframe.
void draw_pieces(Canvas& canvas, const RasterMap& map, const Moment& now, const Theme& c, double thin);
/// P and Q, each with its letter at a vertex of its own; and where their projections were found to overlap. The places
/// that these take.
TakenPlaces label_pair(Ui& ui, const RasterMap& map, ImVec2 origin);

/// Whether the scene is seen so: as the reader chose; else unless pieces are compared on the raster, as in depth sort,
/// or there are too many polygons to be drawn at every move.
bool seen_from_outside(const Ui& ui);
/// Whether its vertices can be pulled there: few enough to be told apart, and not given by a formula.
bool can_pull_vertices(const Scene& scene);
/// Letters of polygons, then the other words, each where no other stands.
void write_words(Ui& ui, const OutsideSeen& seen, const ChartPicture& picture, ImVec2 at);
/// The mouse over the last item, which is of this size, turns what is seen, moves it and brings it nearer.
void walk_round(Ui& ui, Look& look, ImVec2 size, const char* help);
/// Draws it, and takes the mouse: drag, wheel, and what is pointed at. `canonical`: after the division by w.
void draw_outside(Ui& ui, ImVec2 size, bool canonical = false);

// The scene after the division by w.

/// What is left of the scene's polygons inside the view volume, at (x*, z*, y*): y* upwards, z* away from the reader.
/// Empty for a scene that is given on the screen.
Scene in_canonical_volume(const Scene& scene);
/// The cube from −1 to 1 with its axes, the polygon and the vertices at work, and what the lesson's stop names. Points
/// outside the view volume have no place in it.
void draw_canonical(RoomPen& pen, const Moment& now);

}  // namespace zstep::viewer
