// Formulas set in type: fractions as fractions, what stands below a letter below it, the numbers under the symbols.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"
#include "sim/words/notation.hpp"

namespace zstep::viewer {

// What a formula is made of where it is set in type, with the room that each part takes. For typeset.cpp.

/// A part of a formula with the room that it takes: to the right, and above and below the line on which fractions'
/// bars lie.
struct FormulaBox {
  words::Notation what;
  float width = 0, above = 0, below = 0;
  std::vector<FormulaBox> parts{};
  bool stacked = false;  ///< its parts are lines of one sum, each below the one before
};

FormulaBox box_of(const Ui& ui, words::Notation what);
/// Makes its fractions no wider than the room, as far as their sums can be broken: they go on in lines below, each with
/// its sign in front.
void narrow_box(const Ui& ui, FormulaBox& box, float room);

/// What stands below a letter, as it is written: "v,L" of z_v_L.
std::string below_symbol(const words::Notation& symbol);
/// Above and below a fraction's bar.
float gap_at_bar(const Ui& ui);
bool opens_bracket(const words::Notation& part);
bool closes_bracket(const words::Notation& part);

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
