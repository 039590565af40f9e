// Reading the run of a program that is to be judged: what right programs may print otherwise than a trace has it, and
// lines that nothing can be made of.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "traces/events/vocabulary.hpp"
#include "traces/file/jsonl.hpp"

namespace zstep {

/// Lines of a run that cannot be read and are passed over: each costs itself alone.
struct PassedOver {
  struct Range {
    std::int64_t first = 0, last = 0;  ///< lines of the file, from 1
  };
  std::vector<Range> lines;         ///< in the order of the file
  std::vector<std::string> faults;  ///< of the first ten, as NAME:LINE:COLUMN: what is wrong; how to mend it
  bool gave_up = false;             ///< there are so many that the rest of the file was not read
  bool any() const { return !lines.empty(); }
};

/// As open_jsonl(), of a run of a scene of the reader's own, whose `impossible` step ends it. Throws InputError only
/// where the file is no text of JSON Lines, or not one step can be read.
Trace open_given_run(const std::filesystem::path& path, std::string& impossible, GivenRun& given,
                     PassedOver& passed_over);

/// What languages print for 0/0 and for a division by 0. JSON has none of these, so they are read only as the slope of
/// a span with x_left = x_right; `null`, or no slope at all, will do there, too.
inline constexpr std::array<std::string_view, 8> words_of_no_number{"nan",       "-nan", "NaN",  "-NaN",
                                                                    "-nan(ind)", "inf",  "-inf", "Infinity"};

/// A word that a hand-out offers for a field, besides those that a trace has for it, and what a trace has instead.
struct OtherWord {
  std::string_view kind, field, word, as;
};
inline constexpr std::array<OtherWord, 1> other_words{{
    {"edge_table_skip", "why", "outside", "between_rows"},  // above or below the raster, between no two of its lines
}};

/// The text with words of no number in quotes where they stand bare as values; nothing where there are none.
std::optional<std::string> with_words_quoted(std::string_view text);

/// Makes a line of a run what a trace has for it: other words, and a slope of 0 where a span with x_left = x_right has
/// one that is no number, or none. True where it changed anything.
bool as_trace_has_it(nlohmann::json& line, const Page& page);

/// A span, or an interval between two edges, without a pixel of the raster may say by any numbers that it is empty:
/// makes them those of its ends.
void give_numbers_of_empty(Event& event, std::int32_t width, Conventions::Coverage coverage);

}  // namespace zstep
