// Formulas set in type: fractions as fractions, what stands below a letter below it, the numbers under the symbols.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// A formula's line at the cursor, broken at its equals signs; advances the cursor. Of `how` counts all but the font.
void set_formula(Ui& ui, const std::string& line, const Flow& how);
/// Height that set_formula() would take.
float formula_height(Ui& ui, const std::string& line, const Flow& how);

/// The entries of a matrix, row by row, or those of a column.
using Entries = std::vector<std::vector<std::string>>;
/// Sets it in square brackets, in large or small type, with its upper left corner there.
void set_matrix(Ui& ui, ImVec2 at, const Entries& rows, bool small);
ImVec2 matrix_size(const Ui& ui, const Entries& rows, bool small);

}  // namespace zstep::viewer
