// What a lecturer does over the window: pen, spotlight, clock.
#include <doctest/doctest.h>

#include "sim/viewer/app.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

void drag(App& app, int x, int y, int to_x, int to_y) {
  SDL_Event button{};
  button.type = SDL_MOUSEBUTTONDOWN;
  button.button.button = SDL_BUTTON_LEFT;
  button.button.x = x, button.button.y = y;
  test::send(app, button);
  app.frame();
  for (int k = 1; k <= 4; ++k) {
    test::move_mouse(app, x + (to_x - x) * k / 4, y + (to_y - y) * k / 4);
  }
  button.type = SDL_MOUSEBUTTONUP;
  button.button.x = to_x, button.button.y = to_y;
  test::send(app, button);
  app.frame();
}

}  // namespace

TEST_CASE("board: the pen writes over the panes, which do not take the drag, a step wipes it, and leaves what stays") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size() / 2);
  test::move_mouse(app, 5, 5);
  const test::Bytes before = test::picture(app);
  test::press(app, SDLK_8);
  REQUIRE(app.board().writes());
  app.settle();
  drag(app, 500, 200, 700, 300);
  CHECK(app.board().strokes() == 1);
  CHECK(!app.session().selected);  // the framebuffer under it took no click
  test::move_mouse(app, 5, 5);
  CHECK(test::picture(app) != before);
  test::press(app, SDLK_RIGHT);
  app.settle();
  CHECK(app.board().strokes() == 0);
  test::press(app, SDLK_LEFT);
  CHECK(test::picture(app) == before);

  test::press(app, SDLK_8, KMOD_LSHIFT);
  app.settle();
  drag(app, 500, 200, 700, 300);
  drag(app, 700, 200, 500, 300);
  test::press(app, SDLK_RIGHT);
  app.settle();
  CHECK(app.board().strokes() == 2);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.board().strokes() == 0);
  CHECK_FALSE(app.board().writes());
}

TEST_CASE("board: the spotlight leaves what the mouse points at as it is, and darkens the rest") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, {}, 1280, 720);
  test::move_mouse(app, 640, 300);
  test::press(app, SDLK_9);
  test::press(app, SDLK_9);  // keys are at work: nothing pops up at the mouse
  const test::Bytes plain = test::picture(app);
  test::press(app, SDLK_9);
  const test::Bytes lit = test::picture(app);
  const auto at = [](const test::Bytes& bytes, std::size_t x, std::size_t y) { return bytes[3 * (y * 1280 + x)]; };
  CHECK(at(lit, 650, 310) == at(plain, 650, 310));
  CHECK(at(lit, 200, 100) < at(plain, 200, 100));
  CHECK(at(lit, 640, 700) < at(plain, 640, 700));
  test::press(app, SDLK_9);
  CHECK(test::picture(app) == plain);
}

TEST_CASE("board: the clock counts from when it is started") {
  Board board;
  CHECK_FALSE(board.clock_runs());
  board.turn_clock(100);
  CHECK(board.clock(100) == "0:00");
  CHECK(board.clock(159.9) == "0:59");
  CHECK(board.clock(100 + 20 * 60 + 5) == "20:05");
  CHECK(board.clock(100 + 3 * 3600 + 60) == "3:01:00");
  board.turn_clock(200);
  CHECK_FALSE(board.clock_runs());
}
