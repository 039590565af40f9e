#include "sim/viewer/panes/lesson_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "sim/classroom/chart_table.hpp"
#include "sim/viewer/panes/chart_picture.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {
namespace {

using classroom::ChartTable;
using Row = ChartTable::Row;

/// A stop's table, with the number of its column "?" as far as the reader has given one.
struct Shown {
  ChartTable table;
  std::vector<int> looks;                  ///< of the rows
  std::optional<std::size_t> asked_for{};  ///< the column whose number is asked for, while there is no answer

  /// Where a row comes to nothing at the column, it may tell what the answer is.
  bool waits(const Row& row) const { return asked_for && !row.values[*asked_for]; }
};

/// A row looks as one of the same name did in the tables before, where no other row of its own does.
std::vector<int> looks_of(const Lesson& lesson, int stop) {
  // Shapes and colours of their own: a disc, a square, a triangle, a diamond, a square again.
  constexpr std::array<int, ChartTable::most_rows> all{LineChart::plain_look, 1, 2, 6 + LineChart::muted_look, 9};
  std::map<std::string, int> before;
  std::vector<int> looks;
  for (int k = 0; k <= stop; ++k) {
    bool own = false;
    const auto table = classroom::chart_of(lesson, k, own);
    if (!table || !own) continue;
    looks.clear();
    std::set<int> used;
    const auto known = [&](const Row& row) { return before.contains(row.name) ? before[row.name] : -1; };
    for (const Row& row : table->rows) used.insert(known(row));
    for (const Row& row : table->rows) {
      const auto is_free = [&](int look) { return !used.contains(look); };
      const bool again = known(row) >= 0 && std::find(looks.begin(), looks.end(), known(row)) == looks.end();
      looks.push_back(again ? known(row) : *std::find_if(all.begin(), all.end(), is_free));
      used.insert(looks.back());
      before[row.name] = looks.back();
    }
  }
  return looks;
}

std::optional<Shown> shown_at(const Session& session) {
  const Lesson* lesson = session.lesson();
  const int stop = session.stop();
  if (!lesson || stop < 0) return std::nullopt;
  bool own = false;
  auto table = classroom::chart_of(*lesson, stop, own);
  if (!table) return std::nullopt;
  Shown shown{*table, looks_of(*lesson, stop)};
  const auto unknown = std::find(shown.table.columns.begin(), shown.table.columns.end(), std::nullopt);
  const std::optional<Question>& question = lesson->stops[stop].question;
  if (unknown == shown.table.columns.end() || !own || !question) return shown;
  if (const auto given = session.chosen(stop)) *unknown = classroom::number_of(question->answers[*given]);
  else shown.asked_for = unknown - shown.table.columns.begin();
  return shown;
}

LineChart line_chart(const Shown& shown) {
  const ChartTable& table = shown.table;
  LineChart chart;
  chart.x_title = table.across, chart.y_title = table.up;
  for (const auto& column : table.columns)
    if (column) chart.x_ticks.push_back(*column);
  std::sort(chart.x_ticks.begin(), chart.x_ticks.end());
  chart.x_ticks.erase(std::unique(chart.x_ticks.begin(), chart.x_ticks.end()), chart.x_ticks.end());
  const double least = chart.x_ticks.front(), most = chart.x_ticks.back(),
               count = static_cast<double>(table.rows.size());
  const auto has_range = [](const Row& row) {
    return std::any_of(row.values.begin(), row.values.end(), [](const auto& v) { return v && v->x < v->y; });
  };
  const bool ranges = std::any_of(table.rows.begin(), table.rows.end(), has_range);
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const Row& row = table.rows[k];
    // Ranges of the same column are drawn side by side.
    const double beside = ranges ? portable::pow(most / least, 0.012 * (static_cast<double>(k) - (count - 1) / 2)) : 1;
    LineChart::Line line{row.name, {}, false, shown.looks[k], has_range(row)};
    if (shown.waits(row)) continue;
    for (std::size_t at = 0; at < table.columns.size(); ++at) {
      const auto& value = row.values[at];
      line.dashed = line.dashed || !value || !table.columns[at];
      if (value && table.columns[at]) {
        const double x = *table.columns[at] * beside;
        line.points.emplace_back(x, std::sqrt(value->x) * std::sqrt(value->y));
        if (line.bare) chart.lines.push_back({"", {{x, value->x}, {x, value->y}}, false, line.look});
      } else if (value && shown.asked_for) {  // somewhere at this height
        const std::string name = fmt::format("{} at ?", number(value->x));
        chart.lines.push_back({name, {{least, value->x}, {most, value->x}}, true, line.look, true});
      }
    }
    if (line.points.empty()) continue;
    std::stable_sort(line.points.begin(), line.points.end(), [](auto a, auto b) { return a.x < b.x; });
    if (!shown.asked_for) {
      chart.lines.push_back(std::move(line));
      continue;
    }
    // The line between what is known would tell what is asked.
    for (const glm::dvec2 point : line.points)
      chart.lines.push_back({point == line.points.back() ? row.name : "", {point}, false, line.look});
  }
  return chart;
}

void draw_lesson_chart(Ui& ui) {
  const auto shown = shown_at(ui.session);
  if (!shown) return say_empty(ui, "Empty: the lesson has had no table yet that a chart is drawn of.");
  draw_line_chart(ui, "lesson chart", line_chart(*shown));
  if (ImGui::IsWindowHovered())
    ui.mouse_help = "The lesson's table. On both axes equal lengths are equal ratios: N times as much is a slope of 1.";
}

std::string note_of_lesson_chart(Ui& ui) {
  return shown_at(ui.session) ? "logarithmic axes: equal lengths, equal ratios" : "";
}

}  // namespace

const Pane chart_pane{"chart", "CHART", draw_lesson_chart, note_of_lesson_chart, nullptr, 0.5f, false, nullptr, true};

std::vector<std::string> chart_told(const Session& session) {
  const auto shown = shown_at(session);
  if (!shown || session.lesson()->stops[session.stop()].focus != chart_pane.id) return {};
  const ChartTable& table = shown->table;
  std::vector<std::string> lines{fmt::format("Chart, on logarithmic axes: {}, over {}.", table.up, table.across)};
  for (const Row& row : table.rows) {
    if (shown->waits(row)) continue;
    std::string line;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (!row.values[k]) continue;
      const glm::dvec2 value = *row.values[k];
      line += fmt::format("{} {}{} at {}", line.empty() ? ":" : ",", number(value.x),
                          value.x < value.y ? " to " + number(value.y) : "",
                          table.columns[k] ? number(*table.columns[k]) : "an open number");
    }
    lines.push_back(row.name + line + ".");
  }
  return lines;
}

}  // namespace zstep::viewer
