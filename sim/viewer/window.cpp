
#include "sim/viewer/window.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/viewer.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

bool tells_less(const TitleName& one, const TitleName& other) { return one.tells < other.tells; }

}  // namespace

std::string joined_names(const std::vector<TitleName>& names) {
  std::string text;
  for (const TitleName& name : names) text += (&name == &names.front() ? "" : " \u00b7 ") + name.text + name.sign();
  return text;
}

std::vector<TitleName> most_telling(std::vector<TitleName> names) {
  if (names.empty()) return names;
  const int most = std::max_element(names.begin(), names.end(), tells_less)->tells;
  std::erase_if(names, [&](const TitleName& name) { return name.tells < most; });
  return names;
}

std::vector<TitleName> names_that_fit(std::vector<TitleName> names, float room, const TitleMeasures& measures) {
  const auto too_wide = [&] { return measures.width(joined_names(names)) > room; };
  const std::size_t kept = most_telling(names).size();
  while (names.size() > kept && too_wide()) names.erase(std::min_element(names.begin(), names.end(), tells_less));
  if (!too_wide()) return names;
  // The room that signs leave, shared: a short name leaves what it does not need to the others.
  std::vector<TitleName> signs = names;
  for (TitleName& name : signs) name.text.clear();
  float left = room - measures.width(joined_names(signs));
  std::vector<TitleName*> shortest_first;
  for (TitleName& name : names) shortest_first.push_back(&name);
  std::stable_sort(shortest_first.begin(), shortest_first.end(), [&](const TitleName* one, const TitleName* other) {
    return measures.width(one->text) < measures.width(other->text);
  });
  for (std::size_t k = 0; k < shortest_first.size(); ++k) {
    const float share = left / to_float(shortest_first.size() - k);
    if (share < measures.least) return {};
    TitleName& name = *shortest_first[k];
    if (measures.width(name.text) > share) name.text = measures.cut(name.text, share);
    left -= measures.width(name.text);
  }
  return names;
}

}  // namespace zstep::viewer

namespace zstep {
namespace viewer {
namespace {

[[noreturn]] void throw_no_window(const std::string& why) {
  throw InputError("viewer", "no window can be opened: " + why, "--screenshot FILE.png and --describe need none");
}

}  // namespace

Window::Window(int width, int height) {
  SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");  // plain copies are 5 ms a frame faster on X11
  SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
  // SDL would tell of each touch twice, the second time as of a mouse.
  SDL_SetHint(SDL_HINT_TOUCH_MOUSE_EVENTS, "0");
  SDL_SetHint(SDL_HINT_MOUSE_TOUCH_EVENTS, "0");
  if (SDL_Init(SDL_INIT_VIDEO) != 0) throw_no_window(SDL_GetError());
  SDL_Rect usable{0, 0, width, height};
  SDL_GetDisplayUsableBounds(0, &usable);
  window_.reset(SDL_CreateWindow("zstep", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                 std::min(width, std::max(320, usable.w)), std::min(height, std::max(200, usable.h)),
                                 SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI));
  if (!window_) {
    const std::string why = SDL_GetError();
    SDL_Quit();
    throw_no_window(why);
  }
  SDL_StartTextInput();
}

Window::Window(const Window& first, const char* title, int width, int height) : second_(true) {
  const int screen = std::max(0, SDL_GetWindowDisplayIndex(first.get())),
            other = screen == 0 && SDL_GetNumVideoDisplays() > 1 ? 1 : 0;
  SDL_Rect usable{0, 0, width, height};
  SDL_GetDisplayUsableBounds(other, &usable);
  const int place = static_cast<int>(SDL_WINDOWPOS_CENTERED_DISPLAY(other));
  constexpr std::uint32_t flags = SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
  if (other == screen) {  // on the one screen there is, it would lie behind the first, or hide all of it
    const SDL_Rect at = place_beside(usable, width, height);
    window_.reset(SDL_CreateWindow(title, at.x, at.y, at.w, at.h, flags | SDL_WINDOW_ALWAYS_ON_TOP));
  } else {
    window_.reset(SDL_CreateWindow(title, place, place, std::min(width, std::max(320, usable.w)),
                                   std::min(height, std::max(200, usable.h)), flags));
  }
  if (!window_) throw std::runtime_error(fmt::format("viewer: no second window can be opened: {}", SDL_GetError()));
  SDL_RaiseWindow(first.get());
}

SDL_Rect place_beside(const SDL_Rect& usable, int width, int height) {
  SDL_Rect at{0, 0, std::min(width, std::max(320, usable.w / 2)), std::min(height, std::max(200, usable.h / 2))};
  at.x = usable.x + std::max(0, usable.w - at.w);
  at.y = usable.y + std::max(0, usable.h - at.h);
  return at;
}

Window::~Window() {
  window_.reset();
  if (!second_) SDL_Quit();
}

SDL_Surface* Window::surface() const {
  SDL_Surface* surface = SDL_GetWindowSurface(window_.get());
  if (!surface) throw std::runtime_error(fmt::format("viewer: the window has no surface: {}", SDL_GetError()));
  return surface;
}

float Window::pixels_per_point() const {
  int width = 1, height = 1;
  SDL_GetWindowSize(window_.get(), &width, &height);
  return to_float(surface()->w) / to_float(std::max(1, width));
}

/// What the system says of the screen's size in millimetres is often wrong, so only a clear case counts: a window whose
/// surface has more pixels than points, or a screen that claims 140 dots an inch or more.
float Window::dpi_scale() const {
  if (const float points = pixels_per_point(); points > 1.01f) return points;
  float dots = 96;
  if (SDL_GetDisplayDPI(std::max(0, SDL_GetWindowDisplayIndex(window_.get())), &dots, nullptr, nullptr) != 0 ||
      dots < 140 || dots > 400)
    return 1;
  return std::round(dots / 96 * 4) / 4;
}

void Window::show(const Canvas& picture) const {
  SDL_Surface* target = surface();
  SDL_ConvertPixels(std::min(picture.width(), target->w), std::min(picture.height(), target->h),
                    SDL_PIXELFORMAT_ARGB8888, picture.row(0), picture.width() * 4, target->format->format,
                    target->pixels, target->pitch);
  SDL_UpdateWindowSurface(window_.get());
}

void Window::show_progress(double share) const {
  SDL_Surface* target = surface();
  const int height = std::max(6, target->h / 100);
  const SDL_Rect all{0, 0, target->w, height}, done{0, 0, static_cast<int>(share * target->w), height};
  SDL_FillRect(target, &all, SDL_MapRGB(target->format, 255, 255, 255));
  SDL_FillRect(target, &done, SDL_MapRGB(target->format, 0xc2, 0x4b, 0x00));
  SDL_UpdateWindowSurface(window_.get());
}

bool Window::is_ended() {
  SDL_PumpEvents();
  if (SDL_HasEvent(SDL_QUIT) == SDL_TRUE) return true;
  const auto of_keys = [](SDL_Event* events, int count, SDL_eventaction action) {
    return SDL_PeepEvents(events, count, action, SDL_KEYDOWN, SDL_TEXTINPUT);
  };
  std::vector<SDL_Event> kept;
  bool held = false;
  for (SDL_Event event; of_keys(&event, 1, SDL_GETEVENT) == 1;) {
    if (event.type == SDL_KEYDOWN) {
      if (event.key.keysym.sym == SDLK_ESCAPE) return true;
      held = event.key.repeat != 0;
    }
    if (!held || event.type == SDL_KEYUP) kept.push_back(event);
  }
  of_keys(kept.data(), size32(kept), SDL_ADDEVENT);
  return false;
}

}  // namespace viewer

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

}  // namespace zstep
