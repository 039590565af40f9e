// Where a number comes from, in the viewer: by key and by click, walked through with arrows, each line a jump.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <variant>

#include "sim/viewer/panes/happened.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// Moves the mouse along a line until it is over a number that can be asked about; false where there is none.
bool find_number(App& app, int x0, int x1, int& x, int y) {
  for (x = x0; x < x1; x += 9) {
    test::move_mouse(app, x, y);
    if (app.ui().mouse_help == "Click: where this number comes from.") return true;
  }
  return false;
}

}  // namespace

TEST_CASE("Shift+E tells where the number of a step comes from, and goes to each step behind it") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_e, KMOD_LSHIFT);
  CHECK(app.drawer() == Drawer::none);  // nothing has happened yet
  app.session().go_to(219);
  const test::Bytes before = test::picture(app);
  test::press(app, SDLK_e, KMOD_LSHIFT);
  REQUIRE(app.drawer() == Drawer::explain);
  CHECK(test::picture(app) != before);
  REQUIRE(app.chain().links.size() == 10);
  CHECK(app.chain().links[0].step == 219);
  for (int i = 0; i < 3; ++i) test::press(app, SDLK_DOWN);
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() == 211);  // the active edge
  CHECK(app.drawer() == Drawer::explain);
  for (int i = 0; i < 20; ++i) test::press(app, SDLK_DOWN);
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() == 211);  // the last is the scene's own
  CHECK(app.session().message.find("scene delhi:") != std::string::npos);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.drawer() == Drawer::none);
}

TEST_CASE("a click on a number of a table or a formula tells where it comes from, beside it the row is lit as ever") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(219);
  app.settle();
  int x = 0;
  int y = 0;
  bool found = false;
  for (y = 470; y < 640 && !found; y += 9) found = find_number(app, 640, 900, x, y);
  REQUIRE(found);
  y -= 9;
  test::click(app, x, y);
  REQUIRE(app.drawer() == Drawer::explain);
  CHECK_FALSE(app.session().selected_edge);
  const std::size_t kind = trace.event(app.chain().links[0].step).event.index();
  CHECK((kind == kind_of<EdgeTableInsert> || kind == kind_of<EdgeStep>));
  test::press(app, SDLK_ESCAPE);
  // Beside its numbers a row is still a row.
  for (int beside = x; beside > 400 && !app.session().selected_edge; beside -= 9) {
    test::move_mouse(app, beside, y);
    if (app.ui().mouse_help == "Click: keep this edge lit in every pane.") test::click(app, beside, y);
  }
  CHECK(app.session().selected_edge);
  CHECK(app.drawer() == Drawer::none);
  // The formula of the step: "z < zbuffer[x,y]".
  found = false;
  for (y = 400; y < 640 && !found; y += 9) found = find_number(app, 30, 40, x, y);
  REQUIRE(found);
  test::click(app, x, y - 9);
  REQUIRE(app.drawer() == Drawer::explain);
  CHECK(app.chain().links[0].step == 219);
}

TEST_CASE(
    "a click on a number within a formula picks the step that it comes from, one in the sentence asks about that "
    "number") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  std::int64_t step = trace.size();  // a depth within a span: of numbers that have steps of their own
  while (!holds<DepthInterpolate>(trace.event(step).event)) --step;
  app.session().go_to(step);
  app.settle();
  std::set<std::int64_t> steps;
  std::set<std::string> fields;
  for (int y = 340; y < 640; y += 9)
    for (int x = 10; x < 380; x += 9) {
      test::move_mouse(app, x, y);
      if (app.ui().mouse_help != "Click: where this number comes from.") continue;
      test::click(app, x, y);
      REQUIRE(app.drawer() == Drawer::explain);
      const auto picked = static_cast<std::size_t>(app.picked);
      REQUIRE(picked < app.chain().links.size());
      if (app.chain().links[0].step == step)
        steps.insert(app.chain().links[picked].step), fields.insert(app.chain().links[0].values[0].name);
      test::press(app, SDLK_ESCAPE);
    }
  CHECK(steps.size() == 2);   // its own, and the one that began the span
  CHECK(fields.size() >= 3);  // x and y of the sentence beside the depth
}

TEST_CASE("a click on the depth of the selected pixel tells where it comes from, on the frame it lets go") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  test::picture(app);
  // Each pane's cell under the mouse: looked for along a row.
  const auto over = [&](int from, int to) {
    for (int x = from; x < to; x += 12) {
      test::move_mouse(app, x, 200);
      if (app.ui().pointed &&
          std::isfinite(
              app.session().picture().depth[app.session().picture().at(app.ui().pointed->x, app.ui().pointed->y)]))
        return x;
    }
    return -1;
  };
  const int depth = over(860, 1270);
  REQUIRE(depth > 0);
  test::click(app, depth, 200);
  const auto selected = app.session().selected;
  REQUIRE(selected);
  CHECK(app.drawer() == Drawer::none);
  test::click(app, depth, 200);
  REQUIRE(app.drawer() == Drawer::explain);
  CHECK(app.session().selected == selected);
  CHECK(app.chain().links[0].values[0].value ==
        app.session().picture().depth[app.session().picture().at(selected->x, selected->y)]);
  test::press(app, SDLK_ESCAPE);
  const int frame = over(380, 800);
  REQUIRE(frame > 0);
  app.session().select(app.ui().pointed);
  test::click(app, frame, 200);
  CHECK_FALSE(app.session().selected);
}

TEST_CASE("pointing at a depth or a number tells what it is without rounding, and leaves the reader where he stands") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(1057);
  app.settle();
  const std::string line = exact_line(app.session(), answers::of_pixel(1057, {15, 12}));
  CHECK(line.starts_with("exactly \u22120.73337362132439592318"));
  CHECK(line.ends_with(" ulp"));
  CHECK(app.session().position() == 1057);
  CHECK(exact_line(trace, answers::of_pixel(1057, {15, 12})) == line);
  CHECK(exact_line(app.session(), answers::of_pixel(1, {0, 0})).empty());  // nothing was drawn there

  const Trace flat = test::record_run("delhi");
  App exact(flat, nullptr, {}, 1280, 720);
  CHECK(exact_line(exact.session(), answers::of_pixel(flat.size(), {1, 3})) == "exact");
}
