// The box for SQL: what it answers, where its rows lead, what is painted, and that keys reach it.
#include <cmath>

#include <doctest/doctest.h>

#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("a question: rows, where they lead, and a picture of them") {
  const Trace trace = test::record_run("pyramid-behind");
  Inquiry inquiry(trace);
  inquiry.ask(
      "select x, y, count(*), max(step) as step from depth_compare where not nearer group by x, y order by 3 desc, y, "
      "x");
  CHECK(inquiry.columns() == std::vector<std::string>{"x", "y", "count(*)", "step"});
  REQUIRE(inquiry.rows().size() > 10);
  CHECK(inquiry.note().find(" rows") != std::string::npos);
  REQUIRE(inquiry.step_of(0));
  const auto* compare = get_if<DepthCompare>(&trace.event(*inquiry.step_of(0)).event);
  REQUIRE(compare);
  CHECK_FALSE(compare->nearer);
  CHECK(inquiry.pixel_of(0) == Cell{compare->x, compare->y});
  REQUIRE(inquiry.heat());
  CHECK(inquiry.heat()->name == "count(*)");
  const std::size_t width = static_cast<std::size_t>(trace.scene().raster.width);
  const double value =
      inquiry.heat()->values[static_cast<std::size_t>(compare->y) * width + static_cast<std::size_t>(compare->x)];
  CHECK(std::to_string(static_cast<int>(value)) == inquiry.rows()[0][2]);
  CHECK(std::isnan(inquiry.heat()->values[0]));

  inquiry.ask("select count(*) from depth_compare");
  CHECK(inquiry.note() == "1 row");
  CHECK_FALSE(inquiry.heat());
  CHECK_FALSE(inquiry.step_of(0));
  inquiry.ask("select x, y from depth_compare");
  REQUIRE(inquiry.heat());
  CHECK(inquiry.heat()->name == "rows");
  inquiry.ask("selec");
  CHECK(inquiry.rows().empty());
  CHECK(inquiry.note().find("syntax error") != std::string::npos);
  CHECK(inquiry.is_wrong());
  inquiry.ask("select 9999999 as step, -5 as x, 70000 as y");
  CHECK_FALSE(inquiry.step_of(0));
  CHECK_FALSE(inquiry.pixel_of(0));
}

TEST_CASE("a question that takes long is seen to be asked, and Esc ends it") {
  const Trace trace = test::record_run("pyramid-behind");
  Inquiry inquiry(trace);
  int looks = 0;
  inquiry.ask("with recursive n(i) as (select 0 union all select i + 1 from n) select max(i) from n",
              [&] { return ++looks == 3; });
  CHECK(looks == 3);
  CHECK(inquiry.note() == "stopped; 0 rows so far");

  App app(trace, nullptr, {}, 1280, 720);
  bool ended = false;
  app.ends_waiting = [&] { return ended; };
  test::type(app, "q");
  test::type(app, "select x, y from depth_compare where nearer");
  const test::Bytes typed = test::picture(app);
  test::press(app, SDLK_RETURN);
  CHECK(app.asking());
  CHECK(app.inquiry().rows().empty());
  app.frame();
  CHECK(app.asking());
  CHECK(app.inquiry().rows().empty());
  app.frame();
  CHECK_FALSE(app.asking());
  CHECK(app.inquiry().rows().size() == 304);
  CHECK(test::picture(app) != typed);
}

TEST_CASE("Q opens the box, what is typed is asked, rows are picked and gone to, Tab paints, Esc ends") {
  const Trace trace = test::record_run("pyramid-behind");
  App app(trace, nullptr, {}, 1280, 720);
  const test::Bytes before = test::picture(app);
  test::type(app, "q");  // the key's own letter is not typed
  CHECK(app.drawer() == Drawer::query);
  CHECK(app.typed.empty());
  test::type(app, "select x, y, z, step from depth_compare where nearer order by step");
  test::press(app, SDLK_RETURN);
  REQUIRE(app.inquiry().rows().size() == 304);
  const test::Bytes answered = test::picture(app);
  CHECK(answered != before);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_DOWN);
  test::press(app, SDLK_RETURN);
  CHECK(app.session().position() == *app.inquiry().step_of(2));
  CHECK(app.session().selected == app.inquiry().pixel_of(2));
  CHECK(app.drawer() == Drawer::query);
  test::press(app, SDLK_TAB);
  CHECK(app.ui().heat);
  CHECK(test::picture(app) != answered);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.drawer() == Drawer::none);
  CHECK(app.ui().heat);
  test::press(app, SDLK_ESCAPE);
  CHECK_FALSE(app.ui().heat);
  // The question is still there when the box is opened again.
  test::press(app, SDLK_q);
  CHECK(app.typed == app.inquiry().sql());
  test::press(app, SDLK_BACKSPACE);
  test::type(app, "q");
  CHECK(app.typed.substr(app.typed.size() - 4) == "steq");
  test::press(app, SDLK_RETURN);
  CHECK(app.inquiry().rows().empty());
  CHECK(app.inquiry().note().find("no such column") != std::string::npos);
  app.settle();
}
