// Vertices and edges in the scene that is seen from outside: which one the mouse would pick, and how the picked one is
// shown.
#pragma once

#include "sim/viewer/model/scene_parts.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// What a click there would pick: a vertex within reach, or else an edge; what is seen before what a polygon hides.
ScenePart part_under(const Ui& ui, const Outside& outside, const Room& room, const Picture& seen, ImVec2 mouse,
                     ImVec2 at);
/// Draws what is picked filled, and what would be picked hollow; picks it on a click. True where there is something
/// under the mouse.
bool pick_parts(Ui& ui, const Room& room, const Picture& seen, ImVec2 size, ImVec2 at);

}  // namespace zstep::viewer
