#include "sim/classroom/chart_table.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "sim/classroom/expression.hpp"
#include "sim/classroom/lesson_blocks.hpp"
#include "sim/classroom/markdown.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::classroom {
namespace {

constexpr std::string_view code_fence = "```", dash = "–", nothing = "…";

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (line = trim(line); !line.empty(); line = trim(line)) {
    words.push_back(line.substr(0, line.find_first_of(" \t")));
    line.remove_prefix(words.back().size());
  }
  return words;
}

/// That an axis of equal ratios has room for.
std::optional<double> above_zero(std::string_view word) {
  constexpr double least = 1e-6, most = 1e12;
  double value = 0;
  const bool whole = !word.empty() && read_number(word, value) == word.size();
  return whole && value >= least && value <= most ? std::optional(value) : std::nullopt;
}

/// Of "54" and "4–8"; none of what is neither.
std::optional<glm::dvec2> range_of(std::string_view word) {
  const std::size_t at = word.find(dash);
  const auto from = above_zero(word.substr(0, at)),
             to = at == word.npos ? from : above_zero(word.substr(at + dash.size()));
  return from && to && *from <= *to ? std::optional(glm::dvec2(*from, *to)) : std::nullopt;
}

/// What stands before the last `count` words.
std::string name_before(std::string_view line, const std::vector<std::string_view>& words, std::size_t count) {
  const char* const end = words.size() > count ? words[words.size() - count].data() : line.data();
  return std::string(trim(line.substr(0, end - line.data())));
}

/// "polygons N   100   ?  60000"
void read_columns(ChartTable& table, std::string_view line, const std::string& where) {
  const std::vector<std::string_view> words = cells_of(line);
  std::size_t count = 0, unknown = 0;
  for (; count < words.size(); ++count) {
    const std::string_view word = words[words.size() - 1 - count];
    const std::optional<double> number = above_zero(word);
    if (!number && word != "?") break;
    unknown += !number;
    table.columns.insert(table.columns.begin(), number);
  }
  table.across = name_before(line, words, count);
  if (table.across.empty() || count < unknown + 2 || unknown > 1)
    throw InputError(where, "the first row of a chart's table needs a name and at least two numbers from 1e-6 to 1e12",
                     "write `polygons N  100  2500  60000`; one more number may be `?`");
}

void read_row(ChartTable& table, std::string_view line, const std::string& where) {
  const std::vector<std::string_view> words = cells_of(line);
  const std::size_t count = table.columns.size();
  ChartTable::Row row{name_before(line, words, count), {}};
  bool good = words.size() > count && !range_of(words[words.size() - count - 1]) && table.rows.size() < table.most_rows;
  bool some = false;
  for (std::size_t k = 0; good && k < count; ++k) {
    const std::string_view word = words[words.size() - count + k];
    row.values.push_back(range_of(word));
    some = some || row.values.back();
    good = row.values.back() || word == nothing;
  }
  if (!good || !some)
    throw InputError(where, fmt::format("`{}` can't be drawn as a row of a chart", trim(line)),
                     fmt::format("write a name that does not end in a number, then {} numbers from 1e-6 to 1e12, with "
                                 "`4–8` for a range and `…` for none; at most {} rows",
                                 count, table.most_rows));
  table.rows.push_back(std::move(row));
}

}  // namespace

std::optional<ChartTable> chart_table(std::string_view text, const Place& place) {
  std::optional<ChartTable> table;
  bool inside = false;
  std::int32_t number = 0;
  for (; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (starts_with(trim(line), code_fence)) {
      if (inside && table) break;
      inside = !inside;
      const std::string_view what = trim(trim(line).substr(code_fence.size()));
      if (inside && !what.empty()) table.emplace().up = what;
    } else if (inside && table && !trim(line).empty()) {
      if (table->columns.empty()) read_columns(*table, line, place.str(number));
      else read_row(*table, line, place.str(number));
    }
  }
  if (table && table->rows.empty())
    throw InputError(place.str(number), "a chart's table has no rows",
                     "write its columns, then a row for each line: `depth sort  1  10  507`");
  return table;
}

std::optional<ChartTable> chart_of(const Lesson& lesson, int stop, bool& own) {
  for (int k = stop; k >= 0; --k)
    if (auto table = chart_table(lesson.stops[k].text, {lesson.path.string(), lesson.stops[k].text_line})) {
      own = k == stop;
      return table;
    }
  return std::nullopt;
}

std::optional<double> number_of(const Answer& answer) {
  const std::string words = plain_text(parse_markdown(answer.text));
  return above_zero(trim(words));
}

}  // namespace zstep::classroom
