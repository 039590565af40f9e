// zstep export: buffers as tables, contact sheets, films, the scene.

#include "sim/cli/export.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <vector>

#include "sim/answers/pixel_counts.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/outputs.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/film/video.hpp"
#include "traces/image/file.hpp"
#include "traces/image/tables.hpp"
#include "sim/pages/page.hpp"
#include "sim/viewer/pictures.hpp"
#include "traces/error.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::cli {
namespace {

const std::vector<std::string>& buffer_names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names{"frame", "colors", "depth", "light-frame", "light-depth"};
    for (const std::string_view name : answers::count_names) names.emplace_back(name);
    return names;
  }();
  return all;
}

template <class Value>
void write_table(const std::string& path, const std::vector<Value>& values, std::int32_t width, std::int32_t height,
                 const std::string& what) {
  if (std::filesystem::path(path).extension() == ".npy") {
    write_npy(path, std::span<const Value>(values), height, width);
  } else {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i)
      text += fmt::format("{}{}", values[i], (i + 1) % static_cast<std::size_t>(width) == 0 ? '\n' : ',');
    write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }
  say_written(path,
              fmt::format("{}, {} [{},{}]", what, std::is_same_v<Value, double> ? "float64" : "int32", height, width));
}

int export_table(const Trace& trace, const ExportOptions& options) {
  const std::int64_t at = options.at.empty() ? trace.size() : step_of(trace, options.at);
  const std::string buffer = options.buffer.empty() ? "depth" : options.buffer;
  const std::size_t place = parse_choice("--buffer", buffer, buffer_names());
  const Scene& scene = trace.scene();
  const bool y_up = scene.raster.y_up;
  const std::int32_t width = scene.raster.width, height = scene.raster.height;
  const std::string what = fmt::format("{} at step {}", buffer, at);
  const auto same = [](auto value) { return value; };
  constexpr std::size_t before_counts = 5;
  if (place >= before_counts) {
    Watch watch;
    answers::PixelCounts counts(trace);
    while (!counts.count_to(at, std::chrono::milliseconds(100)))
      watch.show(fmt::format("counting: step {} of {} (Ctrl-C stops)", grouped(counts.position()), grouped(at)));
    watch.clear_line();
    write_table(options.out,
                top_row_first<std::int32_t>(counts.of(static_cast<answers::Count>(place - before_counts)), width,
                                            height, y_up, same),
                width, height, what);
    return exit_code::done;
  }
  Replay replay(trace);
  replay.go_to(at);
  const State& state = replay.state();
  const Picture& picture = buffer.starts_with("light") ? state.light : state.picture;
  if (picture.depth.empty())
    throw InputError("--buffer", fmt::format("{} makes no picture as the light sees it", trace.header().algorithm),
                     "ask for frame or depth");
  const bool none = std::none_of(picture.depth.begin(), picture.depth.end(), [](double z) { return z != no_depth; });
  if (options.buffer.empty() && none &&
      std::any_of(picture.ink.begin(), picture.ink.end(), [](std::uint32_t ink) { return ink != no_ink; }))
    throw InputError("--buffer",
                     fmt::format("{} draws lines, which have no depth in a buffer", trace.header().algorithm),
                     "ask for colors");
  if (buffer.ends_with("depth")) {
    write_table(
        options.out,
        top_row_first<double>(picture.depth, picture.width, picture.height, y_up && &picture == &state.picture, same),
        picture.width, picture.height, what);
  } else if (buffer == "colors") {
    std::vector<std::int32_t> colors;
    for (std::size_t i = 0; i < picture.polygon.size(); ++i) {
      const Color c = color_at(picture, scene, i);
      colors.push_back(c.red << 16 | c.green << 8 | c.blue);
    }
    write_table(options.out, top_row_first<std::int32_t>(colors, width, height, y_up, same), width, height, what);
  } else {
    write_table(options.out,
                top_row_first<std::int32_t>(picture.polygon, picture.width, picture.height,
                                            y_up && &picture == &state.picture, same),
                picture.width, picture.height, what);
  }
  return exit_code::done;
}

int run_export(const ExportOptions& options) {
  const std::filesystem::path path = options.out;
  const std::string extension = path.extension().string();
  const bool scene = extension == ".toml";
  const bool table = extension == ".npy" || extension == ".csv", pictures = extension == ".png" || is_video(path);
  if (!table && !pictures && !scene)
    throw InputError(options.out, "does not say what to write",
                     "end its name with .npy or .csv (a buffer), .png (pictures), .gif, .mp4, .webm or .mkv (a film), "
                     ".toml (the scene)");
  check_outputs({}, {options.trace}, {options.out});
  const auto needless = [&](const char* name, bool given, const char* of) {
    if (given) throw InputError(name, fmt::format("does not go with {}", options.out), fmt::format("it is for {}", of));
  };
  needless("--buffer", !table && !options.buffer.empty(), "tables: .npy, .csv");
  for (const auto& [name, given] : {std::pair{"--sheet", options.sheet.has_value()},
                                    {"--steps", !options.steps.empty()},
                                    {"--from", options.from.has_value()},
                                    {"--to", options.to.has_value()},
                                    {"--pane", !options.pane.empty()}})
    needless(name, !pictures && given, "pictures: .png, .gif, .mp4");
  needless("--fps", !is_video(path) && options.fps.has_value(), "films: .gif, .mp4, .webm, .mkv");
  const Trace trace = open_trace(options.trace);
  if (pictures) return export_pictures(trace, options);
  if (scene) {
    write_scene_file(options.out, trace.scene(), trace.header().conventions, trace.header().algorithm);
    return exit_code::done;
  }
  return export_table(trace, options);
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ExportOptions>();
  std::string buffers;
  for (const std::string& name : buffer_names()) buffers += (buffers.empty() ? "" : "|") + name;
  CLI::App* command =
      app.add_subcommand("export", "Write a buffer of any step as a table, a sheet of pictures, a film, or the scene");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_option("-o,--out", options->out, "What to write; its extension says in which form")
      ->type_name("FILE")
      ->required();
  command->add_option("--at", options->at, "At this step, part of the trace or bookmark (default: the end)")
      ->type_name("STEP|PERCENT%|BOOKMARK");
  command->add_option("--buffer", options->buffer, "Which buffer, as .npy or .csv (default depth)")->type_name(buffers);
  add_whole(*command, "--sheet", options->sheet, 1, "A contact sheet of so many steps, evenly apart")
      ->type_name("N")
      ->group("Pictures");
  command->add_option("--steps", options->steps, "Of these steps and bookmarks")
      ->type_name("A,B,...")
      ->group("Pictures");
  add_whole(*command, "--from", options->from, 0, "First step (default 0)")->group("Pictures");
  add_whole(*command, "--to", options->to, 0, "Last step (default: the end)")->group("Pictures");
  add_whole(*command, "--frames", options->frames, 2, "How many frames a film has (default: one a step, at most 200)")
      ->type_name("N")
      ->group("Pictures");
  add_number(*command, "--fps", options->fps, "Frames a second of a film (default 10)");
  add_whole(*command, "--columns", options->columns, 1, "Pictures in a row of a sheet")
      ->type_name("N")
      ->group("Pictures");
  command->add_option("--pane", options->pane, "One pane instead of the window: frame, depth, pseudo-code, ...")
      ->type_name("PANE")
      ->group("Pictures");
  const auto take_size = [options](const std::string& text) { options->size = parse_size("--size-window", text); };
  command->add_option_function<std::string>("--size-window", take_size, "Size of each picture")
      ->type_name("WxH")
      ->group("Pictures");
  command->add_flag("--dark", options->dark, "Dark colours")->group("Pictures");
  command->footer(
      "Films need ffmpeg. Rows of tables begin at the top.\n"
      "\n"
      "Examples:\n"
      "  zstep export run.ztrace --at 1056 --buffer depth -o depth.npy\n"
      "  zstep export run.ztrace --buffer overdraw -o overdraw.csv\n"
      "  zstep export run.ztrace --sheet 12 -o handout.png\n"
      "  zstep export run.ztrace -o scene.toml\n"
      "  zstep export run.ztrace --from 300 --to 400 --pane frame -o run.gif");
  command->callback([options, &action] { action = [options] { return run_export(*options); }; });
}

// zstep export of pictures: one, several on a sheet, a film.

#if ZSTEP_HAS_VIEWER
namespace {

constexpr std::int64_t most_on_a_sheet = 100, most_frames = 100'000;
constexpr std::int32_t longest_side = 16384;

std::vector<std::int64_t> steps_of(const Trace& trace, const ExportOptions& options, std::int64_t count) {
  if (!options.steps.empty()) {
    if (options.from || options.to) throw InputError("--steps", "names each step", "leave out --from and --to");
    std::vector<std::int64_t> steps;
    std::string_view left = options.steps;
    while (true) {
      const std::size_t end = std::min(left.find(','), left.size());
      if (end == 0) throw InputError("--steps", "a step is missing", "write for example --steps 12,40,97");
      steps.push_back(step_of(trace, std::string(left.substr(0, end)), "--steps"));
      if (end == left.size()) return steps;
      left.remove_prefix(end + 1);
    }
  }
  const std::int64_t first = options.from.value_or(0), last = options.to.value_or(trace.size());
  if (last > trace.size())
    throw InputError("--to", fmt::format("the trace ends at step {}", trace.size()), "give a smaller one");
  if (first > last)
    throw InputError("--from", fmt::format("is {}, but the last step is {}", first, last), "give a smaller one");
  return film_steps(first, last, count);
}

PictureOptions how(const ExportOptions& options, std::int32_t width, std::int32_t height) {
  PictureOptions pictures;
  pictures.width = options.size ? (*options.size)[0] : width;
  pictures.height = options.size ? (*options.size)[1] : height;
  if (pictures.width > longest_side || pictures.height > longest_side)
    throw InputError("--size-window", "is larger than any screen", "give at most 16384x16384");
  pictures.dark = options.dark;
  pictures.pane = options.pane;
  return pictures;
}

int sheet(const Trace& trace, const ExportOptions& options) {
  if (options.sheet && !options.steps.empty())
    throw InputError("--sheet", "and --steps are both given", "keep one of them");
  if (options.sheet.value_or(1) > most_on_a_sheet)
    throw InputError("--sheet", fmt::format("has more than {} pictures", most_on_a_sheet), "give a smaller number");
  const std::vector<std::int64_t> steps = steps_of(trace, options, options.sheet.value_or(0));
  const std::int64_t count = steps.size();
  if (count > most_on_a_sheet)
    throw InputError("--steps", fmt::format("are more than {}", most_on_a_sheet), "name fewer");
  PictureOptions pictures = how(options, 400, 340);
  if (pictures.pane.empty()) pictures.pane = "frame";
  const std::int64_t wide =
      std::min(count, options.columns.value_or(std::max<std::int64_t>(
                          1, std::llround(std::ceil(std::sqrt(static_cast<double>(count) * 1.2))))));
  const std::int64_t rows = (count + wide - 1) / wide;
  const std::int64_t columns =
      options.columns ? wide : (count + rows - 1) / rows;  // no row much shorter than the others
  if (columns * pictures.width > 2 * longest_side || rows * pictures.height > 2 * longest_side)
    throw InputError("--size-window", "makes a sheet that is too large", "give fewer or smaller pictures");
  extend_budget(0.1 * static_cast<double>(steps.size()));
  const Image image = contact_sheet(trace, steps, pictures, static_cast<int>(columns));
  write_png(options.out, image.width, image.height, image.rgb);
  say_written(options.out, fmt::format("{}, {}x{} pixels", counted(count, "step", "steps"), image.width, image.height));
  return exit_code::done;
}

int film(const Trace& trace, const ExportOptions& options) {
  const double fps = options.fps.value_or(usual_frames_a_second);
  if (!(fps > 0 && fps <= 100))
    throw InputError("--fps", fmt::format("{} is not more than 0 and at most 100", fps), "write for example --fps 10");
  if (options.frames.value_or(0) > most_frames)
    throw InputError("--frames", fmt::format("is more than {}", most_frames), "give a smaller number");
  const std::vector<std::int64_t> steps = steps_of(trace, options, options.frames.value_or(0));
  const PictureOptions size = how(options, options.pane.empty() ? 1280 : 640, options.pane.empty() ? 720 : 520);
  Watch watch;
  extend_budget(0.25 * static_cast<double>(steps.size()));
  Pictures pictures(trace, size);
  Video video(options.out, size.width, size.height, fps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    video.frame(pictures.at(steps[i]));
    watch.show(fmt::format("frame {} of {} (Ctrl-C stops)", i + 1, steps.size()));
  }
  watch.clear_line();
  video.finish();
  say_written(options.out, fmt::format("{} at {} a second, {}x{} pixels", counted(std::ssize(steps), "frame", "frames"),
                                       fps, size.width, size.height));
  return exit_code::done;
}

}  // namespace

int export_pictures(const Trace& trace, const ExportOptions& options) {
  if (is_video(options.out)) {
    if (!options.at.empty() || options.sheet || options.columns)
      throw InputError(options.out, "is a film", "it takes --from, --to, --frames, --fps, or --steps");
    return film(trace, options);
  }
  if (options.sheet || !options.steps.empty()) {
    if (!options.at.empty())
      throw InputError("--at", "names one step, and a sheet has several", "use --steps, or --from and --to");
    return sheet(trace, options);
  }
  if (options.from || options.to || options.frames || options.columns)
    throw InputError(options.out, "is a picture of one step",
                     "add --sheet 12 for a sheet of several, or give a film's name");
  const PictureOptions size = how(options, 1280, 720);
  const std::int64_t at = options.at.empty() ? trace.size() : step_of(trace, options.at);
  const Image image = Pictures(trace, size).at(at);
  write_png(options.out, image.width, image.height, image.rgb);
  say_written(options.out, fmt::format("step {}, {}x{} pixels", at, image.width, image.height));
  return exit_code::done;
}
#else
int export_pictures(const Trace&, const ExportOptions& options) {
  throw InputError(options.out, "this zstep was built without the viewer, which draws it",
                   "install SDL2 and Dear ImGui and build again with -DZSTEP_VIEWER=ON");
}
#endif

}  // namespace zstep::cli
