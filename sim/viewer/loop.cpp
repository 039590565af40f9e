#include "sim/viewer/loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "traces/image/file.hpp"
#include "traces/image/png.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/description.hpp"
#include "sim/viewer/settings.hpp"
#include "traces/error.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

void name_window(const Window& window, const Trace& trace) {
  SDL_SetWindowTitle(window.get(),
                     fmt::format("zstep \u00b7 {} \u00b7 {}", trace.header().title, trace.scene().name).c_str());
}

double seconds() { return ratio(SDL_GetPerformanceCounter(), SDL_GetPerformanceFrequency()); }

Settings with_options(Settings settings, const ViewerOptions& options) {
  settings.dark = options.dark.value_or(settings.dark);
  settings.presenter = settings.presenter || options.presenter;
  settings.embedded = options.embed;
  return settings;
}

WindowSize size_of(const Settings& settings, const ViewerOptions& options) {
  return opening_size(settings, options.size);
}

}  // namespace

Loop::Loop(const Trace& trace, ViewerOptions options)
    : options_(std::move(options)),
      stored_(load_settings(settings_path())),
      begun_(with_options(stored_, options_)),
      saved_(stored_),
      window_(size_of(begun_, options_).width, size_of(begun_, options_).height),
      stage_(trace, options_, begun_, window_.surface()->w, window_.surface()->h, window_.dpi_scale()) {
  name_window(window_, trace);
  go_to_start(stage_.app(), options_);
  if (options_.race) stage_.app().open_race(options_.race);
  if (options_.at_start) stage_.app().open_start();
  if (options_.notes) notes_.toggle(stage_.app());
  if (system::is_heard()) system::offer_commands(commands_as_list());
}

Loop::~Loop() { save(true); }

namespace {

/// As PNG and as SVG; `shown`, where it is given, are the pixels. What is drawn of it is said, or why it is not there.
void save_drawing(App& app, const std::string& name, Drawing (App::*draw)(), std::vector<std::uint8_t> shown = {}) {
  try {
    Drawing drawing = (app.*draw)();
    if (!shown.empty()) drawing.rgb = std::move(shown);
    write_png(name + ".png", drawing.width, drawing.height, drawing.rgb);
    write_file(name + ".svg", {reinterpret_cast<const std::uint8_t*>(drawing.svg.data()), drawing.svg.size()});
    system::hand_over(name + ".png");
    app.say(fmt::format("Saved {0}.png and {0}.svg {1}.", name, system::hand_over(name + ".svg")));
  } catch (const InputError& error) {
    app.say(error.what());
  }
}

}  // namespace

void Loop::serve() {
  if (stage_.serve()) name_window(window_, stage_.trace());
  App& app = stage_.app();
  WindowRequests& r = app.requests;
  if (r.toggle_full_screen)
    SDL_SetWindowFullscreen(window_.get(), window_.full_screen() ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
  if (r.choose_file)
    if (const std::string wrong = system::ask_for_file(); !wrong.empty()) app.say_on_start(wrong);
  if (r.leave_page && !system::open_beside(app.link_of_whole())) app.end_embedding();
  if (r.toggle_notes) notes_.toggle(app);
  if (r.clipboard) system::copy_text(*r.clipboard);
  if (r.marks_kept) system::kept(places::kept_folder());
  if (r.save_progress) save_progress();
  if (r.save_picture) save_drawing(app, *r.save_picture, &App::of_window, app.renderer().rgb());
  if (r.save_slide) save_drawing(app, *r.save_slide, &App::slide);
  const bool quit = r.quit;
  r = {};
  r.quit = quit;
}

void Loop::save(bool at_end) {
  App& app = stage_.app();
  // What options set for this run alone is left out.
  Settings kept = kept_settings(stored_, begun_, app.settings());
  if (!window_.full_screen()) SDL_GetWindowSize(window_.get(), &kept.width, &kept.height);
  kept.speed = app.session().speed;
  if (!at_end && kept.same_but_for_places(saved_)) return;
  // The trace that was opened keeps its place whatever was looked at besides.
  kept.remember(place_key(stage_.trace()), app.session().position());
  kept.remember(place_key(stage_.first()), stage_.first_app().session().position());
  const std::filesystem::path path = settings_path();
  if (!path.empty()) {
    if (save_settings(path, kept)) system::kept(path.parent_path());
    else if (at_end) fmt::print(stderr, "zstep: the viewer's settings could not be saved to {}\n", path.string());
  }
  saved_ = std::move(kept);
}

void Loop::save_progress() {
  save(true);  // what there is by now
  const std::string text = progress_text(places::kept_folder());
  try {
    write_file(progress_file_name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    stage_.app().say(
        fmt::format("Saved {} {}: settings, progress and bookmarks. Open it in another zstep to take them over.",
                    progress_file_name, system::hand_over(progress_file_name)));
  } catch (const InputError& error) {
    stage_.app().say(error.what());
  }
}

void Loop::tell_place() {
  App& app = stage_.app();
  if (app.overlay() == Overlay::start) return;  // nothing is chosen yet
  // What no link leads to, as a file, is told of, too.
  const std::string link = app.link().value_or(""), place = link.empty() ? app.command_line() : link;
  const bool other = std::exchange(told_seen_, seen_) != seen_;
  if (place == told_) {
    if (std::exchange(told_by_link_, false) || other) say_place();  // of the same step something else may be told
    return;
  }
  const std::int64_t stop = app.session().stop();
  const bool at_stop = stop != told_stop_ && app.session().lesson() != nullptr;
  told_ = place, told_stop_ = stop;
  if (!link.empty()) system::arrived(link, at_stop);
  say_place();
}

void Loop::say_place() {
  if (!system::is_heard()) return;
  system::say(describe_step(stage_.app()));
  system::show_tables(tables_as_list(tables_));
}

void Loop::run(std::string_view id) {
  const Command* const command = command_called(id);
  if (!command) return;
  App& app = stage_.app();
  app.session().message.clear();
  app.run(*command);
  if (command->release) command->release(app);
  frames_due_ = App::frames_to_settle;
}

void Loop::tell_typing() {
  std::optional<system::TypedLine> line;
  if (const auto at = stage_.app().typed_line()) {
    const auto point = [&](float pixels) { return nearest_int(pixels / window_.pixels_per_point()); };
    line = {point(at->x), point(at->y), point(at->z), point(at->w)};
  }
  if (line != std::exchange(told_line_, line)) system::typing_at(line);
}

bool Loop::go_to_link(const std::string& link) {
  try {
    if (!stage_.app().go_to_link(link)) return false;
  } catch (const InputError&) {
    return false;
  }
  // It is the page that is there already.
  told_ = stage_.app().link().value_or(""), told_stop_ = stage_.app().session().stop();
  told_by_link_ = true;
  frames_due_ = App::frames_to_settle;
  return true;
}

bool Loop::turn(May may) {
  if (stage_.app().requests.quit) return false;
  stage_.app().ends_waiting = &Window::is_ended;
  stage_.app().session().on_way = [&, begun = seconds()](double share) mutable {
    if (share == 0) begun = seconds();
    if (seconds() - begun < 0.25) return false;
    if (!std::exchange(on_way_, true))
      SDL_SetWindowTitle(window_.get(),
                         fmt::format("{} \u00b7 on the way, Esc ends it", SDL_GetWindowTitle(window_.get())).c_str());
    window_.show_progress(share);
    return Window::is_ended();
  };
  const auto due = [&](bool when) {
    if (when) frames_due_ = std::max(frames_due_, App::frames_to_settle);
  };
  due(std::exchange(drawn_app_, &stage_.app()) != &stage_.app());  // another run's
  const double time = seconds();
  double wait = std::min({stage_.app().play(time), stage_.app().until_clock(), notes_.until_due()});
  if (stage_.app().waits_for_run) wait = std::min(wait, 0.1);
  wait = std::min(wait, stage_.app().wait_for_finger(SDL_GetTicks()));
  rests_for_ = wait;
  due(std::floor(time) != std::floor(std::exchange(stage_.app().clock_time, time)) &&
      stage_.app().board().clock_runs());
  due(std::exchange(moment_, stage_.app().moment()) != moment_);
  stage_.app().moves = true;
  if (frames_due_ <= 0) save(false), tell_place();  // nothing moves, and no hand pulls a border
  SDL_Event event;
  const int milliseconds = frames_due_ > 0 || may == May::go_on ? 0 : static_cast<int>(std::min(wait, 3600.0) * 1000);
  bool got = milliseconds > 0 ? SDL_WaitEventTimeout(&event, milliseconds) != 0 : SDL_PollEvent(&event) != 0;
  while (got) {
    if (!notes_.takes(event, stage_.app())) {
      due(true);
      if (stage_.app().handle(event, window_.pixels_per_point()) || stage_.app().requests.may_show_other()) break;
    }
    got = SDL_PollEvent(&event) != 0;
  }
  serve();
  notes_.follow(stage_.app());
  if (std::exchange(on_way_, false)) name_window(window_, stage_.trace());
  SDL_Surface* target = window_.surface();
  if (target->w != stage_.app().renderer().width() || target->h != stage_.app().renderer().height()) {
    stage_.app().resize(target->w, target->h);
    stage_.app().set_dpi_scale(window_.dpi_scale());
    frames_due_ = App::frames_to_settle;
  }
  due(std::exchange(moment_, stage_.app().moment()) != moment_);
  if (frames_due_ <= 0) return true;
  tables_.clear();
  if (system::is_heard()) stage_.app().ui().tables_seen = &tables_;
  stage_.app().frame();
  stage_.app().ui().tables_seen = nullptr;
  window_.show(stage_.app().renderer().picture());
  tell_typing();
  --frames_due_;
  if (const std::uint64_t seen = stage_.app().renderer().fingerprint(); std::exchange(seen_, seen) != seen)
    frames_due_ = std::max(frames_due_, App::frames_to_settle - 1);
  if (stage_.app().works()) frames_due_ = std::max(frames_due_, 1);
  return true;
}

}  // namespace zstep::viewer
