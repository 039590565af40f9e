// What stands in the room of a scene beside its polygons, and what the step at work does there.
#pragma once

#include <optional>

#include "sim/viewer/panes/room_pen.hpp"

namespace zstep::viewer {

/// Edges, axes, the eye with its window and planes, the lamp; then what is at work. `cell`: the pixel.
void draw_in_space(RoomPen& pen, const Moment& now, const std::optional<Cell>& cell);

}  // namespace zstep::viewer
