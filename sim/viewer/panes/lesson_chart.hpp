// The chart of a lesson's table, `focus: chart`: how numbers grow, a line for each row.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/panes/pane.hpp"

namespace zstep::viewer {

extern const Pane chart_pane;

/// What it shows at the lesson's stop, a line for each sentence; nothing where that is not about a chart.
std::vector<std::string> chart_told(const Session& session);

}  // namespace zstep::viewer
