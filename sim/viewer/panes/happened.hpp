// What just happened, and what a number under the mouse is: exactly, whose, and where else it stands.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/answers/explain_value.hpp"
#include "sim/viewer/model/session.hpp"
#include "sim/viewer/panes/ui.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/notation.hpp"

namespace zstep::viewer {

/// "exactly 1/3 = 0.3333…; error −1.9e−17, −0.33 ulp"; nothing where the trace does not say where the number comes
/// from. Looks at other steps through the session's replay: what was kept of its state is gone then.
std::string exact_line(Session& session, const answers::Question& question);
/// The same in the middle of drawing a state, through a replay of its own; nothing of a trace too long for that.
std::string exact_line(const Trace& trace, const answers::Question& question);

// What a right click offers on things that are seen in more than one pane.

/// On a pixel of a buffer; `depth`: what asks where its depth comes from.
std::vector<HereLine> lines_of_pixel(const Session& s, Cell cell, const std::optional<answers::Question>& depth);
/// On a vertex or an edge of the scene: the steps about it, its polygons, how to move it, and the line of the file.
std::vector<HereLine> lines_of_part(const Session& s, const ScenePart& part);
/// On a polygon: where the run begins work on it, and the line of the file that has it.
std::vector<HereLine> lines_of_polygon(const Session& s, std::int32_t polygon);

// Which formulas stay where there is no room for all.

/// How much a stop's text and question speak of a formula: most where they give its field, then where they name what
/// stands before its first "=", and a little where they give the number that it ends in; 0: not at all.
int how_named(const Stop& stop, const std::string& formula, const std::string& field);
/// The later ones give way first, and last those of which the lesson's stop speaks most. One, left out here, stays.
std::vector<std::size_t> order_of_giving_way(const Session& s, const Explanation& told);

// How a formula's numbers show whose they are: underlined in the polygon's colour, and each polygon's underline has
// dashes of its own, as colours alone do not tell them apart for everyone.

float underline_height(const Ui& ui);
/// For the polygon that is the `place`-th of those in these formulas.
void underline_of_polygon(const Ui& ui, std::int32_t polygon, std::ptrdiff_t place, ImVec2 from, float width);
/// Under the formulas: which underline is which polygon's; nothing where no number is any polygon's.
void key_to_owners(Ui& ui, const std::vector<words::Owned>& owned);

}  // namespace zstep::viewer
