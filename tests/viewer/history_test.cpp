// The history of a pixel in the viewer: opened by a key, walked through with arrows, each line a jump.
#include <doctest/doctest.h>

#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("H tells all that happened to the selected pixel, and goes to each of it") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_h);
  CHECK(app.overlay() == Overlay::none);  // no pixel is selected or at work
  app.session().select(Cell{15, 12});
  const test::Bytes before = test::picture(app);
  test::press(app, SDLK_h);
  REQUIRE(app.overlay() == Overlay::history);
  REQUIRE(app.history().size() == 4);
  CHECK(test::picture(app) != before);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() == app.history()[2].step);
  CHECK(app.overlay() == Overlay::history);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.overlay() == Overlay::none);
  CHECK(app.session().selected == Cell{15, 12});
  // Opened again it begins where the reader stands.
  test::press(app, SDLK_h);
  CHECK(app.picked == 2);
  app.session().select(Cell{0, 0});
  test::press(app, SDLK_ESCAPE);
  app.session().select(Cell{0, 0});
  test::press(app, SDLK_h);
  CHECK(app.overlay() == Overlay::none);
}
