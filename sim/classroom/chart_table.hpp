// A table in a lesson's text that is drawn as a chart: a block of code that opens with what its numbers are.
//
//     ```cost, in units of depth sort for 100 polygons
//     polygons N   100   ?  60000
//     depth sort     1  10    507
//     ```
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "sim/classroom/fill.hpp"
#include "sim/classroom/lesson.hpp"

namespace zstep::classroom {

struct ChartTable {
  struct Row {
    std::string name;
    std::vector<std::optional<glm::dvec2>> values;  ///< from the least to the greatest, above 0; one a column, or none
  };
  static constexpr std::size_t most_rows = 5;
  std::string across, up;                      ///< what the columns are numbers of, and what the values are
  std::vector<std::optional<double>> columns;  ///< above 0; none: "?", at most one
  std::vector<Row> rows;
};

/// The first such table of a text whose braces are filled. Throws InputError with the line where it is malformed.
std::optional<ChartTable> chart_table(std::string_view text, const Place& place);

/// The table that a stop's chart draws: its own, or else that of the last stop before it that has one. `own` says
/// which.
std::optional<ChartTable> chart_of(const Lesson& lesson, int stop, bool& own);

/// The number that an answer stands for, and nothing else.
std::optional<double> number_of(const Answer& answer);

}  // namespace zstep::classroom
