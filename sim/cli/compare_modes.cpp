// zstep compare-methods --modes: ways of interpolating beside each other on one scene; --sweep: the same while near or
// far goes through a range.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/cli/compare_methods.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/words.hpp"
#include "sim/cost/comparison.hpp"
#include "sim/cost/growth.hpp"
#include "sim/cost/measure.hpp"
#include "sim/cost/modes.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"

#if ZSTEP_HAS_VIEWER
#include "sim/viewer/charts/chart.hpp"
#include "traces/scene.hpp"
#endif

namespace zstep::cli {
namespace {

using compare::Mode;
using compare::ModeErrors;
using Words = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// "depth=view,reciprocal": the convention and its words, as headers have them.
Words mode_words(const std::vector<std::string>& given) {
  Words words;
  for (const std::string& text : given) {
    const std::size_t equals = text.find('=');
    std::string key = text.substr(0, equals);
    std::replace(key.begin(), key.end(), '-', '_');
    std::string keys;
    bool known = false;
    for_each_convention([&]<class E>(std::string_view name, E Conventions::*) {
      std::string shown(name);
      std::replace(shown.begin(), shown.end(), '_', '-');
      keys += (keys.empty() ? "" : ", ") + shown;
      if (name != key || equals == text.npos) return;
      known = true;
      std::vector<std::string> all, chosen;
      for (const std::string_view word : zstep::words_of<E>) all.emplace_back(word);
      for (std::string& word : all) std::replace(word.begin(), word.end(), '_', '-');
      for (const std::string& word : parts_of(text.substr(equals + 1), ','))
        if (word == "all") chosen.insert(chosen.end(), zstep::words_of<E>.begin(), zstep::words_of<E>.end());
        else chosen.emplace_back(zstep::words_of<E>[parse_choice("--modes " + key, word, all)]);
      words.emplace_back(key, std::move(chosen));
    });
    if (!known)
      throw InputError("--modes " + text, "is not CONVENTION=WORD,WORD",
                       fmt::format("the conventions are {}; as in --modes depth=view,reciprocal", keys));
  }
  return words;
}

std::string error_text(double value) { return value == 0 ? "0" : fmt::format("{:.2g}", value); }
std::string count_text(double value) { return fmt::format("{:.2f}", value); }

struct ModeRow {
  Mode mode;
  ModeErrors errors;
  double seconds = std::numeric_limits<double>::quiet_NaN();
};

void print_rows(const Scene& scene, const std::vector<ModeRow>& rows) {
  using enum Table::Align;
  fmt::print("{}, {}x{} pixels; {} depths. Errors of z_v are distances from the polygons themselves.\n\n", scene.name,
             scene.raster.width, scene.raster.height, grouped(rows.front().errors.depths));
  Table table({left, right, right, right, right, right, right, right, right, right, right, right});
  table.row(
      {"MODE", "LARGEST", "RMS", "ROUNDING", "BOUND", "WRONG", "TURNED", "BENT", "+", "\u00d7", "\u00f7", "TIME"});
  for (const ModeRow& row : rows) {
    const ModeErrors& e = row.errors;
    const compare::Operations& o = e.operations;
    table.row({row.mode.text, error_text(e.largest), error_text(e.rms), error_text(e.rounding_depth),
               error_text(e.bound) + (e.within_bounds ? "" : " passed"), grouped(e.wrong_pixels),
               grouped(e.fighting_pixels), grouped(e.bent_pixels), count_text(o.each(o.additions)),
               count_text(o.each(o.multiplications)), count_text(o.each(o.divisions)), seconds_text(row.seconds)});
  }
  fmt::print("{}\n", table.text(0));
  fmt::print(
      "LARGEST, RMS: error of z_v at the pixels' centres. ROUNDING: the largest error by rounding alone of a\n"
      "depth that stays in the buffer, in the buffer's own units; BOUND: the most that theory allows. WRONG: pixels\n"
      "that do not show the nearest polygon; TURNED: pixels where rounding turned a compare; BENT: pixels where a\n"
      "compare goes wrong without rounding, as z_v is interpolated as if it were linear on the picture. +, \u00d7, "
      "\u00f7:\n"
      "additions, multiplications, divisions per pixel. TIME: processor time of a run without recording.\n");
}

bool has_attributes(const std::vector<ModeRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const ModeRow& row) { return row.errors.attribute.attributes > 0; });
}

void print_attributes(const std::vector<ModeRow>& rows) {
  using enum Table::Align;
  Table table({left, right, right, right, right, right, right, right});
  table.row({"ATTRIBUTE", "LARGEST", "RMS", "ROUNDING", "BOUND", "+", "\u00d7", "\u00f7"});
  for (const ModeRow& row : rows) {
    const oracle::AttributeErrors& e = row.errors.attribute;
    const compare::Operations& o = row.errors.attribute_operations;
    if (e.attributes == 0) continue;
    table.row({row.mode.text, error_text(e.largest), error_text(e.root_mean_square()), error_text(e.rounding),
               error_text(row.errors.attribute_bound) + (row.errors.attributes_within_bounds ? "" : " passed"),
               count_text(o.each(o.additions)), count_text(o.each(o.multiplications)),
               count_text(o.each(o.divisions))});
  }
  fmt::print("\n{}\n", table.text(0));
  fmt::print(
      "LARGEST, RMS: error of the attribute against the polygon's own. ROUNDING: the largest error by rounding\n"
      "alone; BOUND: the most that theory allows. +, \u00d7, \u00f7: what it costs beyond the depths, per pixel that\n"
      "is shaded.\n");
}

std::string csv_of(const std::string& scene, const std::string& swept, const std::vector<double>& values,
                   const std::vector<std::vector<ModeRow>>& runs) {
  const bool attributes = std::any_of(runs.begin(), runs.end(), has_attributes);
  std::string text = fmt::format(
      "scene,mode,{}depths,largest,rms,rounding,bound,wrong_pixels,turned_pixels,bent_pixels,additions,"
      "multiplications,divisions,time_s{}\n",
      swept.empty() ? "" : swept + ",",
      attributes ? ",attribute_largest,attribute_rms,attribute_rounding,attribute_bound,shaded_pixels,"
                   "attribute_additions,attribute_multiplications,attribute_divisions"
                 : "");
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (const ModeRow& row : runs[k]) {
      const ModeErrors& e = row.errors;
      const compare::Operations& o = e.operations;
      text += fmt::format("{},{},{}{},{},{},{},{},{},{},{},{},{},{},{}", compare::csv_cell(scene),
                          compare::csv_cell(row.mode.text), swept.empty() ? "" : fmt::format("{},", values[k]),
                          e.depths, e.largest, e.rms, e.rounding_depth, e.bound, e.wrong_pixels, e.fighting_pixels,
                          e.bent_pixels, o.additions, o.multiplications, o.divisions,
                          std::isnan(row.seconds) ? std::string() : fmt::format("{}", row.seconds));
      if (attributes)
        text += fmt::format(",{},{},{},{},{},{},{},{}", e.attribute.largest, e.attribute.root_mean_square(),
                            e.attribute.rounding, e.attribute_bound, e.attribute_operations.pixels,
                            e.attribute_operations.additions, e.attribute_operations.multiplications,
                            e.attribute_operations.divisions);
      text += "\n";
    }
  return text;
}

std::vector<ModeRow> rows_of(const Scene& scene, const Conventions& conventions, const Words& words, bool timed,
                             double limit, Watch& watch, const std::string& where, bool first) {
  std::vector<std::string> left_out;
  std::vector<ModeRow> rows;
  for (Mode& mode : compare::modes_of(scene, conventions, words, left_out)) rows.push_back({std::move(mode), {}});
  if (first)
    for (const std::string& why : left_out) complain("note: without " + why);
  std::size_t done = 0;
  for (ModeRow& row : rows) {
    const auto show = [&] {
      watch.show(fmt::format("{}{} of {} modes: {} (Ctrl-C stops)", where, ++done, rows.size(), row.mode.text));
    };
    show();
    row.errors = compare::errors_of_mode(scene, row.mode);
    if (!timed) continue;
    compare::MeasureOptions measuring;
    measuring.limit = limit, measuring.count = false;
    const compare::Measured m =
        compare::measure(method("z-buffer"), scene, row.mode.conventions, measuring, [](double) {});
    if (m.done()) row.seconds = m.median_seconds();
  }
  return rows;
}

/// The scene, and what the command line says of conventions: whether these go together is seen once a mode's own words
/// are added.
Run prepare_for_modes(RunOptions options, bool notes) {
  const ConventionChoices conventions = std::exchange(options.conventions, {});
  Run run = notes ? prepare(options) : prepare_again(options);
  conventions.apply(run.conventions);
  return run;
}

/// "near=0.01..10"
struct Sweep {
  std::string name;
  double from = 0, to = 0;
};
Sweep sweep_of(const std::string& text) {
  const std::size_t equals = text.find('='), dots = text.find("..");
  const bool shaped = equals != text.npos && dots != text.npos && dots > equals;
  Sweep sweep{shaped ? text.substr(0, equals) : "", 0, 0};
  if (!shaped || (sweep.name != "near" && sweep.name != "far"))
    throw InputError("--sweep " + text, "is not near=FROM..TO or far=FROM..TO", "as in --sweep near=0.01..1");
  sweep.from = parse_number("--sweep", text.substr(equals + 1, dots - equals - 1));
  sweep.to = parse_number("--sweep", text.substr(dots + 2));
  if (!(sweep.from > 0) || !(sweep.to > sweep.from) || !std::isfinite(sweep.to))
    throw InputError("--sweep " + text, "does not go from a distance above 0 to a greater one",
                     "as in --sweep near=0.01..1");
  return sweep;
}

/// Where it begins, and whether it goes on from there: "at near = 0.749".
std::string beginning_text(const Sweep& sweep, const compare::Threshold& begins) {
  using enum compare::Threshold::Kind;
  if (begins.kind == none) return "nowhere in this range";
  const std::string at = fmt::format("at {} = {:.3g}", sweep.name, begins.at);
  return begins.kind == everywhere ? at + ", an end of this range, or beyond it" : at;
}

/// Where wrong pixels begin, looked for between the samples; and by formula, where the depth buffer cannot tell the
/// nearest two polygons apart. `errors_at` measures a mode where the plane is at some distance.
void print_beginnings(const Sweep& sweep, const std::vector<double>& values,
                      const std::vector<std::vector<ModeRow>>& runs,
                      const std::function<ModeErrors(double, const Mode&)>& errors_at) {
  const bool near = sweep.name == "near";  // a smaller near plane makes it worse, a larger far plane does
  const auto wrong_pixels = [](const ModeErrors& e) { return static_cast<std::int64_t>(e.wrong_pixels); };
  const auto too_coarse = [](const ModeErrors& e) {
    return static_cast<std::int64_t>(e.least_gap && e.unit_at_gap > *e.least_gap);
  };
  for (std::size_t mode = 0; mode < runs.front().size(); ++mode) {
    const auto begins = [&](const auto& count) {
      std::vector<compare::Sample> samples;
      for (std::size_t k = 0; k < values.size(); ++k) samples.push_back({values[k], count(runs[k][mode].errors)});
      if (near) std::reverse(samples.begin(), samples.end());
      return compare::threshold_of(std::move(samples),
                                   [&](double at) { return count(errors_at(at, runs.front()[mode].mode)); });
    };
    const compare::Threshold measured = begins(wrong_pixels);
    fmt::print("{}: wrong pixels begin {}; a unit of the depth buffer exceeds the smallest gap {}\n",
               runs.front()[mode].mode.text, beginning_text(sweep, measured),
               beginning_text(sweep, begins(too_coarse)));
    if (const auto& fall = measured.fall)
      fmt::print(
          "  That is a threshold of these samples only: the number of wrong pixels does not grow steadily ({} at {} =\n"
          "  {:.3g}, {} at {:.3g}), and other samples may find some elsewhere.\n",
          grouped(fall->from.wrong), sweep.name, fall->from.at, grouped(fall->to.wrong), fall->to.at);
  }
}

#if ZSTEP_HAS_VIEWER
Drawing chart_of(const Scene& scene, const std::vector<ModeRow>& rows) {
  std::vector<std::pair<std::string, Conventions>> modes;
  for (const ModeRow& row : rows) modes.emplace_back(row.mode.text, row.mode.conventions);
  return draw_chart(unit_chart(scene, modes));
}

Drawing chart_of(const Sweep& sweep, const Scene& scene, const std::vector<double>& values,
                 const std::vector<std::vector<ModeRow>>& runs) {
  LineChart chart;
  chart.title = fmt::format("{}: errors of z_v while the {} plane moves", scene.name, sweep.name);
  chart.subtitle = "Solid: the largest error measured. Dashed: one unit of the depth buffer, in z_v, by formula.";
  chart.x_title = fmt::format("distance of the {} plane", sweep.name);
  chart.y_title = "z_v";
  chart.x_ticks = decades_between(sweep.from, sweep.to);
  const auto add = [&](const std::string& name, int look, bool dashed, const auto& value_of) {
    LineChart::Line line{name, {}, dashed, look};
    for (std::size_t k = 0; k < values.size(); ++k)
      if (const double value = value_of(k); value > 0) line.points.emplace_back(values[k], value);
    if (!line.points.empty()) chart.lines.push_back(std::move(line));
  };
  for (std::size_t mode = 0; mode < runs.front().size(); ++mode) {
    const std::string& name = runs.front()[mode].mode.text;
    const int look = index32(mode);
    add(name, look, false, [&](std::size_t k) { return runs[k][mode].errors.largest; });
    add("", look, true, [&](std::size_t k) { return runs[k][mode].errors.unit_at_gap; });
  }
  add("smallest gap", 3, true, [&](std::size_t k) { return runs[k].front().errors.least_gap.value_or(0); });
  return draw_chart(chart);
}
#else
Drawing chart_of(const Scene&, const std::vector<ModeRow>&) { return {}; }
Drawing chart_of(const Sweep&, const Scene&, const std::vector<double>&, const std::vector<std::vector<ModeRow>>&) {
  return {};
}
#endif

/// Of more lines a chart has no looks.
void allow_modes(const char* option, std::size_t count, std::size_t most) {
  if (count > most)
    throw InputError(option, fmt::format("{} modes are too many for one chart", count),
                     fmt::format("give at most {} with --modes", most));
}

int sweep_modes(const CompareOptions& options, const Words& words) {
  const Sweep sweep = sweep_of(options.sweep);
  constexpr std::size_t points = 17;
  Watch watch;
  std::vector<double> values;
  std::vector<std::vector<ModeRow>> runs;
  RunOptions run_options = options.run;
  Scene scene;
  for (std::size_t k = 0; k < points; ++k) {
    const double share = ratio(k, points - 1);
    const double value = sweep.from * portable::pow(sweep.to / sweep.from, share);
    (sweep.name == "near" ? run_options.view.near : run_options.view.far) = value;
    const Run run = prepare_for_modes(run_options, k == 0);
    scene = run.scene;
    runs.push_back(rows_of(run.scene, run.conventions, words, false, options.limit, watch,
                           fmt::format("{} = {:.3g}: ", sweep.name, value), k == 0));
    values.push_back(value);
    if (runs.back().empty()) throw InputError("--modes", "none of these can be drawn", "give others");
    allow_modes("--sweep", runs.back().size(), 3);  // and the smallest gap
  }
  const auto errors_at = [&](double value, const Mode& mode) {
    watch.show(fmt::format("{} = {:.3g}: {} (Ctrl-C stops)", sweep.name, value, mode.text));
    (sweep.name == "near" ? run_options.view.near : run_options.view.far) = value;
    const ModeErrors errors = compare::errors_of_mode(prepare_for_modes(run_options, false).scene, mode);
    watch.clear_line();
    return errors;
  };
  watch.clear_line();
  using enum Table::Align;
  std::vector<Table::Align> columns{right};
  std::vector<std::string> head{sweep.name};
  for (const ModeRow& row : runs.front()) {
    columns.insert(columns.end(), {right, right});
    head.insert(head.end(), {row.mode.text, "WRONG"});
  }
  Table table(columns);
  table.row(head);
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::vector<std::string> cells{fmt::format("{:.3g}", values[k])};
    for (const ModeRow& row : runs[k])
      cells.insert(cells.end(), {error_text(row.errors.largest), grouped(row.errors.wrong_pixels)});
    table.row(cells);
  }
  fmt::print("{}, {}x{} pixels: the largest error of z_v, and how many pixels do not show the nearest polygon\n\n{}\n",
             scene.name, scene.raster.width, scene.raster.height, table.text(0));
  print_beginnings(sweep, values, runs, errors_at);
  write_comparison(options, csv_of(scene.name, sweep.name, values, runs),
                   [&] { return chart_of(sweep, scene, values, runs); });
  return exit_code::done;
}

}  // namespace

int compare_modes(const CompareOptions& options) {
  const Words words = mode_words(options.modes);
  if (!options.sweep.empty()) return sweep_modes(options, words);
  Watch watch;
  const Run run = prepare_for_modes(options.run, true);
  if (!options.plot.empty() && run.scene.camera.kind == Camera::Kind::screen)
    throw InputError("--plot", "draws depths between the near and the far plane, but this scene has no such planes",
                     "leave it out, or give a scene with a camera");
  std::vector<std::string> left_out;
  if (!options.plot.empty())
    allow_modes("--plot", compare::modes_of(run.scene, run.conventions, words, left_out).size(), 4);
  std::vector<ModeRow> rows = rows_of(run.scene, run.conventions, words, true, options.limit, watch, "", true);
  watch.clear_line();
  if (rows.empty()) throw InputError("--modes", "none of these can be drawn", "give others");
  print_rows(run.scene, rows);
  if (has_attributes(rows)) print_attributes(rows);
  write_comparison(options, csv_of(run.scene.name, "", {}, {rows}), [&] { return chart_of(run.scene, rows); });
  return exit_code::done;
}

}  // namespace zstep::cli

// zstep compare-methods --table: the comparison table of the lecture (002), measured again.

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
    LineChart::Line measured{std::string(rows[k].method->title), {}, false, index32(k)};
    LineChart::Line book{std::string(rows[k].method->title) + ", book", {}, true, index32(k)};
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
