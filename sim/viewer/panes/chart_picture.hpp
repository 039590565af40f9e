// Charts in a pane: the same lines and axes as in a file, with the window's letters.
#pragma once

#include "sim/viewer/charts/chart.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// Draws a chart into the rest of the pane. It is painted anew when the chart, its size, the letters or the colours are
/// others.
void draw_line_chart(Ui& ui, const char* name, const LineChart& chart);

}  // namespace zstep::viewer
