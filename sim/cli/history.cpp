// zstep history: everything that happened to one pixel.
#include <memory>

#include <fmt/format.h>

#include "sim/answers/pixel_history.hpp"
#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/words/explain.hpp"
#include "traces/error.hpp"
#include "traces/file/trace_impl.hpp"

namespace zstep::cli {
namespace {

struct HistoryOptions {
  std::string trace;
  std::string x, y;
  bool why = false;
};

int history(const HistoryOptions& options) {
  const Trace trace = open_trace(options.trace);
  const Raster& raster = trace.scene().raster;
  const std::int64_t x = parse_whole("X", options.x, 0), y = parse_whole("Y", options.y, 0);
  if (x >= raster.width || y >= raster.height)
    throw InputError(fmt::format("{} {}", x, y),
                     fmt::format("is no pixel: the picture has {} by {}", raster.width, raster.height),
                     "columns and rows count from 0");
  std::vector<answers::Visit> all =
      answers::pixel_history(trace, {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)});
  if (all.empty()) {
    fmt::print("pixel ({}, {}): no step reaches it{}; it shows the background\n", x, y,
               trace.whole() ? "" : " before the recording was cut off");
    return exit_code::done;
  }
  using enum Table::Align;
  Table table({right, left, right, right, left, left});
  const bool rays = trace.has(kind_of<RayBegin>);
  table.row({"STEP", "POLYGON", rays ? "T" : "DEPTH", "AGAINST", "OF", "OUTCOME"});
  std::string why;
  Replay replay(trace);
  for (answers::Visit& visit : all) {
    if (options.why) answers::tell(replay, visit);
    const std::string polygon = visit.polygon == no_polygon ? "" : polygon_label(trace.scene(), visit.polygon);
    const std::string of = !visit.stored ? "" : polygon_label(trace.scene(), visit.stored_polygon);
    table.row({grouped(visit.step), polygon, visit.z ? answers::depth_text(*visit.z) : "",
               visit.stored ? answers::depth_text(*visit.stored) : "", of, answers::outcome_text(trace, all, visit)});
    why += fmt::format("\n{}: {}\n", grouped(visit.step), visit.sentence);
    for (const std::string& formula : visit.formulas) why += "  " + formula + "\n";
  }
  fmt::print("{}", table.text(0));
  if (options.why) fmt::print("{}", why);
  return exit_code::done;
}

}  // namespace

void add_history(CLI::App& app, Action& action) {
  const auto options = std::make_shared<HistoryOptions>();
  CLI::App* command = app.add_subcommand("history", "Tell everything that happened to one pixel");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_option("x", options->x, "The pixel's column, from 0")->type_name("X")->required();
  command->add_option("y", options->y, "Its row")->type_name("Y")->required();
  command->add_flag("--why", options->why, "Each step in words, with its numbers");
  command->footer(
      "Polygons that cover the pixel's centre and were not drawn (culled, seen edge-on, out of view) are told, too; "
      "so\n"
      "are those that were found to be behind on a whole interval of a scan line or a whole area, with their planes' "
      "depths.\n"
      "\n"
      "Examples:\n"
      "  zstep history run.ztrace 15 12\n"
      "  zstep history run.ztrace 15 12 --why");
  command->callback([options, &action] { action = [options] { return history(*options); }; });
}

}  // namespace zstep::cli
