// The window around the App: opens it, feeds it events, shows its surface, keeps what stays.
#include "sim/viewer/viewer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "sim/image/png.hpp"
#include "sim/viewer/app.hpp"
#include "traces/error.hpp"

namespace zstep {
namespace {

using namespace viewer;

/// What a trace is called in the settings: its name, its length and its scene, so that another run is another place.
std::string place_key(const Trace& trace) { return fmt::format("{}|{}|{}", trace.name(), trace.size(), trace.scene().points.size()); }

void go_to_start(App& app, const Trace& trace, const ViewerOptions& options, bool remembered) {
  Session& s = app.session();
  if (options.at >= 0) return s.go_to(options.at);
  if (remembered)
    if (const auto place = app.settings().place(place_key(trace))) return s.go_to(*place);
  if (options.lesson && !options.lesson->stops.empty()) s.to_stop(0);
}

int write_screenshot(const Trace& trace, const ViewerOptions& options) {
  Settings settings;  // never the reader's own: the same command gives the same picture everywhere
  settings.dark = options.dark;
  settings.presenter = options.presenter;
  App app(trace, options.lesson, settings, options.width, options.height);
  go_to_start(app, trace, options, false);
  app.settle();
  write_png(*options.screenshot, options.width, options.height, app.renderer().rgb());
  return 0;
}

/// Pixels per pixel of a common screen. What the system says of the screen's size in millimetres is often wrong, so only a
/// clear case counts: a window whose surface has more pixels than points, or a screen that claims 140 dots an inch or more.
float dpi_scale(SDL_Window* window, float pixels_per_point) {
  if (pixels_per_point > 1.01f) return pixels_per_point;
  float dots = 96;
  if (SDL_GetDisplayDPI(std::max(0, SDL_GetWindowDisplayIndex(window)), &dots, nullptr, nullptr) != 0 || dots < 140 || dots > 400) return 1;
  return std::round(dots / 96 * 4) / 4;
}

struct WindowDeleter {
  void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }
};

class Window {
 public:
  explicit Window(const Settings& settings, const ViewerOptions& options) {
    SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");  // plain copies are 5 ms a frame faster on X11
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) throw std::runtime_error(fmt::format("viewer: no window can be opened: {}", SDL_GetError()));
    SDL_Rect usable{0, 0, options.width, options.height};
    SDL_GetDisplayUsableBounds(0, &usable);
    const int width = std::min(settings.width > 0 ? settings.width : options.width, std::max(320, usable.w));
    const int height = std::min(settings.height > 0 ? settings.height : options.height, std::max(200, usable.h));
    window_.reset(SDL_CreateWindow("zstep", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height,
                                   SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI));
    if (!window_) throw std::runtime_error(fmt::format("viewer: no window can be opened: {}", SDL_GetError()));
    SDL_StartTextInput();
  }
  ~Window() {
    window_.reset();
    SDL_Quit();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  SDL_Window* get() const { return window_.get(); }
  SDL_Surface* surface() const {
    SDL_Surface* surface = SDL_GetWindowSurface(window_.get());
    if (!surface) throw std::runtime_error(fmt::format("viewer: the window has no surface: {}", SDL_GetError()));
    return surface;
  }
  float pixels_per_point() const {
    int width = 1, height = 1;
    SDL_GetWindowSize(window_.get(), &width, &height);
    return static_cast<float>(surface()->w) / static_cast<float>(std::max(1, width));
  }
  void show(const Canvas& picture) const {
    SDL_Surface* target = surface();
    SDL_ConvertPixels(std::min(picture.width(), target->w), std::min(picture.height(), target->h), SDL_PIXELFORMAT_ARGB8888, picture.row(0),
                      picture.width() * 4, target->format->format, target->pixels, target->pitch);
    SDL_UpdateWindowSurface(window_.get());
  }

 private:
  std::unique_ptr<SDL_Window, WindowDeleter> window_;
};

void serve(App& app, const Window& window) {
  WindowRequests& r = app.requests;
  if (r.toggle_full_screen) {
    const bool full = SDL_GetWindowFlags(window.get()) & SDL_WINDOW_FULLSCREEN_DESKTOP;
    SDL_SetWindowFullscreen(window.get(), full ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
  }
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

double seconds() { return static_cast<double>(SDL_GetPerformanceCounter()) / static_cast<double>(SDL_GetPerformanceFrequency()); }

void loop(App& app, const Window& window) {
  int frames_due = 4;  // after a change, until nothing moves any more
  std::uint64_t drawn = 0;
  while (!app.requests.quit) {
    const double wait = app.session().play(seconds());
    if (app.session().revision() != drawn) frames_due = std::max(frames_due, 3);
    SDL_Event event;
    const int milliseconds = frames_due > 0 ? 0 : static_cast<int>(std::min(wait, 3600.0) * 1000);
    bool got = milliseconds > 0 ? SDL_WaitEventTimeout(&event, milliseconds) != 0 : SDL_PollEvent(&event) != 0;
    while (got) {
      frames_due = std::max(frames_due, 3);
      if (app.handle(event, window.pixels_per_point())) break;
      got = SDL_PollEvent(&event) != 0;
    }
    serve(app, window);
    SDL_Surface* target = window.surface();
    if (target->w != app.renderer().width() || target->h != app.renderer().height()) {
      app.resize(target->w, target->h);
      app.set_dpi_scale(dpi_scale(window.get(), window.pixels_per_point()));
      frames_due = 4;
    }
    if (frames_due <= 0 && app.session().revision() == drawn) continue;
    drawn = app.session().revision();
    app.frame();
    window.show(app.renderer().picture());
    --frames_due;
  }
}

}  // namespace

bool display_available() {
#if defined(__linux__) || defined(__FreeBSD__)
  const auto set = [](const char* name) { return std::getenv(name) && *std::getenv(name); };
  if (!set("DISPLAY") && !set("WAYLAND_DISPLAY")) return false;
#endif
  if (SDL_WasInit(SDL_INIT_VIDEO)) return true;
  const bool opened = SDL_Init(SDL_INIT_VIDEO) == 0;
  if (opened) SDL_QuitSubSystem(SDL_INIT_VIDEO);
  return opened;
}

int run_viewer(const Trace& trace, const ViewerOptions& options) {
  if (options.screenshot) return write_screenshot(trace, options);
  const std::filesystem::path path = settings_path();
  Settings settings = load_settings(path);
  if (options.dark) settings.dark = true;
  if (options.presenter) settings.presenter = true;
  const Window window(settings, options);
  const float points = window.pixels_per_point();
  App app(trace, options.lesson, settings, window.surface()->w, window.surface()->h, dpi_scale(window.get(), points));
  SDL_SetWindowTitle(window.get(), fmt::format("zstep \u00b7 {} \u00b7 {}", trace.header().title, trace.scene().name).c_str());
  go_to_start(app, trace, options, true);
  loop(app, window);

  // Closing keeps layout and place.
  Settings& kept = app.settings();
  if (!(SDL_GetWindowFlags(window.get()) & SDL_WINDOW_FULLSCREEN_DESKTOP)) SDL_GetWindowSize(window.get(), &kept.width, &kept.height);
  kept.speed = app.session().speed;
  kept.remember(place_key(trace), app.session().position());
  if (!path.empty() && !save_settings(path, kept)) fmt::print(stderr, "zstep: the viewer's settings could not be saved to {}\n", path.string());
  return 0;
}

}  // namespace zstep
