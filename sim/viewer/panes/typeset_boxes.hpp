// What a formula is made of where it is set in type, with the room that each part takes. For typeset.cpp.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"
#include "sim/words/notation.hpp"

namespace zstep::viewer {

/// A part of a formula with the room that it takes: to the right, and above and below the line on which fractions'
/// bars lie.
struct FormulaBox {
  words::Notation what;
  float width = 0, above = 0, below = 0;
  std::vector<FormulaBox> parts{};
  bool stacked = false;  ///< its parts are lines of one sum, each below the one before
};

FormulaBox box_of(const Ui& ui, words::Notation what);
/// Makes room alike for what stands at the same place of both.
void match_boxes(const Ui& ui, FormulaBox& one, FormulaBox& other);
/// Makes its fractions no wider than the room, as far as their sums can be broken: they go on in lines below, each with
/// its sign in front.
void narrow_box(const Ui& ui, FormulaBox& box, float room);

/// What stands below a letter, as it is written: "v,L" of z_v_L.
std::string below_symbol(const words::Notation& symbol);
/// Above and below a fraction's bar.
float gap_at_bar(const Ui& ui);
bool opens_bracket(const words::Notation& part);
bool closes_bracket(const words::Notation& part);

}  // namespace zstep::viewer
