// A real window shows the bytes of the headless picture. Run by ctest under Xvfb where that is installed; skipped, and
// saying so, where there is no display.
#include <cstdlib>

#include <doctest/doctest.h>

#include "tests/viewer/drive.hpp"
#include "sim/viewer/window.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// What the window's surface holds, as RGB.
test::Bytes shown(const Window& window) {
  SDL_Surface* surface = window.surface();
  Canvas read;
  read.resize(surface->w, surface->h);
  SDL_ConvertPixels(surface->w, surface->h, surface->format->format, surface->pixels, surface->pitch,
                    SDL_PIXELFORMAT_ARGB8888, read.row(0), surface->w * 4);
  test::Bytes rgb;
  for (int y = 0; y < read.height(); ++y)
    for (int x = 0; x < read.width(); ++x)
      for (const int shift : {16, 8, 0}) rgb.push_back(static_cast<std::uint8_t>(read.row(y)[x] >> shift));
  return rgb;
}

}  // namespace

TEST_CASE("a window shows the bytes of the headless picture") {
  const char* driver = std::getenv("SDL_VIDEODRIVER");
  const bool dummy = driver && std::string(driver) == "dummy";
  if (!dummy && !display_available()) {
    MESSAGE("skipped: there is no display");
    return;
  }
  const Trace trace = test::record_run("pyramid", test::of_size(32, 32));
  Window window(1000, 600);
  const SDL_Surface* surface = window.surface();
  App in_window(trace, nullptr, {}, surface->w, surface->h), headless(trace, nullptr, {}, surface->w, surface->h);
  for (const std::int64_t at : {std::int64_t{0}, trace.size() / 3, trace.size()}) {
    in_window.session().go_to(at);
    headless.session().go_to(at);
    in_window.settle();
    window.show(in_window.renderer().picture());
    const bool same = shown(window) == test::picture(headless);
    CAPTURE(at);
    CHECK(same);
  }
}
