// zstep info: what a trace says about itself, and what it is made of.
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/describe.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/visit.hpp"

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
  if (!error) size += fmt::format(" in {} bytes", grouped(static_cast<std::int64_t>(bytes)));
  if (!error && trace.size() > 0)
    size += fmt::format(" ({:.2f} a step)", static_cast<double>(bytes) / static_cast<double>(trace.size()));
  table.row({"trace", path});
  table.row({"written by", header.writer});
  table.row({"method", fmt::format("{} ({})", header.title, header.algorithm)});
  table.row({"size", size});
  table.row({"scene", fmt::format("{} ({}): {}, {}, {}", scene.name, scene.source,
                                  counted(static_cast<std::int64_t>(scene.polygons.size()), "polygon", "polygons"),
                                  counted(static_cast<std::int64_t>(scene.facets.size()), "facet", "facets"),
                                  counted(static_cast<std::int64_t>(scene.points.size()), "point", "points"))});
  table.row({"raster", raster_text(scene.raster)});
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
    return fmt::format(
        "{:.1f} %", trace.size() == 0 ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(trace.size()));
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

}  // namespace zstep::cli
