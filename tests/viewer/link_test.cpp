// Links of what the window shows: they lead back to it, in this window and in another.
#include <doctest/doctest.h>

#include "sim/viewer/stage.hpp"
#include "sim/words/link.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("a link leads back to its place in the window: step, stop, pixel and the pane that leads") {
  Lesson lesson = find_lesson("z-buffer");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  app.session().to_stop(6);
  const auto at_stop = app.link();
  REQUIRE(at_stop);
  CHECK(at_stop == fmt::format("#lesson=z-buffer&step={}", app.session().position()));
  const auto of_stop = test::picture(app);
  app.session().go_to(867);
  app.session().select(Cell{13, 6});
  app.set_lead("slice");
  const auto link = app.link();
  CHECK(link == "#lesson=z-buffer&step=867&pixel=13,6&pane=slice");
  const auto there = test::picture(app);
  CHECK(there != of_stop);

  CHECK(app.go_to_link(*at_stop));
  CHECK_FALSE(app.session().selected);
  CHECK(app.lead().empty());
  CHECK(test::picture(app) == of_stop);
  CHECK(app.go_to_link(*link));
  CHECK(app.session().position() == 867);
  CHECK(app.session().selected == Cell{13, 6});
  CHECK(test::picture(app) == there);
  CHECK(app.go_to_link("#lesson=z-buffer&stop=4"));
  CHECK(app.session().stop() == 3);

  // What opens something else is for another window.
  CHECK_FALSE(app.go_to_link("#lesson=bsp&step=3"));
  CHECK_FALSE(app.go_to_link("#scene=pyramid&step=3"));
  CHECK_FALSE(app.go_to_link("#lesson=z-buffer"));
  CHECK_THROWS_AS(app.go_to_link("#lesson=z-buffer&step=867&pane=nothing"), InputError);
}

TEST_CASE("what was changed in the window travels in the link") {
  const Trace trace = test::record_run("pyramid");
  App app(trace, nullptr, {}, 1280, 720);
  Changed changed;
  changed.made.push_back({{"theta", "70"}, "30"});
  changed.made.push_back({{"vertex 3", "1 0 2"}, "1 0 1"});
  app.show_changes(std::move(changed));
  const auto link = app.link();
  REQUIRE(link);
  CHECK(link->find("&change=theta+%3D+70&change=vertex+3+%3D+1+0+2") != std::string::npos);
  Changed long_one;
  for (int k = 0; k < 400; ++k) long_one.made.push_back({{fmt::format("vertex {}", k), "1 0 2"}, ""});
  app.show_changes(std::move(long_one));
  CHECK_FALSE(app.link());
}

TEST_CASE("what opens a place is copied as a command, and at once again as a link") {
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 640, 480);
  app.session().go_to(42);
  const auto copied = [&] {
    app.requests.clipboard.reset();
    test::press(app, SDLK_c, KMOD_LCTRL);
    return app.requests.clipboard.value_or("");
  };
  CHECK(copied() == "zstep view delhi --at 42");
  CHECK(copied() == "#scene=delhi&step=42");
  CHECK(copied() == "zstep view delhi --at 42");
  app.session().go_to(43);
  CHECK(copied() == "zstep view delhi --at 43");
  app.opened_by = {"view", "some/file.ztrace"};
  CHECK(copied() == "zstep view some/file.ztrace --at 43");
  CHECK(copied() == "zstep view some/file.ztrace --at 43");
}
