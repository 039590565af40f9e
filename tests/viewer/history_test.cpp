// The history of a pixel in the viewer: opened by a key, walked through with arrows, each line a jump.
#include <doctest/doctest.h>

#include "sim/viewer/lists.hpp"
#include "sim/words/numbers.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("H tells all that happened to the selected pixel, and goes to each of it") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_h);
  CHECK(app.drawer() == Drawer::none);  // no pixel is selected or at work
  app.session().select(Cell{15, 12});
  const test::Bytes before = test::picture(app);
  test::press(app, SDLK_h);
  REQUIRE(app.drawer() == Drawer::history);
  REQUIRE(app.history().size() == 4);
  CHECK(test::picture(app) != before);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() == app.history()[2].step);
  CHECK(app.drawer() == Drawer::history);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.drawer() == Drawer::none);
  CHECK(app.session().selected == Cell{15, 12});
  // Opened again it begins where the reader stands.
  test::press(app, SDLK_h);
  CHECK(app.picked == 2);
  app.session().select(Cell{0, 0});
  test::press(app, SDLK_ESCAPE);
  app.session().select(Cell{0, 0});
  test::press(app, SDLK_h);
  CHECK(app.drawer() == Drawer::none);
}

TEST_CASE("a column of steps has room for its longest number, and depths have the signs of the rest of the viewer") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.settle();
  const Ui& ui = app.ui();
  for (const std::int64_t step :
       {std::int64_t{7}, std::int64_t{12'041}, std::int64_t{123'456'789}, std::int64_t{123'456'789'012}}) {
    // The number begins half an em from the left; what follows keeps a distance.
    const float end = ui.em * 0.5f + text_size(ui, ui.fonts.mono, grouped(step)).x;
    CAPTURE(step);
    CHECK(step_column(ui, step) >= end + ui.em * 0.5f);
  }
  CHECK(step_column(ui, 7) == ui.em * 6);
  CHECK(depth_in_list(0.5) == "0.5");
  CHECK(depth_in_list(-0.226123) == "\u22120.226123");
  CHECK(depth_in_list(-1e-7) == "\u22121e\u221207");
  CHECK(depth_in_list(no_depth) == "\u221e");
}

TEST_CASE("a finished picture proposes a first question: a click on a pixel tells its history, until the next move") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().to_finished_picture();
  CHECK(app.session().position() == trace.size());
  CHECK(app.session().message.find("Click a pixel") != std::string::npos);
  app.settle();
  test::click(app, 592, 208);
  CHECK(app.drawer() == Drawer::history);
  REQUIRE(app.session().selected);
  CHECK(app.history_of() == *app.session().selected);
  test::press(app, SDLK_ESCAPE);
  test::press(app, SDLK_LEFT);
  CHECK_FALSE(app.session().proposes_why());
  test::press(app, SDLK_END);
  app.session().select(std::nullopt);
  app.settle();
  test::click(app, 592, 208);
  CHECK(app.session().selected);
  CHECK(app.drawer() == Drawer::none);
}
