// zstep compare-methods --table: the comparison table of the lecture (002), measured again.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sim/cli/commands.hpp"
#include "sim/cli/compare.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/watch.hpp"
#include "sim/cli/words.hpp"
#include "sim/cost/book_table.hpp"
#include "traces/error.hpp"
#if ZSTEP_HAS_VIEWER
#include "sim/viewer/charts/chart.hpp"
#endif

namespace zstep::cli {
namespace {

using compare::Apart;
using compare::BookRow;
using compare::table_sizes;

constexpr double layers = 2;  // the sum of the triangles' areas, in rasters
constexpr unsigned seed = 1;
constexpr std::size_t columns = table_sizes.size();

struct Cell {
  std::optional<double> seconds;
  std::string without;  ///< why there are none
};

struct Row {
  const BookRow* book;
  const Method* method;
  std::array<Cell, columns> cells;
};

std::vector<Row> rows_to_measure() {
  std::vector<Row> rows;
  for (const BookRow& book : compare::book_table)
    for (const Method& m : methods())
      if (m.id == book.method) rows.push_back({&book, &m, {}});
  return rows;
}

std::int32_t side_of(const CompareOptions& options) { return options.quick ? 128 : 512; }

/// Measures cell by cell; false if Ctrl-C ended it.
bool measure_rows(const CompareOptions& options, std::vector<Row>& rows) {
  Watch watch;
  Conventions conventions;
  conventions.cull = false;
  compare::MeasureOptions measuring;
  measuring.limit = options.limit, measuring.count = false;
  for (Row& row : rows) row.cells.fill({std::nullopt, "stopped"});
  try {
    for (std::size_t k = 0; k < columns; ++k) {
      if (options.quick && k + 1 == columns) {
        for (Row& row : rows) row.cells[k].without = "left out";
        continue;
      }
      const Scene scene = compare::random_scene(table_sizes[k], layers, side_of(options), seed);
      for (Row& row : rows) {
        const auto tick = [&](double seconds) {
          watch.show(fmt::format("{} polygons, {}: {:.1f} s (Ctrl-C stops and prints what is done)",
                                 grouped(table_sizes[k]), row.method->title, seconds));
        };
        const compare::Measured measured = compare::measure(*row.method, scene, conventions, measuring, tick);
        if (measured.done()) row.cells[k] = {measured.median_seconds(), ""};
        else
          row.cells[k].without = measured.end == Apart::End::out_of_time ? fmt::format("> {:g} s", options.limit)
                                                                         : "failed: " + measured.what;
      }
    }
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

/// What depth sort takes for 100 polygons, which is the table's 1.
std::optional<double> unit_of(const std::vector<Row>& rows) {
  if (rows.empty() || rows.front().book->method != compare::book_table.front().method) return std::nullopt;
  return rows.front().cells[0].seconds;
}

std::string cost_text(double cost) {
  if (cost < 0.995) return fmt::format("{:.2g}", cost);
  return cost < 9.95 ? fmt::format("{:.1f}", cost) : grouped(std::llround(cost));
}

std::string growth_text(double from, double to, std::size_t first, std::size_t last) {
  return fmt::format("{:.2f}", compare::growth_exponent(table_sizes[first], from, table_sizes[last], to));
}

void print_rows(const CompareOptions& options, const std::vector<Row>& rows, std::optional<double> unit) {
  const std::int32_t side = side_of(options);
  fmt::print(
      "Random triangles in parallel projection, {}x{} pixels; their areas sum to {:g} rasters whatever their number.\n",
      side, side, layers);
  if (unit)
    fmt::print("Costs are times; depth sort of 100 polygons, 1, took {}. In brackets: the book's.\n\n",
               seconds_text(*unit));
  else
    fmt::print(
        "Times, as depth sort of 100 polygons, the book's 1, could not be measured. In brackets: the book's "
        "costs.\n\n");

  using enum Table::Align;
  Table table({left, right, left, right, left, right, left, right, left});
  std::vector<std::string> head{"POLYGONS"};
  for (const int size : table_sizes) head.insert(head.end(), {grouped(size), ""});
  head.insert(head.end(), {"GROWTH", ""});
  table.row(head);
  for (const Row& row : rows) {
    std::vector<std::string> line{std::string(row.method->title)};
    std::size_t last = 0;
    for (std::size_t k = 0; k < columns; ++k) {
      const Cell& cell = row.cells[k];
      if (cell.seconds) last = k;
      line.push_back(!cell.seconds ? cell.without
                     : unit        ? cost_text(*cell.seconds / *unit)
                                   : seconds_text(*cell.seconds));
      line.push_back(fmt::format("({:g})", row.book->costs[k]));
    }
    const Cell &first_cell = row.cells[0], &last_cell = row.cells[last];
    line.push_back(last > 0 && first_cell.seconds ? "N^" + growth_text(*first_cell.seconds, *last_cell.seconds, 0, last)
                                                  : "-");
    line.push_back(
        fmt::format("(N^{})", growth_text(row.book->costs[0], row.book->costs[columns - 1], 0, columns - 1)));
    table.row(line);
  }
  fmt::print("{}\n", table.text(0));
  fmt::print(
      "GROWTH: how cost grows with the number N of polygons, from the first column to the last that was measured.\n");
  fmt::print("The notes print {} over the middle column; the book's costs fit {}.\n", compare::printed_middle_size,
             grouped(table_sizes[1]));
}

std::string csv_of(const std::vector<Row>& rows, std::optional<double> unit) {
  std::string text = "method,polygons,time_s,cost,book_cost\n";
  for (const Row& row : rows)
    for (std::size_t k = 0; k < columns; ++k) {
      const std::optional<double> seconds = row.cells[k].seconds;
      text +=
          fmt::format("{},{},{},{},{}\n", row.method->id, table_sizes[k], seconds ? fmt::format("{}", *seconds) : "",
                      seconds && unit ? fmt::format("{}", *seconds / *unit) : "", row.book->costs[k]);
    }
  return text;
}

#if ZSTEP_HAS_VIEWER
Drawing chart_of(const CompareOptions& options, const std::vector<Row>& rows, std::optional<double> unit) {
  LineChart chart;
  chart.title = "Cost of four methods by the number of polygons";
  chart.subtitle = fmt::format(
      "Solid: measured here, {0} x {0} pixels. Dashed: the book's estimate of 1974. Depth sort of 100 polygons = 1.",
      side_of(options));
  chart.x_title = "polygons", chart.y_title = unit ? "cost" : "milliseconds";
  chart.x_ticks.assign(table_sizes.begin(), table_sizes.end());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    LineChart::Line measured{std::string(rows[k].method->title), {}, false, static_cast<int>(k)};
    LineChart::Line book{std::string(rows[k].method->title) + ", book", {}, true, static_cast<int>(k)};
    for (std::size_t n = 0; n < columns; ++n) {
      if (rows[k].cells[n].seconds)
        measured.points.emplace_back(table_sizes[n], *rows[k].cells[n].seconds / unit.value_or(1e-3));
      book.points.emplace_back(table_sizes[n], rows[k].book->costs[n]);
    }
    if (!measured.points.empty()) chart.lines.push_back(std::move(measured));
    if (unit) chart.lines.push_back(std::move(book));
  }
  return draw_chart(chart);
}
#else
Drawing chart_of(const CompareOptions&, const std::vector<Row>&, std::optional<double>) { return {}; }
#endif

void refuse(const CompareOptions& options) {
  const auto no = [](const std::string& what) {
    throw InputError("--table", "brings its own scenes, cameras and methods", fmt::format("leave out {}", what));
  };
  if (!options.run.scene.empty()) no(options.run.scene);
  if (!options.methods.empty()) no("--methods");
  if (options.steps) no("--steps");
  if (!options.run.given().empty()) no(options.run.given());
}

}  // namespace

int compare_table(const CompareOptions& options) {
  refuse(options);
  check_outputs({}, {}, compare_outputs(options));
  std::vector<Row> rows = rows_to_measure();
  const bool finished = measure_rows(options, rows);
  const std::optional<double> unit = unit_of(rows);
  print_rows(options, rows, unit);
  write_comparison(options, csv_of(rows, unit), [&] { return chart_of(options, rows, unit); });
  if (!finished) complain("stopped by Ctrl-C");
  return finished ? exit_code::done : exit_code::interrupted;
}

}  // namespace zstep::cli
