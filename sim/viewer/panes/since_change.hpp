// What is otherwise than in the run before the last change: the mark that pixels have, for parts of tables and
// pictures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/viewer/panes/number_table.hpp"

namespace zstep::viewer {

/// Marks the cells that this run's rows have otherwise, by more than rounding, and rows that it did not have.
void mark_changed(Ui& ui, std::vector<TableRow>& rows, std::vector<TableRow> (*rows_of)(Ui&));

/// The same for a picture whose parts are described as rows: what was, by what a row is about; only of what changed.
using ChangedParts = std::map<std::string, std::vector<std::string>>;
ChangedParts changed_parts(Ui& ui, std::vector<TableRow> (*rows_of)(Ui&));

/// With its lower left corner there, no larger than its room; how large it is.
float draw_change_mark(Ui& ui, ImVec2 corner, float room);
/// Marks the part that lies between these corners where it changed, and tells what was when the mark is pointed at.
void mark_part(Ui& ui, const ChangedParts& parts, const std::string& about, ImVec2 low, ImVec2 high);

/// "before the change: 0.5".
std::string was_text(const std::string& was);

}  // namespace zstep::viewer
