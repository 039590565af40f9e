// "Why not" in the viewer: a key, a polygon typed or picked, each step of the verdict a jump.
#include <doctest/doctest.h>

#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;
using answers::Why;

TEST_CASE("Y asks why a polygon is not seen at the selected pixel, and goes to each step of the answer") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().select(Cell{15, 12});
  const test::Bytes before = test::picture(app);
  test::type(app, "y");  // the key's own letter is not typed
  REQUIRE(app.drawer() == Drawer::why_ask);
  CHECK(app.typed.empty());
  CHECK(app.why_of() == Cell{15, 12});
  CHECK(app.why_candidates().size() == 7);
  CHECK(test::picture(app) != before);
  test::type(app, "f");
  CHECK(app.why_candidates() == std::vector<std::int32_t>{0});
  test::press(app, SDLK_RETURN);
  REQUIRE(app.drawer() == Drawer::why);
  CHECK(app.why().kind == Why::overwritten);
  REQUIRE(app.why().chain.size() == 3);
  CHECK(app.why().chain[static_cast<std::size_t>(app.picked)].step == app.why().step);
  test::press(app, SDLK_UP);
  test::press(app, SDLK_UP);
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() == app.why().chain[0].step);
  CHECK(app.drawer() == Drawer::why);

  // The same of the whole picture, and back.
  test::press(app, SDLK_TAB);
  CHECK_FALSE(app.why_of());
  CHECK(app.why().kind == Why::seen);
  CHECK(app.why().sentence.find("F is seen at ") == 0);
  test::press(app, SDLK_TAB);
  CHECK(app.why().kind == Why::overwritten);

  // Another polygon, by number: 2 is B.
  test::press(app, SDLK_BACKSPACE);
  REQUIRE(app.drawer() == Drawer::why_ask);
  test::type(app, "2");
  test::press(app, SDLK_RETURN);
  CHECK(app.why_polygon() == 2);
  CHECK(app.why().kind == Why::culled);
  test::type(app, "zzz");  // there is no field here
  CHECK(app.typed.empty());
  test::press(app, SDLK_ESCAPE);
  CHECK(app.drawer() == Drawer::none);

  test::press(app, SDLK_y);
  test::type(app, "none of them");
  CHECK(app.why_candidates().empty());
  test::press(app, SDLK_RETURN);
  CHECK(app.drawer() == Drawer::why_ask);
}

TEST_CASE("Y in a pixel's history asks about the polygon picked there, without a pixel it asks of the whole picture") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_y);
  CHECK_FALSE(app.why_of());
  test::press(app, SDLK_TAB);
  CHECK(app.drawer() == Drawer::why_ask);
  CHECK_FALSE(app.session().message.empty());
  test::press(app, SDLK_ESCAPE);

  app.session().select(Cell{15, 12});
  test::press(app, SDLK_h);
  REQUIRE(app.history().size() == 4);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_y);
  REQUIRE(app.drawer() == Drawer::why);
  CHECK(app.why_polygon() == app.history()[3].polygon);
  CHECK(app.why().kind == Why::lost);
}

TEST_CASE(
    "the pixel at which a polygon comes nearest to being seen is marked while that is read, and the reader's own comes "
    "back") {
  const Trace trace = test::record_run("pyramid-behind");
  for (const bool selected : {false, true}) {
    CAPTURE(selected);
    App app(trace, nullptr, {}, 1280, 720);
    if (selected) app.session().select(Cell{3, 4});
    test::press(app, SDLK_y);
    if (selected) test::press(app, SDLK_TAB);  // of the whole picture
    test::type(app, "g");
    test::press(app, SDLK_RETURN);
    REQUIRE(app.drawer() == Drawer::why);
    REQUIRE_FALSE(app.why_of());
    REQUIRE(app.why().pixel);
    CHECK(app.session().selected == Cell{app.why().pixel->x, app.why().pixel->y});
    test::press(app, SDLK_ESCAPE);
    CHECK(app.session().selected == (selected ? std::optional(Cell{3, 4}) : std::nullopt));
  }
}

TEST_CASE("a step decides that compares or writes, not one at which work on a polygon begins") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().select(Cell{15, 12});
  bool decided = false, begun = false;
  for (std::int32_t polygon = 0; polygon < 7; ++polygon)
    for (const Cell cell : {Cell{15, 12}, Cell{2, 2}}) {
      app.session().select(cell);
      app.open_why();
      app.ask_why(polygon);
      const std::int64_t step = app.why().step;
      const bool begins = step > 0 && holds<PolygonBegin>(trace.event(step).event);
      CAPTURE(polygon);
      CHECK(app.why_decides() == (step > 0 && !begins));
      (begins ? begun : decided) = true;
      app.settle();
      app.open(Drawer::none);
    }
  CHECK(decided);
  CHECK(begun);
}

TEST_CASE("clicks pick a polygon and a step") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().select(Cell{15, 12});
  test::press(app, SDLK_y);
  test::picture(app);
  // Rows of the list, from its top, in the right half of the drawer.
  test::click(app, 740, 500);
  REQUIRE(app.drawer() == Drawer::why);
  const std::int64_t at = app.session().position();
  test::picture(app);
  for (int y = 615; y > 490 && app.session().position() == at; y -= 12) test::click(app, 740, y);
  CHECK(app.session().position() != at);
  CHECK(app.drawer() == Drawer::why);
  test::click(app, 300, 20);  // beside it: it stays
  CHECK(app.drawer() == Drawer::why);
}
