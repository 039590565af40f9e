// The window's loop: what comes at once does what it does one by one.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <unistd.h>

#include "sim/viewer/loop.hpp"
#include "sim/viewer/window.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/made_anew.hpp"

using namespace zstep;
using namespace zstep::viewer;
namespace fs = std::filesystem;

namespace {

struct Pressed {
  SDL_Keycode key;
  std::uint16_t modifiers = KMOD_NONE;
  int repeats = 0;
};

void send_key(const Pressed& pressed) {
  for (int k = -1; k <= pressed.repeats; ++k) {
    SDL_Event event{};
    event.type = k < pressed.repeats ? SDL_KEYDOWN : SDL_KEYUP;
    event.key.repeat = k >= 0;
    event.key.keysym.sym = pressed.key;
    event.key.keysym.mod = pressed.modifiers;
    SDL_PushEvent(&event);
  }
}

void rest(Loop& loop) {
  do loop.turn(Loop::May::go_on);
  while (loop.rests_for() == 0);
}

/// What the window shows after these keys, pressed all at once or each once the window is at rest.
test::Bytes shown_after(const std::vector<Pressed>& keys, bool at_once) {
  const fs::path kept = fs::temp_directory_path() / ("zstep-loop-" + std::to_string(getpid()));
  setenv("XDG_CONFIG_HOME", kept.c_str(), 1);
  const Trace trace = test::record_run("pyramid", test::of_size(32, 32));
  ViewerOptions options;
  options.size = WindowSize{1000, 600};
  options.at = 300;
  options.run_changed = test::made_anew;
  options.other_method = [](const Trace& opened, int) -> std::optional<OtherRun> {
    return test::made_anew(opened, "bsp", {});
  };
  test::Bytes shown;
  {
    Loop loop(trace, options);
    rest(loop);
    for (const Pressed& key : keys) {
      send_key(key);
      if (!at_once) rest(loop);
    }
    rest(loop);
    SDL_Window* window = nullptr;
    for (Uint32 id = 1; id < 1000 && !window; ++id) window = SDL_GetWindowFromID(id);
    REQUIRE(window);
    const SDL_Surface* surface = SDL_GetWindowSurface(window);
    const auto* bytes = static_cast<const std::uint8_t*>(surface->pixels);
    shown.assign(bytes, bytes + surface->h * surface->pitch);
  }
  unsetenv("XDG_CONFIG_HOME");
  fs::remove_all(kept);
  return shown;
}

}  // namespace

TEST_CASE("keys that come at once do what they do one by one") {
  const std::vector<std::pair<std::string, std::vector<Pressed>>> ways{
      {"steps", {{SDLK_RIGHT}, {SDLK_RIGHT}, {SDLK_LEFT}}},
      {"a check, then a step", {{SDLK_k, KMOD_LCTRL}, {SDLK_RIGHT}}},
      {"a check, what it says read, then the history", {{SDLK_k, KMOD_LCTRL}, {SDLK_h}}},
      {"another method, then two steps there", {{SDLK_x}, {SDLK_RIGHT}, {SDLK_RIGHT}}},
      {"another method and back", {{SDLK_x}, {SDLK_x}}},
      {"compared with zstep's own, then a step", {{SDLK_d, KMOD_LCTRL}, {SDLK_RETURN}, {SDLK_RIGHT}}},
  };
  const test::Bytes untouched = shown_after({}, true);
  for (const auto& [what, keys] : ways) {
    CAPTURE(what);
    const test::Bytes one_by_one = shown_after(keys, false);
    CHECK(one_by_one != untouched);
    CHECK((shown_after(keys, true) == one_by_one));
  }
}

TEST_CASE("keys that are pressed while something long is done wait for it, each once, and Esc ends it") {
  REQUIRE(SDL_Init(SDL_INIT_VIDEO) == 0);
  SDL_FlushEvents(SDL_KEYDOWN, SDL_TEXTINPUT);
  CHECK(!Window::is_ended());
  send_key({SDLK_RIGHT, KMOD_NONE, 40});
  send_key({SDLK_h});
  CHECK(!Window::is_ended());
  CHECK(!Window::is_ended());
  std::vector<SDL_Keycode> down;
  int up = 0;
  for (SDL_Event event; SDL_PollEvent(&event) != 0;) {
    if (event.type == SDL_KEYDOWN) down.push_back(event.key.keysym.sym);
    up += event.type == SDL_KEYUP;
  }
  CHECK(down == std::vector<SDL_Keycode>{SDLK_RIGHT, SDLK_h});
  CHECK(up == 2);
  send_key({SDLK_RIGHT});
  send_key({SDLK_ESCAPE});
  CHECK(Window::is_ended());
  CHECK(!Window::is_ended());
  CHECK(SDL_HasEvent(SDL_KEYDOWN) == SDL_FALSE);
  SDL_FlushEvents(SDL_KEYDOWN, SDL_TEXTINPUT);
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
}
