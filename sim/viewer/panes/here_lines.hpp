// What a right click offers on things that are seen in more than one pane.
#pragma once

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// On a pixel of a buffer; `depth`: what asks where its depth comes from.
std::vector<HereLine> lines_of_pixel(const Session& s, Cell cell, const std::optional<answers::Question>& depth);
/// On a polygon: where the run begins work on it, and the line of the file that has it.
std::vector<HereLine> lines_of_polygon(const Session& s, std::int32_t polygon);

}  // namespace zstep::viewer
