// How a formula's numbers show whose they are: underlined in the polygon's colour, and each polygon's underline has
// dashes of its own, as colours alone do not tell them apart for everyone.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/viewer/panes/ui.hpp"
#include "sim/words/notation.hpp"

namespace zstep::viewer {

float underline_height(const Ui& ui);
/// For the polygon that is the `place`-th of those in these formulas.
void underline_of_polygon(const Ui& ui, std::int32_t polygon, std::ptrdiff_t place, ImVec2 from, float width);
/// Under the formulas: which underline is which polygon's; nothing where no number is any polygon's.
void key_to_owners(Ui& ui, const std::vector<words::Owned>& owned);

}  // namespace zstep::viewer
