// What moves: where it is on the way, that it ends, and that its end is the picture of a window in which nothing moves.
#include <doctest/doctest.h>

#include <vector>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/commands.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

std::int64_t entering(const Trace& trace) {
  return trace.next(0, [](const RecordedEvent& e) { return holds<EdgeEnter>(e.event); }).value();
}

/// A frame at this time, as the window's loop draws it.
test::Bytes at_time(App& app, double time) {
  app.clock_time = time;
  app.frame();
  return app.renderer().rgb();
}

/// Frames as the loop draws them, until nothing is due: how many of them moved.
int run_loop(App& app, double& time) {
  int moving = 0;
  std::uint64_t seen = 0;
  for (int due = App::frames_to_settle; due > 0; time += 0.016) {
    at_time(app, time);
    moving += app.moving();
    --due;
    if (std::exchange(seen, app.renderer().fingerprint()) != app.renderer().fingerprint())
      due = std::max(due, App::frames_to_settle - 1);
    if (app.works()) due = std::max(due, 1);
    REQUIRE(moving < 100);
  }
  return moving;
}

}  // namespace

TEST_CASE("law: panes and rows are there within 200 ms, with the bytes of a window in which nothing moves") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App still(trace, nullptr, {}, 1280, 720), app(trace, nullptr, {}, 1280, 720);
  app.moves = true;
  double time = 100;
  run_loop(app, time);
  const std::int64_t enters = entering(trace);
  const std::vector<void (*)(App&, std::int64_t)> wishes{
      [](App& a, std::int64_t) { a.set_lead("scene"); }, [](App& a, std::int64_t) { a.set_lead("edge_table"); },
      [](App& a, std::int64_t step) { a.session().go_to(step); }, [](App& a, std::int64_t) { a.set_lead(""); },
      [](App& a, std::int64_t) { a.set_lead("depth"); }};
  for (std::size_t k = 0; k < wishes.size(); ++k) {
    CAPTURE(k);
    wishes[k](app, enters), wishes[k](still, enters);
    const double begun = time;
    const test::Bytes first = at_time(app, time);
    CHECK(app.moving());
    const test::Bytes later = at_time(app, time += 0.05);
    CHECK(app.moving());
    CHECK(later != first);
    run_loop(app, time);
    CHECK(time - begun < 0.2 + 0.016 * (App::frames_to_settle + 2));
    CHECK_FALSE(app.moving());
    const test::Bytes end = app.renderer().rgb();
    CHECK(end != later);
    CHECK(end == test::picture(still));
  }
}

TEST_CASE("what is drawn headless, and what settles, shows the end of what moves at once") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App headless(trace, nullptr, {}, 1280, 720), app(trace, nullptr, {}, 1280, 720);
  app.moves = true;
  at_time(app, 1), at_time(headless, 1);
  for (App* one : {&app, &headless}) one->set_lead("scene");
  headless.frame();
  CHECK_FALSE(headless.moving());
  at_time(app, 1.02);
  CHECK(app.moving());
  const test::Bytes settled = test::picture(app);
  CHECK(settled == test::picture(headless));
  CHECK_FALSE(app.moving());
}

TEST_CASE("with reduced motion nothing moves, a window that changes its size moves nothing either") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App app(trace, nullptr, {}, 1280, 720);
  app.moves = true;
  double time = 5;
  run_loop(app, time);
  CHECK_FALSE(app.settings().reduced_motion);
  app.set_lead("scene");
  CHECK(run_loop(app, time) > 0);
  app.resize(1000, 700);
  CHECK(run_loop(app, time) == 0);
  test::press(app, SDLK_m, KMOD_LSHIFT);
  CHECK(app.settings().reduced_motion);
  app.set_lead("depth");
  CHECK(run_loop(app, time) == 0);
  app.session().go_to(entering(trace));
  CHECK(run_loop(app, time) == 0);
}

TEST_CASE(
    "law: what a step forwards does is seen on its way, and ends as the bytes of a window in which nothing moves") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  for (const Unit unit : {Unit::span, Unit::scan_line, Unit::polygon}) {
    CAPTURE(unit_word(unit));
    App still(trace, nullptr, {}, 1280, 720), app(trace, nullptr, {}, 1280, 720);
    app.moves = true;
    double time = 10;
    const std::int64_t from =
        trace.next(trace.size() / 4, [](const RecordedEvent& e) { return holds<SpanBegin>(e.event); }).value();
    for (App* one : {&app, &still}) one->session().go_to(from);
    run_loop(app, time);
    for (App* one : {&app, &still}) one->move(unit, 1);
    const std::int64_t to = app.session().position();
    const test::Bytes first = at_time(app, time), later = at_time(app, time += 0.15);
    CHECK(app.moving());
    CHECK(first != later);
    run_loop(app, time);
    CHECK_FALSE(app.moving());
    const test::Bytes end = test::picture(still);
    CHECK(app.renderer().rgb() == end);
    CHECK(later != end);
    // A key goes to its end.
    app.session().go_to(from);
    run_loop(app, time);
    app.move(unit, 1);
    at_time(app, time);
    CHECK(app.moving());
    test::press(app, SDLK_LSHIFT, KMOD_LSHIFT);
    at_time(app, time += 0.01);
    CHECK_FALSE(app.moving());
    CHECK(app.session().position() == to);
    // Backwards nothing is on its way, nor with reduced motion.
    app.move(unit, -1);
    at_time(app, time += 0.01);
    CHECK_FALSE(app.moving());
    app.set_reduced_motion(true);
    app.session().go_to(from);
    run_loop(app, time);
    app.move(unit, 1);
    at_time(app, time += 0.01);
    CHECK_FALSE(app.moving());
  }
}

TEST_CASE("law: after each step of each method that moves something, its end is the still picture") {
  for (const char* method : {"z-buffer", "depth-sort", "ray-casting"}) {
    CAPTURE(method);
    const Trace trace = test::record_run_by(method, "pyramid", test::of_size(25, 25));
    App still(trace, nullptr, {}, 1280, 720), app(trace, nullptr, {}, 1280, 720);
    app.moves = true;
    double time = 10;
    int moved = 0;
    for (std::int64_t at = trace.size() / 3; at < trace.size() && at < trace.size() / 3 + 40; ++at) {
      for (App* one : {&app, &still}) one->session().go_to(at);
      const int moving = run_loop(app, time += 1);
      moved += moving > 0;
      REQUIRE(app.renderer().rgb() == test::picture(still));
    }
    CHECK(moved < 40);
  }
}

TEST_CASE("a loop that waits for events draws nothing once what moves has ended") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App app(trace, nullptr, {}, 1280, 720);
  app.moves = true;
  double time = 5;
  run_loop(app, time);
  app.set_lead("scene");
  const int moving = run_loop(app, time);
  CHECK((moving > 5 && moving < 14));  // 180 ms in steps of 16
  const std::uint64_t seen = app.renderer().fingerprint();
  at_time(app, time + 10);
  CHECK(app.renderer().fingerprint() == seen);
  CHECK_FALSE(app.moving());
}

TEST_CASE("a dividing plane grows out of its piece, on the plan, and ends where nothing moves") {
  Lesson lesson = find_lesson("bsp");
  const Trace trace = run_lesson(lesson);
  const auto made = trace.next(0, [](const RecordedEvent& e) { return holds<PlaneEquation>(e.event); }).value();
  App still(trace, nullptr, {}, 1280, 720), app(trace, nullptr, {}, 1280, 720);
  app.moves = true;
  double time = 10;
  for (App* one : {&app, &still}) one->set_lead("plan"), one->session().go_to(made - 1);
  run_loop(app, time);
  for (App* one : {&app, &still}) one->move(Unit::event, 1);
  at_time(app, time);
  const test::Bytes on_way = at_time(app, time += 0.1);
  CHECK(app.moving());
  run_loop(app, time);
  CHECK_FALSE(app.moving());
  const test::Bytes end = test::picture(still);
  CHECK(app.renderer().rgb() == end);
  CHECK(on_way != end);
}
