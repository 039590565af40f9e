// zstep render: the picture, without a trace.
#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/words.hpp"
#include "sim/scenes/save_scene.hpp"

namespace zstep::cli {
namespace {

struct RenderOptions {
  RunOptions run;
  Outputs outputs;
};

std::int64_t polygons_seen(const Picture& picture, std::size_t polygons) {
  std::vector<char> seen(polygons, 0);
  for (const std::int32_t polygon : picture.polygon)
    if (polygon != no_polygon) seen.at(static_cast<std::size_t>(polygon)) = 1;
  return std::count(seen.begin(), seen.end(), 1);
}

int render(const RenderOptions& options) {
  Outputs outputs = options.outputs;
  check_outputs(outputs, {options.run.scene});
  const Run run = prepare_within_budget(options.run);
  check_gives(outputs, *run.method);
  if (!outputs.any()) {
    outputs.image = file_stem(run.scene) + ".png";
    check_outputs(outputs, {options.run.scene});
  }
  write_scene_asked(outputs, run.scene, run.conventions, *run.method);
  NullRecorder nothing;
  const Picture picture = run.method->render(run.scene, run.conventions, nothing);
  write_outputs(outputs, picture, run.scene, run.conventions);
  if (run.method->gives == Gives::lines || run.method->gives == Gives::mixtures) {
    const auto drawn =
        std::count_if(picture.ink.begin(), picture.ink.end(), [](std::uint32_t ink) { return ink != no_ink; });
    fmt::print("{}: {} drawn by {}\n", run.scene.name, counted(drawn, "pixel", "pixels"), run.method->title);
    return exit_code::done;
  }
  const std::size_t polygons = run.scene.polygons.size();
  fmt::print("{}: {} of {} seen by {}\n", run.scene.name, grouped(polygons_seen(picture, polygons)),
             counted(static_cast<std::int64_t>(polygons), "polygon", "polygons"), run.method->title);
  return exit_code::done;
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Draw a scene or a mesh and write the picture");
  add_scene(*command, options->run);
  add_outputs(*command, options->outputs);
  add_run_options(*command, options->run);
  add_limit_options(*command);
  command->footer(
      "Without any --save… the picture goes to NAME.png in the current folder. Existing files are replaced.\n"
      "\n"
      "Examples:\n"
      "  zstep render teapot --size 640x480\n"
      "  zstep render pyramid --save p.png --enlarge 8\n"
      "  zstep render bunny.obj --fit --rho 3 --theta 45 --phi 70 --save bunny.png --save-depth bunny.npy");
  command->callback([options, &action] { action = [options] { return render(*options); }; });
}

}  // namespace zstep::cli
