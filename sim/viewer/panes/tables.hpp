// The rows of panes' tables that a second run is held against (rows_of_both in number_table.hpp).
#pragma once

#include <vector>

#include "sim/viewer/panes/number_table.hpp"

namespace zstep::viewer {

/// The scan-line method's polygons, with planes and flags.
std::vector<TableRow> polygon_rows(Ui& ui);
/// The intervals of the edge at work, as faces hide it and as it is cut.
std::vector<TableRow> interval_rows(Ui& ui);
/// What the ray at work was held against.
std::vector<TableRow> ray_test_rows(Ui& ui);
/// The rays of the pixel at work.
std::vector<TableRow> ray_tree_rows(Ui& ui);
/// The nodes from the root of the BSP tree to the one at work.
std::vector<TableRow> path_rows(Ui& ui);

}  // namespace zstep::viewer
