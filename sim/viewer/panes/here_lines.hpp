// What a right click offers on things that are seen in more than one pane.
#pragma once

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// On a pixel of a buffer; `depth`: what asks where its depth comes from.
std::vector<HereLine> lines_of_pixel(const Session& s, Cell cell, const std::optional<answers::Question>& depth);
/// On a vertex or an edge of the scene: the steps about it, its polygons, how to move it, and the line of the file.
std::vector<HereLine> lines_of_part(const Session& s, const ScenePart& part);
/// On a polygon: where the run begins work on it, and the line of the file that has it.
std::vector<HereLine> lines_of_polygon(const Session& s, std::int32_t polygon);

}  // namespace zstep::viewer
