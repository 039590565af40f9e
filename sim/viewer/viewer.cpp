// The window around the App: opens it, feeds it events, shows its surface, keeps what stays.
#include "sim/viewer/viewer.hpp"
#include "sim/viewer/file_dialogue.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "sim/image/png.hpp"
#include "sim/viewer/description.hpp"
#include "sim/viewer/pictures.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/viewer/window.hpp"
#include "traces/error.hpp"

namespace zstep {
namespace {

using namespace viewer;

void go_to_start(App& app, const Trace& trace, const ViewerOptions& options) {
  Session& s = app.session();
  if (options.stop) return s.to_stop(*options.stop);
  if (options.at >= 0) return go_to_or_throw(s, options.at);
  if (app.opens_at_cause()) return app.to_first_cause();
  if (const auto place = app.settings().place(place_key(trace))) return s.go_to(*place);
  if (options.lesson && !options.lesson->stops.empty()) s.to_stop(0);
}

int write_screenshot(const Trace& trace, const ViewerOptions& options) {
  PictureOptions how;
  const WindowSize size = options.size.value_or(WindowSize());
  how.width = size.width, how.height = size.height;
  how.dark = options.dark.value_or(false), how.presenter = options.presenter;
  how.pane = options.pane, how.lesson = options.lesson, how.checked = options.checked;
  how.against = options.against;
  how.race = options.race, how.run_by = options.run_changed;
  Pictures pictures(trace, how);
  const Image image = options.stop ? pictures.at_stop(*options.stop) : pictures.at(options.at);
  write_png(*options.screenshot, image.width, image.height, image.rgb);
  return 0;
}

void name_window(const Window& window, const Trace& trace) {
  SDL_SetWindowTitle(window.get(),
                     fmt::format("zstep \u00b7 {} \u00b7 {}", trace.header().title, trace.scene().name).c_str());
}

void serve(Stage& stage, const Window& window, FileDialogue& dialogue) {
  if (const int direction = std::exchange(stage.app().requests.switch_method, 0); direction != 0) {
    stage.switch_method(direction);
    name_window(window, stage.trace());
  }
  if (const auto offer = std::exchange(stage.app().requests.open, std::nullopt)) {
    stage.open(*offer);
    name_window(window, stage.trace());
  }
  const bool goes_on = stage.app().requests.change_goes_on;
  for (const Change& change : std::exchange(stage.app().requests.changes, {})) stage.change(change, goes_on);
  if (const int direction = std::exchange(stage.app().requests.undo_change, 0); direction != 0) stage.undo(direction);
  App& app = stage.app();
  WindowRequests& r = app.requests;
  if (r.toggle_full_screen)
    SDL_SetWindowFullscreen(window.get(), window.full_screen() ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
  if (r.choose_file && !dialogue.ask(std::filesystem::current_path()))
    app.say_on_start("This desktop has no dialogue for files (zenity or kdialog); type the path of a file.");
  if (r.clipboard) SDL_SetClipboardText(r.clipboard->c_str());
  if (r.save_picture) {
    try {
      write_png(*r.save_picture, app.renderer().width(), app.renderer().height(), app.renderer().rgb());
      app.say("Saved " + *r.save_picture + " in the folder zstep was started in.");
    } catch (const InputError& error) {
      app.say(error.what());
    }
  }
  const bool quit = r.quit;
  r = {};
  r.quit = quit;
}

double seconds() {
  return static_cast<double>(SDL_GetPerformanceCounter()) / static_cast<double>(SDL_GetPerformanceFrequency());
}

/// What stays from run to run, saved when it has changed and at the end.
class Keeper {
 public:
  Keeper(const Settings& stored, const Settings& begun) : stored_(stored), begun_(begun), saved_(stored) {}

  void save(Stage& stage, const Window& window, bool at_end) {
    App& app = stage.app();
    // What options set for this run alone is left out.
    Settings kept = kept_settings(stored_, begun_, app.settings());
    if (!window.full_screen()) SDL_GetWindowSize(window.get(), &kept.width, &kept.height);
    kept.speed = app.session().speed;
    if (!at_end && kept.same_but_for_places(saved_)) return;
    // The trace that was opened keeps its place whatever was looked at besides.
    kept.remember(place_key(stage.trace()), app.session().position());
    kept.remember(place_key(stage.first()), stage.first_app().session().position());
    const std::filesystem::path path = settings_path();
    if (!path.empty() && !save_settings(path, kept) && at_end)
      fmt::print(stderr, "zstep: the viewer's settings could not be saved to {}\n", path.string());
    saved_ = std::move(kept);
  }

 private:
  const Settings stored_, begun_;
  Settings saved_;
};

void loop(Stage& stage, const Window& window, Keeper& keeper) {
  FileDialogue dialogue;
  int frames_due = App::frames_to_settle;  // after a change, until nothing moves any more
  std::uint64_t drawn = 0;
  const App* drawn_app = nullptr;
  bool on_way = false;  // the title says so
  while (!stage.app().requests.quit) {
    stage.app().ends_waiting = &Window::is_ended;
    stage.app().session().on_way = [&, begun = seconds()](double share) mutable {
      if (share == 0) begun = seconds();
      if (seconds() - begun < 0.25) return false;
      if (!std::exchange(on_way, true))
        SDL_SetWindowTitle(window.get(),
                           fmt::format("{} \u00b7 on the way, Esc ends it", SDL_GetWindowTitle(window.get())).c_str());
      window.show_progress(share);
      return Window::is_ended();
    };
    if (std::exchange(drawn_app, &stage.app()) != &stage.app()) drawn = 0;  // another run's
    const double time = seconds();
    const double wait = std::min(stage.app().play(time), stage.app().until_clock());
    if (std::floor(time) != std::floor(std::exchange(stage.app().clock_time, time)) && stage.app().board().clock_runs())
      stage.app().session().touch();
    if (stage.app().session().revision() != drawn) frames_due = std::max(frames_due, App::frames_to_settle);
    stage.app().moves = true;
    if (frames_due <= 0) keeper.save(stage, window, false);  // nothing moves, and no hand pulls a border
    SDL_Event event;
    const int milliseconds = frames_due > 0 ? 0 : static_cast<int>(std::min(wait, 3600.0) * 1000);
    bool got = milliseconds > 0 ? SDL_WaitEventTimeout(&event, milliseconds) != 0 : SDL_PollEvent(&event) != 0;
    while (got) {
      frames_due = std::max(frames_due, App::frames_to_settle);
      if (stage.app().handle(event, window.pixels_per_point())) break;
      got = SDL_PollEvent(&event) != 0;
    }
    serve(stage, window, dialogue);
    if (std::exchange(on_way, false)) name_window(window, stage.trace());
    SDL_Surface* target = window.surface();
    if (target->w != stage.app().renderer().width() || target->h != stage.app().renderer().height()) {
      stage.app().resize(target->w, target->h);
      stage.app().set_dpi_scale(window.dpi_scale());
      frames_due = App::frames_to_settle;
    }
    if (frames_due <= 0 && stage.app().session().revision() == drawn) continue;
    drawn = stage.app().session().revision();
    stage.app().frame();
    window.show(stage.app().renderer().picture());
    if (--frames_due <= 0 && stage.app().moving()) frames_due = 1;
  }
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
  go_to_start(app, trace, options);
  return describe(app);
}

int run_viewer(const Trace& trace, const ViewerOptions& options) {
  if (options.screenshot) return write_screenshot(trace, options);
  Settings settings = load_settings(settings_path());
  const Settings stored = settings;
  settings.dark = options.dark.value_or(settings.dark);
  settings.presenter = settings.presenter || options.presenter;
  const Settings begun = settings;
  const WindowSize size = opening_size(settings, options.size);
  const Window window(size.width, size.height);
  Stage stage(trace, options, settings, window.surface()->w, window.surface()->h, window.dpi_scale());
  name_window(window, trace);
  go_to_start(stage.app(), trace, options);
  if (options.race) stage.app().open_race(options.race);
  if (options.at_start) stage.app().open_start();
  Keeper keeper(stored, begun);
  loop(stage, window, keeper);
  keeper.save(stage, window, true);
  return 0;
}

}  // namespace zstep
