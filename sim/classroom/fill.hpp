// The numbers in a lesson's text: `{z}`, `{z:2}`, `{z = 4.25}`, `{z ~ 0.333}`.
//
// What stands between braces is an expression. Plain, it is replaced by its value; after `:` comes the number of
// decimals. After `=` or `~` the author writes what the reader will see, and it is checked: `=` wants the number itself
// (√3/2 and 1/3 will do), `~` a decimal rounded as written. What stands in quotes, `{"8x8"}`, is shown as it stands: a
// word or a name. A digit anywhere else is refused, and so a lesson cannot say what its trace does not show.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/classroom/names.hpp"
#include "traces/record/recorder.hpp"

namespace zstep::classroom {

/// Where a text begins in a file; complaints count its lines.
struct Place {
  std::string file;
  std::int32_t line = 0;
  std::string str(std::int32_t lines_on = 0) const { return file + ":" + std::to_string(line + lines_on); }
};

/// The text with its braces filled. Doubled braces are braces. Throws InputError with the line.
std::string fill(std::string_view text, const Place& place, Replay& replay, const RecordedEvent* event,
                 std::int64_t position);

/// What stands alone in braces, and is no word: of `{z ~ 0.7} < {z_v(3)}` z and z_v; and steps that are counted there.
std::vector<std::string> names_in(std::string_view text, const Place& place);

/// Checks all of it that can be checked without a run; that no number stands in it that no run could check, too.
void check_fill(std::string_view text, const Place& place, std::uint8_t kind, const Page& page);

/// A value as readers see it: 4.25, −3, ∞, A, back; `decimals` < 0 for at most four of them, as few as will do.
std::string show(const Quantity& value, const Scene& scene, int decimals = -1);

}  // namespace zstep::classroom
