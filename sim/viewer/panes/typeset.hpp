// Formulas set in type: fractions as fractions, what stands below a letter below it, the numbers under the symbols.
#pragma once

#include <string>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// A formula's line at the cursor, broken at its equals signs; advances the cursor. Of `how` counts all but the font.
void set_formula(Ui& ui, const std::string& line, const Flow& how);
/// Height that set_formula() would take.
float formula_height(Ui& ui, const std::string& line, const Flow& how);

}  // namespace zstep::viewer
