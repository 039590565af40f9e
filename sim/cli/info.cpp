// zstep info, header and list: what a trace says about itself, the first line of a program's own trace, and what there
// is.

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/describe.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "traces/image/file.hpp"
#include "traces/file/written.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/visit.hpp"
#include "traces/mistakes/mistake.hpp"
#include "traces/scene.hpp"

namespace zstep::cli {
namespace {

using enum Table::Align;

/// What the header says of back faces, where that means something.
std::string back_faces_text(const Trace& trace, const std::string& declared) {
  if (trace.scene().camera.kind == Camera::Kind::screen) return "drawn: no eye sees which side is the back";
  for (const Method& method : methods())
    if (method.id == trace.header().algorithm && !method.culls) return "not dropped by this method's conventions";
  return declared;
}

std::string head_text(const Trace& trace, const std::string& path) {
  const Header& header = trace.header();
  const Scene& scene = trace.scene();
  Table table({left, left});
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  std::string size = counted(trace.size(), "step", "steps");
  if (!error) size += fmt::format(" in {} bytes", grouped(bytes));
  if (!error && trace.size() > 0) size += fmt::format(" ({:.2f} a step)", ratio(bytes, trace.size()));
  table.row({"trace", path});
  table.row({"written by", header.writer});
  table.row({"method", fmt::format("{} ({})", header.title, header.algorithm)});
  table.row({"size", size});
  table.row({"scene", fmt::format("{} ({}): {}, {}, {}", scene.name, scene.source,
                                  counted(std::ssize(scene.polygons), "polygon", "polygons"),
                                  counted(std::ssize(scene.facets), "facet", "facets"),
                                  counted(std::ssize(scene.points), "point", "points"))});
  table.row({"raster", raster_text(scene.raster)});
  if (header.written != WrittenAs{}) table.row({"as written", written_text(header.written)});
  table.row({"camera", camera_text(scene.camera)});
  // What the header does not declare is no fact.
  const auto declared = [&](Convention which, std::string text) {
    return header.declares(which) ? text : "not declared";
  };
  const std::string depth = depth_text(scene.camera, header.conventions.depth);
  table.row({"depth", scene.camera.kind == Camera::Kind::screen ? depth : declared(Convention::depth, depth)});
  table.row({"nearer", declared(Convention::nearer, nearer_text(header.comparison.nearer))});
  table.row({"ties", declared(Convention::ties, ties_text(header.comparison.ties))});
  if (header.initial_depth) table.row({"initial depth", value_text(*header.initial_depth)});
  std::string given;
  for (const auto& [name, value] : header.conventions.options)
    given += fmt::format("{}{}={}", given.empty() ? "" : ", ", name, value);
  if (!given.empty()) table.row({"options", given});
  table.row({"numbers", declared(Convention::number_format, numbers_text(header.conventions))});
  table.row(
      {"interpolation", declared(Convention::interpolation, interpolation_text(header.conventions.interpolation))});
  table.row({"coverage", declared(Convention::coverage, coverage_text(header.conventions.coverage, scene.raster))});
  const std::string cull = declared(Convention::cull, header.conventions.cull ? "culled" : "drawn");
  table.row({"back faces", back_faces_text(trace, cull)});
  return table.text(0);
}

int info(const std::string& path) {
  const Trace trace = open_trace(path);
  std::array<std::int64_t, 256> by_step{};
  std::array<std::int64_t, kind_count> by_kind{};
  trace.visit(0, trace.size(), [&](std::int64_t, std::uint8_t step, const auto& event) {
    ++by_step[step];
    ++by_kind[kind_of<std::decay_t<decltype(event)>>];
    return true;
  });

  const auto share = [&](std::int64_t count) {
    return fmt::format("{:.1f} %", trace.size() == 0 ? 0.0 : ratio(100 * count, trace.size()));
  };

  Table steps({left, left, right, right, left});
  steps.row({"STEP", "KIND", "COUNT", "SHARE", "PSEUDO-CODE"});
  for (const StepInfo& step : trace.header().page)
    steps.row({step.module + "." + step.name, std::string(kind_names()[step.kind]), fmt::format("{}", by_step[step.id]),
               share(by_step[step.id]), std::string(2 * std::size_t{step.indent}, ' ') + step.text});
  Table kinds({left, right, right});
  kinds.row({"KIND", "COUNT", "SHARE"});
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (by_kind[kind] > 0)
      kinds.row({std::string(kind_names()[kind]), fmt::format("{}", by_kind[kind]), share(by_kind[kind])});

  fmt::print("{}\n{}\n{}", head_text(trace, path), steps.text(0), kinds.text(0));
  return exit_code::done;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  const auto path = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("info", "Say what a trace holds: scene, conventions, and its steps counted");
  command->add_option("trace", *path, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->footer("Examples:\n  zstep info run.ztrace");
  command->callback([path, &action] { action = [path] { return info(*path); }; });
}

// zstep header: the first line of a program's own trace.

namespace {

struct HeaderOptions {
  RunOptions run;
  std::string writer = "a program", nearer, ties, out;
  std::optional<double> initial_depth;
  bool as_computed = false;
};

int write(const HeaderOptions& options) {
  if (!options.out.empty()) check_outputs({}, {options.run.scene}, {options.out});
  const Run run = prepare_within_budget(options.run);
  Header header = header_of(run);
  header.writer = options.writer;
  turn(header, Turned::as_written);  // what is asked for is as the program has it
  const auto choice = [](const char* name, const std::string& given, const std::vector<std::string>& words) {
    return given.empty() ? std::size_t{0} : parse_choice(name, given, words);
  };
  if (!options.nearer.empty())
    header.comparison.nearer =
        static_cast<Comparison::Nearer>(choice("--nearer", options.nearer, {"smaller", "greater"}));
  if (!options.ties.empty())
    header.comparison.ties = static_cast<Comparison::Ties>(choice("--ties", options.ties, {"first", "last"}));
  if (options.initial_depth) header.initial_depth = options.initial_depth;
  turn(header, Turned::as_own);
  std::string line = jsonl_header(header, run.scene);
  if (options.as_computed) {
    auto all = nlohmann::ordered_json::parse(line);
    all["conventions"]["number_format"] = "as computed";
    line = all.dump();
  }
  line += '\n';
  if (options.out.empty()) {
    fmt::print("{}", line);
    return exit_code::done;
  }
  write_file(options.out, std::span(reinterpret_cast<const std::uint8_t*>(line.data()), line.size()));
  say_written(options.out, fmt::format("the header of a run of {} on {}", run.method->title, run.scene.name));
  return exit_code::done;
}

}  // namespace

void add_header(CLI::App& app, Action& action) {
  const auto options = std::make_shared<HeaderOptions>();
  CLI::App* command = app.add_subcommand("header", "The first line of your own program's trace");
  add_run_options(*command, options->run);
  add_written_options(*command, options->run);
  add_scene(*command, options->run);
  add_limit_options(*command);
  command->add_option("--writer", options->writer, "The name of the program")->type_name("NAME");
  command
      ->add_option("--nearer", options->nearer,
                   "Which of two depths is nearer (default: the smaller one, but for some choices of --depth)")
      ->type_name("smaller|greater");
  command
      ->add_option("--ties", options->ties,
                   "Which of two polygons with equal depths stays: the one drawn first (default), or last")
      ->type_name("first|last");
  add_number(*command, "--initial-depth", options->initial_depth, "What the depth buffer is cleared to");
  command
      ->add_flag("--as-computed", options->as_computed,
                 "Say that the number format is not known: zstep infers it from the digits")
      ->excludes(command->get_option("--number-format"));
  command->add_option("-o,--output", options->out, "The file to write (default: print it)")->type_name("FILE.jsonl");
  command->footer(
      "Scene, conventions and pseudo-code as one line of JSON. Write it as the first line of your program's output, "
      "then\n"
      "one line for each step, which names a line of the pseudo-code: docs/trace-format.md.\n"
      "\n"
      "Examples:\n"
      "  zstep header delhi -o run.jsonl\n"
      "  zstep header pyramid --interpolation increments --number-format float32 --ties last");
  command->callback([options, &action] { action = [options] { return write(*options); }; });
}

// zstep list: what there is.

namespace {

using enum Table::Align;

std::string methods_text() {
  Table table({left, left, left});
  for (const Method& m : methods()) table.row({std::string(m.id), std::string(m.title), std::string(m.paper)});
  return table.text();
}

std::string options_text() {
  Table table({left, left, left, left});
  for (const Method& m : methods())
    for (const Option& option : m.options) {
      const std::string values =
          option.words.empty() ? fmt::format("{}…{}", option.least, option.most) : std::string(option.words);
      table.row(
          {std::string(m.id), fmt::format("{}={}", option.name, option.standard), values, std::string(option.meaning)});
    }
  return table.text();
}

std::string lessons_text() {
  Table table({left, left, left});
  for (const Lesson& lesson : all_lessons()) table.row({lesson.id, lesson.title, lesson.summary});
  const std::string text = table.text();
  return text.empty() ? "  none were found; set ZSTEP_LESSONS to the folder that holds them\n" : text;
}

std::string scenes_text() {
  Table table({left, left});
  for (const BuiltIn& scene : built_in_scenes()) table.row({std::string(scene.name), std::string(scene.description)});
  return table.text();
}

std::string mistakes_text() {
  Table table({left, left, left});
  for (const mistakes::Mistake mistake : values_of<mistakes::Mistake>) {
    const mistakes::MistakeText& text = mistakes::text_of(mistake);
    table.row({std::string(text.id), std::string(text.name), std::string(text.lesson)});
  }
  return table.text();
}

int list(const std::string& what) {
  const bool all = what.empty();
  if (all || what == "methods") fmt::print("{}{}", all ? "Methods (--algorithm NAME)\n" : "", methods_text());
  if (what == "options") fmt::print("{}", options_text());
  if (what == "mistakes") fmt::print("{}", mistakes_text());
  if (all || what == "lessons") fmt::print("{}{}", all ? "\nLessons (zstep lesson NAME)\n" : "", lessons_text());
  if (all || what == "scenes") {
    fmt::print("{}{}", all ? "\nScenes (zstep render NAME, record NAME, view NAME)\n" : "", scenes_text());
    fmt::print(
        "In place of a name: a .toml scene, a .obj, .off, .ply or .stl mesh, or a surface by its formula, \"y = sin(x) "
        "* cos(z)\".\n");
  }
  return exit_code::done;
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
  const auto what = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "list", "Name the methods and their options, the lessons, the scenes and the mistakes there are");
  const auto take = [what](const std::string& text) {
    const std::vector<std::string> words{"methods", "options", "lessons", "scenes", "mistakes"};
    *what = words.at(parse_choice("zstep list", text, words));
  };
  command->add_option_function<std::string>("what", take, "Only these")
      ->type_name("methods|options|lessons|scenes|mistakes");
  command->footer("Examples:\n  zstep list\n  zstep list lessons");
  command->callback([what, &action] { action = [what] { return list(*what); }; });
}

}  // namespace zstep::cli
