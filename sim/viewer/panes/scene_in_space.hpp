// What stands in the room of a scene beside its polygons, and what the step at work does there.
#pragma once

#include <optional>

#include "sim/viewer/panes/room_pen.hpp"

namespace zstep::viewer {

/// Edges, axes, the eye with its window and planes, the lamp; then what is at work. `cell`: the pixel; `viewing`: 1 … 4
/// for the axes before and after T_1 … T_4, 0 for the world's.
void draw_in_space(RoomPen& pen, const Moment& now, const std::optional<Cell>& cell, int viewing);

}  // namespace zstep::viewer
