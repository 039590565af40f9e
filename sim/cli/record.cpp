// zstep record and render: a run into a file, and a picture without a run.

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/words.hpp"
#include "sim/scenes/save_scene.hpp"
#include "traces/error.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::cli {
namespace {

struct RecordOptions {
  RunOptions run;
  Outputs outputs;
  std::string trace;
};

std::string megabytes(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error) return "";
  return bytes < 100000 ? fmt::format(", {} bytes", grouped(bytes))
                        : fmt::format(", {:.1f} MB", ratio(bytes, 1'000'000));
}

int record(const RecordOptions& options) {
  const std::vector<std::string> inputs{options.run.scene};
  std::string path = options.trace;
  if (!path.empty()) check_outputs(options.outputs, inputs, {path});
  const Run run = prepare_within_budget(options.run);
  check_gives(options.outputs, *run.method);
  if (path.empty()) {
    path = file_stem(run.scene) + ".ztrace";
    check_outputs(options.outputs, inputs, {path});
  }

  write_scene_asked(options.outputs, run.scene, run.conventions, *run.method);
  TraceRecorder recorder(path, header_of(run), run.scene);
  std::optional<Picture> picture;
  bool out_of_time = false;
  try {
    Watch watch;
    watch.attach(recorder);
    picture = run.method->record(run.scene, run.conventions, recorder);
  } catch (const Interrupted&) {
    // What was recorded so far is kept: the file ends as every trace does.
  } catch (const Incomplete&) {
    out_of_time = true;  // likewise
  }
  recorder.on_block(nullptr);
  if (out_of_time) end_budget();
  recorder.finish();
  if (out_of_time)
    throw Incomplete(path,
                     fmt::format("stopped after {}, as time was up; the file holds them and can be opened",
                                 counted(recorder.size(), "step", "steps")),
                     "give --seconds more");
  if (!picture) {
    complain(fmt::format("{}: stopped by Ctrl-C after {}; the file holds them and can be opened", path,
                         counted(recorder.size(), "step", "steps")));
    return exit_code::interrupted;
  }
  say_written(path, fmt::format("{} of {} on {}{}", counted(recorder.size(), "step", "steps"), run.method->title,
                                run.scene.name, megabytes(path)));
  write_outputs(options.outputs, *picture, run.scene, run.conventions);
  return exit_code::done;
}

}  // namespace

void add_record(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RecordOptions>();
  CLI::App* command =
      app.add_subcommand("record", "Run a method on a scene or a mesh and record every step as a trace");
  add_scene(*command, options->run);
  command->add_option("-o,--output", options->trace, "The trace to write (default: NAME.ztrace in the current folder)")
      ->type_name("FILE.ztrace")
      ->group("Output");
  add_outputs(*command, options->outputs);
  add_run_options(*command, options->run);
  add_written_options(*command, options->run);
  add_limit_options(*command);
  command->footer(
      "Existing files are replaced. Ctrl-C ends the recording early and keeps what was recorded so far.\n"
      "\n"
      "Examples:\n"
      "  zstep record pyramid-behind -o run.ztrace\n"
      "  zstep record teapot --size 640x480 -o teapot.ztrace --save teapot.png\n"
      "  zstep record bunny.obj --fit --interpolation increments -o bunny.ztrace\n"
      "  zstep view run.ztrace");
  command->callback([options, &action] { action = [options] { return record(*options); }; });
}

// zstep render: the picture, without a trace.

namespace {

struct RenderOptions {
  RunOptions run;
  Outputs outputs;
};

std::int64_t polygons_seen(const Picture& picture, std::size_t polygons) {
  std::vector<char> seen(polygons, 0);
  for (const std::int32_t polygon : picture.polygon)
    if (polygon != no_polygon) seen.at(polygon) = 1;
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
