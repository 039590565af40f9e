// zstep why-not: why a polygon is not what is seen, at a pixel or anywhere.
#include <memory>

#include <fmt/format.h>

#include "sim/answers/why_not.hpp"
#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/words/explain.hpp"
#include "traces/error.hpp"

namespace zstep::cli {
namespace {

struct WhyNotOptions {
  std::string trace, polygon;
  std::string x, y;
};

std::int32_t polygon_typed(const Scene& scene, const std::string& text) {
  if (const auto polygon = answers::polygon_called(scene, text)) return *polygon;
  std::vector<std::string> names;
  for (const Polygon& polygon : scene.polygons)
    if (!polygon.name->empty()) names.push_back(*polygon.name);
  const std::string usual =
      scene.polygons.empty() ? "the scene has no polygons"
                             : fmt::format("its polygons are numbered from 0 to {}{}", scene.polygons.size() - 1,
                                           names.empty() ? "" : fmt::format(", the first is called {}", names.front()));
  throw InputError(text, "is no polygon of this trace", did_you_mean(text, names, usual));
}

int why_not(const WhyNotOptions& options) {
  const Trace trace = open_trace(options.trace);
  const Raster& raster = trace.scene().raster;
  const std::int32_t polygon = polygon_typed(trace.scene(), options.polygon);
  answers::Verdict verdict;
  if (options.x.empty()) {
    verdict = answers::why_not(trace, polygon);
  } else {
    if (options.y.empty())
      throw InputError("Y", "is missing: a pixel has a column and a row",
                       "write for example zstep why-not run.ztrace B 15 12");
    const std::int64_t x = parse_whole("X", options.x, 0), y = parse_whole("Y", options.y, 0);
    if (x >= raster.width || y >= raster.height)
      throw InputError(fmt::format("{} {}", x, y),
                       fmt::format("is no pixel: the picture has {} by {}", raster.width, raster.height),
                       "columns and rows count from 0");
    verdict = answers::why_not(trace, polygon, {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)});
  }
  fmt::print("{}\n", verdict.sentence);
  for (const std::string& formula : verdict.formulas) fmt::print("  {}\n", formula);
  if (verdict.chain.empty()) return exit_code::done;
  using enum Table::Align;
  Table table({right, left, left});
  table.row({"STEP", "POLYGON", "WHAT"});
  for (const answers::Link& link : verdict.chain)
    table.row(
        {grouped(link.step), link.polygon == no_polygon ? "" : polygon_label(trace.scene(), link.polygon), link.text});
  fmt::print("\n{}", table.text(0));
  return exit_code::done;
}

}  // namespace

void add_why_not(CLI::App& app, Action& action) {
  const auto options = std::make_shared<WhyNotOptions>();
  CLI::App* command = app.add_subcommand("why-not", "Tell why a polygon is not what is seen");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_option("polygon", options->polygon, "The polygon, by name or number")->type_name("POLYGON")->required();
  command->add_option("x", options->x, "The pixel's column, from 0; without a pixel the whole picture is examined")
      ->type_name("X");
  command->add_option("y", options->y, "Its row")->type_name("Y");
  command->footer(
      "The sentence comes first, then the numbers, then the steps that led there. Visible polygons are explained as\n"
      "well.\n"
      "\n"
      "Examples:\n"
      "  zstep why-not run.ztrace B 15 12\n"
      "  zstep why-not run.ztrace G");
  command->callback([options, &action] { action = [options] { return why_not(*options); }; });
}

}  // namespace zstep::cli
