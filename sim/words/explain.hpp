// What a step did, in one sentence and in the formula with its numbers filled in.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/words/notation.hpp"
#include "traces/file/trace.hpp"
#include "traces/replay/state.hpp"

namespace zstep {

struct Explanation {
  std::string sentence;                                ///< plain text, one sentence or two
  std::vector<std::string> formulas;                   ///< one line each: symbols = numbers = result
  std::vector<std::string> given;                      ///< of each: the event's field that it gives, if it gives one
  std::vector<std::pair<std::string, double>> values;  ///< by name, for who wants every digit
  std::vector<words::Owned> owned;                     ///< whose the numbers of the formulas are
  std::optional<std::string> doubt;                    ///< the trace's number is not what its formula gives
  std::string besides;                                 ///< what of that the sentence does not say itself
};

/// What `event` did. `after` is the state it led to, at after.position; the event is trace.event(after.position).
/// Uses the trace's conventions for names (z*, z_v or z) and for formulas (direct, or by increments).
/// Looks back in the trace, so `event` is a copy: what Trace::event() refers to may go away meanwhile.
Explanation explain(const Trace& trace, const State& after, RecordedEvent event);

/// Whose pixels are being found: the polygon at work; of a method that goes through all at once, that of the span's
/// edge.
std::int32_t polygon_at_work(const MethodState& machine);

/// Does the header declare that of two that are equally near the first in the file is seen?
inline bool keeps_first(const Header& header) {
  return header.declares(Convention::ties) && header.comparison.ties == Comparison::Ties::first;
}

/// The label of a polygon: its name, or "P7".
std::string polygon_label(const Scene& scene, std::int32_t polygon);
/// The label of a piece: its polygon's, "F"; "F1", "F2" … for its parts in the order in which they were made ("P7.1"
/// where the polygon has no name of its own).
std::string piece_label(const Scene& scene, const MethodState& machine, std::int32_t piece);
/// The letter of a vertex, where a polygon is named by its corners ("ABC" of three); else its index: "3".
std::string vertex_label(const Scene& scene, std::int32_t vertex);
/// "AB" where both its ends have letters, else "e3".
std::string edge_label(const Scene& scene, const EdgeTableInsert& edge);
/// "its header does not declare which depth is nearer": why numbers that contradict a compare may be right all the
/// same; empty where the header declares what they are held against. `tie`: the two are equal.
std::string undeclared_text(const Header& header, bool tie);
/// What the buffer's numbers are called: "z*", "z_v" or "z".
std::string depth_symbol(const Scene& scene, const Conventions& conventions);
/// And what is interpolated to get it: the same, but 1/z_v where z_v is its reciprocal.
std::string symbol_along(const Scene& scene, const Conventions& conventions);
/// What fixed-point numbers are that the format cannot hold: "rounded", "cut off"; nothing of floating-point numbers.
std::string_view rounding_word(const Conventions& conventions);
/// What a formula ends in, "2.4, rounded to 2"; where the two numbers are written alike, or there is no such word, what
/// is recorded alone, as `is` writes it.
std::string as_held(double computed, double recorded, const std::string& is, std::string_view word);

}  // namespace zstep
