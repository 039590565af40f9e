// zstep view: a trace in the viewer.
#include <memory>

#include <fmt/format.h>

#include "algorithms/scene/files/read_mesh.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/diff.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/traces.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"

namespace zstep::cli {
namespace {

struct ViewOptionsOfCommand {
  RunOptions run;
  ShowOptions show;
  std::string against;
};

int view(const ViewOptionsOfCommand& options) {
  check_can_show(options.show);
  const std::string& what = options.run.scene;
  if (!options.against.empty())
    for (const std::string& path : {what, options.against})
      if (!is_trace(path))
        throw InputError(path, "is no trace, and --against holds two runs against each other",
                         "record both first: zstep record SCENE -o FILE.ztrace");
  if (!is_trace(what)) extend_budget(53);  // recording it is asked for
  if (!is_trace(what)) {
    const Run run = prepare(options.run);
    const auto shown = std::make_shared<const OtherRun>(options.show.patient
                                                            ? record_patiently(*run.method, run.scene, run.conventions)
                                                            : OtherRun{record_to_memory(run)});
    return show(shown->trace, options.show,
                {.whole = shown->whole, .finished = scene::mesh_format(what).has_value(), .kept = shown});
  }
  const std::string given = options.run.given();
  if (!given.empty())
    throw InputError(given, fmt::format("{} was recorded already, with options of its own", what),
                     "record the scene again with other ones");
  if (!options.against.empty()) {
    check_reads_once(what, options.against);
    note_input(what), note_input(options.against);
    return view_against(what, options.against, options.show);
  }
  const auto shown =
      std::make_shared<const Trace>(open_trace(what, options.show.opens_window() ? Cost::free : Cost::limited));
  return show(*shown, options.show, {.kept = shown});
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ViewOptionsOfCommand>();
  CLI::App* command =
      app.add_subcommand("view", "Step through a trace, or through a scene that is recorded on the spot");
  command->add_option("what", options->run.scene, "A .ztrace or .jsonl file, or a scene or mesh as record takes them")
      ->type_name("FILE.ztrace|SCENE|MESH")
      ->required();
  command->add_option("--against", options->against, "A second run beside it, stepped through together by meaning")
      ->type_name("FILE.ztrace");
  add_show_options(*command, options->show);
  add_race_options(*command, options->show);
  add_run_options(*command, options->run);
  command->footer(
      "Examples:\n"
      "  zstep view run.ztrace\n"
      "  zstep view run.ztrace --at 1056\n"
      "  zstep view right.ztrace --against homework.jsonl\n"
      "  zstep view teapot --size 64x48\n"
      "  zstep view intersecting --race z-buffer,depth-sort,warnock\n"
      "  zstep view pyramid --at 300 --screenshot pyramid.png --size-window 1920x1080");
  command->callback([options, &action] { action = [options] { return view(*options); }; });
}

}  // namespace zstep::cli
