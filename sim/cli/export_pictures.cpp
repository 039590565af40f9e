// zstep export of pictures: one, several on a sheet, a film.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/export.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/watch.hpp"
#include "sim/cli/words.hpp"
#include "sim/film/video.hpp"
#include "sim/viewer/pictures.hpp"
#include "traces/error.hpp"

namespace zstep::cli {

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
  const auto count = static_cast<std::int64_t>(steps.size());
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
  say_written(options.out, fmt::format("{} at {} a second, {}x{} pixels",
                                       counted(static_cast<std::int64_t>(steps.size()), "frame", "frames"), fps,
                                       size.width, size.height));
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
