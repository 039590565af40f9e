// zstep compare-methods: what each method costs on a scene, and whether their pictures agree.

#include "sim/cli/compare_methods.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/words.hpp"
#include "traces/image/file.hpp"
#include "traces/error.hpp"

#if ZSTEP_HAS_VIEWER
#include "sim/viewer/charts/chart.hpp"
#include "traces/scene.hpp"
#endif

namespace zstep::cli {
namespace {

[[maybe_unused]] constexpr double no_mark = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::string bytes_text(std::int64_t bytes) {
  if (bytes < 0) return "?";
  const double kib = ratio(bytes, 1024);
  return kib < 1024 ? three_digits(kib) + " KiB" : three_digits(kib / 1024) + " MiB";
}

std::vector<std::string> parts_of(const std::string& text, char between) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == between) parts.emplace_back();
    else parts.back() += c;
  }
  return parts;
}

std::vector<std::string> compare_outputs(const CompareOptions& options) {
  std::vector<std::string> files = chart_outputs(options.plot);
  if (!options.csv.empty()) files.insert(files.begin(), options.csv);
  return files;
}

void write_comparison(const CompareOptions& options, const std::string& csv, const std::function<Drawing()>& chart) {
  if (!options.csv.empty()) {
    write_file(options.csv, std::vector<std::uint8_t>(csv.begin(), csv.end()));
    say_written(options.csv, "the numbers");
  }
  if (!options.plot.empty()) say_written(options.plot, write_chart(options.plot, chart()));
}

#if ZSTEP_HAS_VIEWER
Drawing chart_of(const Scene& scene, const std::vector<compare::Compared>& methods, double limit) {
  DotChart chart;
  chart.title =
      fmt::format("{}: {}, {} x {} pixels", scene.name, counted(std::ssize(scene.polygons), "polygon", "polygons"),
                  scene.raster.width, scene.raster.height);
  chart.subtitle = fmt::format(
      "Time: of the processor, median of runs without recording. Memory: the most held at once. Pixels: against {}.",
      methods.front().title);
  chart.columns = {{"Time", "milliseconds", {}},
                   {"Memory", "KiB", {}},
                   {"Steps", "that a recording has", {}},
                   {"Pixels", "that differ", {}}};
  for (const compare::Compared& compared : methods) {
    chart.rows.push_back(compared.title);
    const compare::Measured& m = compared.measured;
    const auto put = [&](std::size_t column, double value, const std::string& text, bool warning = false) {
      chart.columns[column].values.push_back({value, text, warning});
    };
    if (!m.done()) {
      put(0, no_mark, m.end == compare::Apart::End::out_of_time ? fmt::format("not within {:g} s", limit) : "failed");
      for (std::size_t column = 1; column < 4; ++column) put(column, no_mark, "");
      continue;
    }
    put(0, m.median_seconds() * 1000, seconds_text(m.median_seconds()));
    put(1, m.heap < 0 ? no_mark : ratio(m.heap, 1024), bytes_text(m.heap));
    put(2, static_cast<double>(m.steps()), grouped(m.steps()));
    const compare::Agreement& a = compared.agreement;
    const std::int64_t differ = a.differing();
    if (!compared.comparable) put(3, no_mark, "not compared");
    else if (a.unexplained > 0)
      put(3, static_cast<double>(differ),
          (a.unexplained < differ ? grouped(differ) + ", " : "") + grouped(a.unexplained) + " wrong", true);
    else if (a.colors > 0)
      put(3, static_cast<double>(differ),
          (a.colors < differ ? grouped(differ) + ", " : "") + grouped(a.colors) + " in colour", compared.wrong());
    else put(3, static_cast<double>(differ), differ == 0 ? "0" : grouped(differ) + ", explained");
  }
  return draw_chart(chart);
}
#else
Drawing chart_of(const Scene&, const std::vector<compare::Compared>&, double) { return {}; }
#endif

namespace {

using compare::Apart;
using compare::Compared;
using compare::Measured;

/// A method to be run, with options of its own.
struct Entrant {
  const Method* method;
  Conventions conventions;
  std::string id, title;
};

/// "bsp:root=random": the method, then its options.
Entrant entrant_of(const std::string& text, const Conventions& conventions) {
  std::vector<std::string> ids;
  for (const Method& m : methods()) ids.emplace_back(m.id);
  const std::vector<std::string> parts = parts_of(text, ':');
  const Method& method = methods()[parse_choice("--methods", parts[0], ids)];
  Entrant entrant{&method, conventions, text, std::string(method.title)};
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const std::size_t equals = parts[k].find('=');
    if (equals == 0 || equals == std::string::npos)
      throw InputError("--methods " + text, fmt::format("'{}' is not NAME=VALUE", parts[k]),
                       "write METHOD:NAME=VALUE; 'zstep list options' names them");
    entrant.conventions.options[parts[k].substr(0, equals)] = parts[k].substr(equals + 1);
    entrant.title += ", " + parts[k];
  }
  return entrant;
}

/// The methods that were named, or all that can draw the scene; of these, says which cannot.
std::vector<Entrant> entrants_of(const CompareOptions& options, const Run& run) {
  std::vector<Entrant> entrants;
  if (!options.methods.empty()) {
    std::set<std::string> seen;
    for (const std::string& text : parts_of(options.methods, ',')) {
      entrants.push_back(entrant_of(text, run.conventions));
      check_run(*entrants.back().method, run.scene, entrants.back().conventions, "--methods " + text);
      if (!seen.insert(text).second)
        throw InputError("--methods", fmt::format("{} is named twice", text), "name each once");
    }
    return entrants;
  }
  for (const Method& m : methods()) {
    try {
      check_run(m, run.scene, run.conventions);
      entrants.push_back({&m, run.conventions, std::string(m.id), std::string(m.title)});
    } catch (const InputError& error) {
      complain(fmt::format("note: without {}: {}", m.title, error.what()));
    }
  }
  return entrants;
}

std::string end_text(const Measured& measured, double limit) {
  if (measured.end == Apart::End::out_of_time) return fmt::format("not done within {:g} s", limit);
  return "failed: " + measured.what;
}

void print_summary(const CompareOptions& options, const Run& run, const std::vector<Compared>& all) {
  using enum Table::Align;
  fmt::print("{}: {}, {}x{} pixels. Pictures are held against that of {}.\n\n", run.scene.name,
             counted(std::ssize(run.scene.polygons), "polygon", "polygons"), run.scene.raster.width,
             run.scene.raster.height, all.front().title);
  Table table({left, right, right, right, right, right, right, right, right, right});
  table.row({"METHOD", "EQUAL", "EDGES", "TIES", "WRONG", "COLOUR", "STEPS", "MEMORY", "TIME", "RUNS"});
  std::string ends;
  for (const Compared& compared : all) {
    const Measured& m = compared.measured;
    if (!m.done()) {
      table.row({compared.title, "-", "-", "-", "-", "-", "-", "-", "-", "-"});
      ends += fmt::format("{}: {}\n", compared.title, end_text(m, options.limit));
      continue;
    }
    const compare::Agreement& a = compared.agreement;
    const auto pixels = [&](std::int64_t count) { return compared.comparable ? grouped(count) : std::string("-"); };
    table.row({compared.title, pixels(a.equal), pixels(a.at_edges), pixels(a.ties), pixels(a.unexplained),
               pixels(a.colors), grouped(m.steps()), bytes_text(m.heap), seconds_text(m.median_seconds()),
               fmt::format("{}", m.seconds.size())});
  }
  fmt::print("{}{}\n", table.text(0), ends);
  fmt::print(
      "EQUAL, EDGES, TIES, WRONG: pixels with the same polygon in the same colour; with another polygon, as an edge "
      "runs\n"
      "within 1.5/256 of a pixel of the centre, or as depths are equal to 1e-5; and those that neither explains. "
      "COLOUR:\n"
      "pixels with the same polygon in another colour: one method shades, or the two shade otherwise. - where a "
      "method\n"
      "draws lines, or glass is mixed with what lies behind. STEPS: what a recording would hold.\n"
      "MEMORY: the most that a run holds at once, its picture included. TIME: of the processor, the median of\n"
      "runs without recording.\n");
}

void print_work(const std::vector<Compared>& all) {
  using enum Table::Align;
  for (const Compared& compared : all) {
    if (!compared.measured.done()) continue;
    fmt::print("\n{}\n", compared.title);
    Table table({right, left, left});
    for (const StepInfo& step : compared.measured.method->page()) {
      const std::int64_t count = compared.measured.count[step.id];
      if (count > 0) table.row({grouped(count), step.module + "." + step.name, step.text});
    }
    fmt::print("{}", table.text());
  }
}

/// Do two methods mean the same by the polygon at a pixel? One that draws lines has none, and one that mixes colours
/// names what is behind the glass.
bool have_same_polygons(const Scene& scene, const Method& one, const Method& other) {
  if (one.gives == Gives::lines || other.gives == Gives::lines) return false;
  const bool glass = std::any_of(scene.polygons.begin(), scene.polygons.end(),
                                 [](const Polygon& p) { return p.material->opacity < 1; });
  return !glass || (one.gives == Gives::mixtures) == (other.gives == Gives::mixtures);
}

int compare_scene(const CompareOptions& options) {
  Watch watch;  // from the start: loading takes its time, too
  check_outputs({}, {options.run.scene}, compare_outputs(options));
  const Run run = prepare(options.run);
  const std::vector<Entrant> entrants = entrants_of(options, run);
  if (entrants.empty())
    throw InputError(run.scene.name, "no method can draw it so", "'zstep list methods' says what they need");

  std::vector<Compared> all;
  bool stopped = false;
  try {
    for (const Entrant& entrant : entrants) {
      compare::MeasureOptions measuring;
      measuring.limit = options.limit;
      const auto tick = [&](double seconds) {
        watch.show(fmt::format("{} of {}: {}, {:.1f} s (Ctrl-C stops and prints what is done)", all.size() + 1,
                               entrants.size(), entrant.title, seconds));
      };
      Compared compared{entrant.id,
                        entrant.title,
                        compare::measure(*entrant.method, run.scene, entrant.conventions, measuring, tick),
                        {},
                        false};
      const Measured& first = all.empty() ? compared.measured : all.front().measured;
      compared.comparable =
          compared.measured.done() && first.done() && have_same_polygons(run.scene, *entrant.method, *first.method);
      compared.same_shading =
          compared.comparable && entrant.method->gives == (all.empty() ? entrant : entrants.front()).method->gives;
      if (compared.comparable)
        compared.agreement = compare::agreement(run.scene, run.conventions, first.picture, compared.measured.picture);
      all.push_back(std::move(compared));
    }
  } catch (const Interrupted&) {
    if (all.empty()) throw;
    stopped = true;
  }
  watch.clear_line();
  print_summary(options, run, all);
  if (options.steps) print_work(all);
  write_comparison(options, compare::csv_of(run.scene.name, all),
                   [&] { return chart_of(run.scene, all, options.limit); });
  if (stopped) complain(fmt::format("stopped by Ctrl-C after {} of {} methods", all.size(), entrants.size()));
  if (stopped) return exit_code::interrupted;
  const auto unfinished = [](const Compared& one) { return one.measured.end == compare::Apart::End::out_of_time; };
  if (std::any_of(all.begin(), all.end(), unfinished)) return exit_code::incomplete;
  const bool wrong = std::any_of(all.begin(), all.end(), [](const Compared& one) { return one.wrong(); });
  return wrong ? exit_code::finding : exit_code::done;
}

}  // namespace

void add_compare_methods(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand(
      "compare-methods", "Run several methods on one scene: do their pictures agree, what does each cost");
  command
      ->add_option("scene", options->run.scene,
                   "A built-in scene's name, a .toml scene, or a .obj, .off, .ply or .stl mesh")
      ->type_name("SCENE|MESH");
  const auto in = [&](CLI::Option* option) { option->group("Comparison"); };
  in(command
         ->add_option(
             "--methods", options->methods,
             "Which ones, as z-buffer,bsp or with options bsp:root=random (default: all that can draw the scene)")
         ->type_name("METHOD,…"));
  in(command->add_flag("--steps", options->steps, "Also say how often each method does each of its steps"));
  const auto take_limit = [options](const std::string& text) {
    options->limit = parse_number("--limit", text);
    if (!(options->limit > 0))
      throw InputError("--limit", fmt::format("'{}' is no time to run in", text), "give seconds above 0");
  };
  in(command
         ->add_option_function<std::string>("--limit", take_limit,
                                            "Seconds after which a method is stopped (default 60)")
         ->type_name("SECONDS"));
  in(command->add_flag("--table", options->table,
                       "The comparison table of the lecture: random scenes of 100, 2 500 and 60 000 polygons"));
  in(command->add_flag("--quick", options->quick, "The table from small rasters, without the largest scene"));
  const auto file = [&](const char* name, std::string& path, const char* type, const char* help) {
    command->add_option(name, path, help)->type_name(type)->group("Output");
  };
  in(command
         ->add_option("--modes", options->modes,
                      "Compare ways of interpolating with exact depths: all combinations of the words given for some "
                      "conventions, as depth=view,reciprocal; 'all' for all words; may be given more than once")
         ->type_name("CONVENTION=WORD,…")
         ->allow_extra_args(false)
         ->take_all());
  in(command->add_option("--sweep", options->sweep, "The same while the near or the far plane moves")
         ->type_name("near=FROM..TO"));
  file("--csv", options->csv, "FILE.csv", "Write the numbers, one a line: scene,method,measure,step,value");
  file("--plot", options->plot, "FILE.png|.svg", "Write a chart");
  add_run_options(*command, options->run, false);
  command->footer(
      "The first method is the one whose picture the others are held against.\n"
      "\n"
      "Examples:\n"
      "  zstep compare-methods intersecting --steps\n"
      "  zstep compare-methods teapot --size 160x120 --methods z-buffer,scan-line --csv teapot.csv --plot teapot.png\n"
      "  zstep compare-methods lessons/scenes/poster.toml --modes depth=all --modes number-format=float32,fixed16\n"
      "  zstep compare-methods --table --plot table.png");
  command->callback([options, &action] {
    action = [options] {
      if (options->table) return compare_table(*options);
      if (options->quick) throw InputError("--quick", "goes with --table", "leave it out, or give --table");
      const bool of_modes = !options->modes.empty() || !options->sweep.empty();
      if (options->run.scene.empty())
        throw InputError("zstep compare-methods", "there is no scene", "name one, or give --table");
      if (of_modes && (!options->methods.empty() || options->steps))
        throw InputError(options->steps ? "--steps" : "--methods", "does not go with --modes and --sweep",
                         "they compare ways of interpolating, by the Z-buffer");
      if (of_modes) check_outputs({}, {options->run.scene}, compare_outputs(*options));
      return of_modes ? compare_modes(*options) : compare_scene(*options);
    };
  });
}

}  // namespace zstep::cli
