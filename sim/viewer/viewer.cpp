// How the viewer begins: a window, one picture, or text.
#include "sim/viewer/viewer.hpp"

#include <fmt/format.h>

#include "traces/image/png.hpp"
#include "sim/viewer/description.hpp"
#include "sim/viewer/loop.hpp"
#include "sim/viewer/pictures.hpp"
#include "sim/viewer/system.hpp"

namespace zstep {
namespace {

using namespace viewer;

int write_screenshot(const Trace& trace, const ViewerOptions& options) {
  PictureOptions how;
  const WindowSize size = options.size.value_or(WindowSize());
  how.width = size.width, how.height = size.height;
  how.dark = options.dark.value_or(false), how.presenter = options.presenter;
  how.embed = options.embed;
  how.notes = options.notes;
  how.pane = options.pane, how.lesson = options.lesson, how.checked = options.checked;
  how.against = options.against;
  how.race = options.race, how.run_by = options.run_changed, how.offers = options.offers;
  how.pixel = options.pixel, how.lead = options.lead, how.finished = options.finished;
  Pictures pictures(trace, how);
  const bool says_impossible = how.pane.empty() && !how.notes && !how.embed;
  const Image image = options.stop ? pictures.at_stop(*options.stop) : pictures.at(options.at, says_impossible);
  write_png(*options.screenshot, image.width, image.height, image.rgb);
  return 0;
}

}  // namespace

std::string last_lesson() {
  const Settings settings = load_settings(settings_path());
  return settings.lessons.empty() ? "" : settings.lessons.back().first;
}

std::string described(const Trace& trace, const ViewerOptions& options) {
  Settings settings;
  App app(trace, options.lesson, settings, 640, 360);
  if (options.checked) app.show_findings(*options.checked);
  if (options.against) app.show_against(*options.against);
  go_to_start(app, options);
  return describe(app);
}

int run_viewer(const Trace& trace, const ViewerOptions& options) {
  if (options.screenshot) return write_screenshot(trace, options);
  system::keep_turning(std::make_unique<Loop>(trace, options));
  return 0;
}

}  // namespace zstep
