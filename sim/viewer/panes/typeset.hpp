// Formulas set in type: fractions as fractions, what stands below a letter below it, the numbers under the symbols.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"
#include "sim/words/notation.hpp"

namespace zstep::viewer {

/// A formula's line at the cursor, broken at its equals signs; advances the cursor. Of `how` counts all but the font.
/// What is a polygon's is underlined in the polygon's colour, with dashes of its own; owner_key.hpp says whose.
void set_formula(Ui& ui, const std::string& line, const Flow& how, const std::vector<words::Owned>& owned = {});
/// Height that set_formula() would take.
float formula_height(Ui& ui, const std::string& line, const Flow& how);

/// The entries of a matrix, row by row, or those of a column.
using Entries = std::vector<std::vector<std::string>>;
/// Sets it in square brackets, in large or small type, with its upper left corner there.
void set_matrix(Ui& ui, ImVec2 at, const Entries& rows, bool small);
ImVec2 matrix_size(const Ui& ui, const Entries& rows, bool small);

}  // namespace zstep::viewer
