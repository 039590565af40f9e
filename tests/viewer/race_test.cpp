// The race: where each run is follows from the clock alone, its picture is that of its trace there, and keys drive it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/cost/comparison.hpp"
#include "sim/viewer/pictures.hpp"
#include "sim/viewer/stage.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/made_anew.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;
using compare::Measure;

namespace {

ViewerOptions racing() {
  ViewerOptions options;
  options.run_changed = test::made_anew;
  return options;
}

/// A race of these on a scene.
struct OnScene {
  OnScene(const std::string& scene, const std::vector<std::string>& entrants)
      : shown(test::record_run(scene)), race(shown, test::made_anew) {
    race.choose(entrants);
  }
  Trace shown;
  Race race;
};

/// Operations up to a position, one by one.
std::int64_t operations_up_to(const Trace& trace, std::int64_t position) {
  std::int64_t count = 0;
  trace.each(0, position, [&](std::int64_t, const RecordedEvent& recorded) {
    count += compare::work_of(static_cast<std::uint8_t>(recorded.event.index())) != compare::Work::bookkeeping;
    return true;
  });
  return count;
}

Picture replayed(const Trace& trace, std::int64_t position) {
  Replay replay(trace);
  replay.go_to(position);
  return replay.state().picture;
}

void check_all(const Race& race) {
  for (const auto& racer : race.racers()) {
    CAPTURE(racer->entrant.text);
    CHECK(racer->session.position() == race.position(*racer, race.at()));
    CHECK(racer->session.state().picture == replayed(racer->run.trace, racer->session.position()));
  }
}

}  // namespace

TEST_CASE("law: at each place of its clock, a run of the race has made that many steps, or done as many operations") {
  OnScene on("intersecting", {"z-buffer", "depth-sort", "bsp:root=first", "warnock"});
  std::string why;
  for (const compare::Measure clock : {compare::Measure::steps, compare::Measure::operations}) {
    REQUIRE(on.race.set_clock(clock, nullptr, why));
    CHECK(on.race.end() > 1000);
    for (const double share : {0.0, 0.001, 0.3, 0.50001, 0.9, 1.0}) {
      on.race.go_to(std::llround(share * static_cast<double>(on.race.end())));
      CAPTURE(on.race.at());
      check_all(on.race);
      for (const auto& racer : on.race.racers()) {
        const Trace& trace = racer->run.trace;
        const std::int64_t here = racer->session.position(), at = on.race.at();
        if (clock == compare::Measure::steps) {
          CHECK(here == std::min(at, trace.size()));
          continue;
        }
        const std::int64_t all = operations_up_to(trace, trace.size());
        CHECK(on.race.finish(*racer) == all);
        CHECK(operations_up_to(trace, here) == std::min(at, all));
        if (at > 0 && at < all) CHECK(operations_up_to(trace, here - 1) == at - 1);
        if (at >= all) CHECK(here == trace.size());
      }
    }
  }
}

TEST_CASE("law: the work of a run up to a step is that of its steps, and all of it is what counting says") {
  const Trace trace = test::record_run("teapot", test::of_size(48, 36));
  const compare::WorkDone work(trace);
  REQUIRE(trace.size() > 2 * 4096);
  compare::WorkCounts counts{};
  std::array<std::int64_t, step_limit> steps{};
  std::int64_t next = 0;
  trace.each(0, trace.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
    ++steps[recorded.step];
    ++counts[static_cast<std::size_t>(compare::work_of(static_cast<std::uint8_t>(recorded.event.index())))];
    if (position == next || position % 4096 < 2) CHECK(work.at(position) == counts);
    if (position == next) next = 2 * next + 1;
    return true;
  });
  CHECK(work.all() == counts);
  CHECK(compare::work_in(trace.header().page, steps) == counts);
}

TEST_CASE("by time, the run that takes longest is done last, and each is done at its own time") {
  OnScene on("pyramid", {"z-buffer", "ray-casting"});
  std::string why;
  REQUIRE_MESSAGE(on.race.set_clock(compare::Measure::time, nullptr, why), why);
  for (const auto& racer : on.race.racers()) {
    CHECK(*racer->seconds > 0);
    on.race.go_to(on.race.end());
    check_all(on.race);
    CHECK(racer->session.position() == racer->run.trace.size());
    on.race.go_to(on.race.finish(*racer) - 1);
    check_all(on.race);
  }
  // Who ends the measuring stays with the clock that there was.
  Race other(on.shown, test::made_anew);
  other.choose({"z-buffer", "bsp"});
  CHECK_FALSE(other.set_clock(
      compare::Measure::time, [] { return true; }, why));
  CHECK(other.clock() == compare::Measure::operations);
  CHECK(why.find("ended") != std::string::npos);
}

TEST_CASE("law: every method that can draw a scene can race on it, and ends with the picture that it draws") {
  int raced_in_all = 0;
  for (const char* name :
       {"intersecting", "y = sin(x)*cos(z)", "lessons/scenes/panes.toml", "lessons/scenes/lamp.toml"}) {
    CAPTURE(name);
    const std::string scene = std::string(name).ends_with(".toml") ? test::in_checkout(name) : name;
    const SceneFile file = load_scene(scene);
    const Scene seen = look_at_scene(file.scene, test::of_size(24, 18));
    TraceRecorder recorder(header_for(method("z-buffer"), {}), seen);
    method("z-buffer").record(seen, {}, recorder);
    recorder.finish();
    const Trace shown = Trace::from_bytes(recorder.take_bytes(), "shown");
    Race race(shown, test::made_anew);
    for (const Method& one : methods()) {
      if (!can_draw(one, seen, {})) continue;
      CAPTURE(one.id);
      const auto& all = race.all();
      CHECK(std::any_of(all.begin(), all.end(), [&](const auto& entrant) { return entrant.text == one.id; }));
      const std::string beside = one.id == "z-buffer" ? "painter" : "z-buffer";
      race.choose({std::string(one.id), beside});
      race.go_to(race.end());
      NullRecorder nothing;
      const Picture drawn = one.taught(seen, {}, nothing), &at_end = race.racers()[0]->session.state().picture;
      CHECK(at_end.polygon == drawn.polygon);
      for (std::size_t at = 0; at < drawn.polygon.size(); ++at)
        REQUIRE(color_at(at_end, seen, at) == color_at(drawn, seen, at));
      ++raced_in_all;
    }
  }
  CHECK(raced_in_all > 40);
}

TEST_CASE("each option that is offered can run") {
  const Trace shown = test::record_run("intersecting");
  Race race(shown, test::made_anew);
  CHECK(race.all().size() > 40);
  for (const compare::Entrant& entrant : race.all()) {
    if (entrant.text == "painter") continue;
    CAPTURE(entrant.text);
    CHECK_NOTHROW(race.choose({"painter", entrant.text}));
  }
}

TEST_CASE("what cannot race is refused in one line, and those that raced stay") {
  OnScene on("pyramid", {"z-buffer", "bsp"});
  on.race.go_to(100);
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"z-buffer"},
                                             {"z-buffer", "z-buffer"},
                                             {"z-buffer", "no-such"},
                                             {"z-buffer", "shadow-buffer"},
                                             {"z-buffer", "bsp:root=last"},
                                             {"z-buffer", "bsp", "warnock", "painter", "scan-line"}}) {
    CHECK_THROWS_AS(on.race.choose(wrong), InputError);
    CHECK(on.race.chosen() == std::vector<std::string>{"z-buffer", "bsp"});
    CHECK(on.race.at() == 100);
    check_all(on.race);
  }
}

TEST_CASE("a race is opened, driven, chosen and closed by keys, and looks the same however one came to a place") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = racing();
  Stage stage(trace, options, Settings{}, 1280, 720);
  App& app = stage.app();
  app.session().go_to(50);
  const test::Bytes one_run = test::picture(app);
  test::press(app, SDLK_r, KMOD_LCTRL);
  REQUIRE(app.racing());
  CHECK(app.race().chosen() == std::vector<std::string>{"z-buffer", "scan-line", "painter"});
  CHECK(test::picture(app) != one_run);
  for (int k = 0; k < 3; ++k) test::press(app, SDLK_PAGEDOWN);
  const std::int64_t there = app.race().at();
  CHECK(there == 3 * (app.race().end() / 20));
  const test::Bytes walked = test::picture(app);
  test::press(app, SDLK_RIGHT);
  CHECK(app.race().at() == there + 1);
  test::press(app, SDLK_END);
  CHECK(test::picture(app) != walked);
  for (const auto& racer : app.race().racers()) CHECK(racer->session.position() == racer->session.size());
  while (app.race().at() > there + 100) test::press(app, SDLK_LEFT, KMOD_LCTRL);
  while (app.race().at() > there + 10) test::press(app, SDLK_LEFT, KMOD_LSHIFT);
  while (app.race().at() > there) test::press(app, SDLK_LEFT);
  CHECK(test::picture(app) == walked);
  CHECK(app.session().position() == 50);  // the run behind it stays
  test::press(app, SDLK_HOME);

  // Played, as the window's loop does it: to the end, and no farther.
  test::press(app, SDLK_SPACE);
  REQUIRE(app.race().playing);
  double now = 10;
  for (int k = 0; k < 2000 && app.race().playing; ++k) app.play(now += 0.05);
  CHECK(app.race().at() == app.race().end());
  CHECK_FALSE(app.race().playing);

  // By operations, with Warnock in place of the painter's algorithm.
  test::press(app, SDLK_2);
  CHECK(app.race().clock() == compare::Measure::operations);
  test::press(app, SDLK_c);
  REQUIRE(app.overlay() == Overlay::racers);
  test::type(app, "painter");
  test::press(app, SDLK_RETURN), test::release(app, SDLK_RETURN);
  CHECK(app.race().chosen() == std::vector<std::string>{"z-buffer", "scan-line"});
  for (int k = 0; k < 7; ++k) test::press(app, SDLK_BACKSPACE), test::release(app, SDLK_BACKSPACE);
  test::type(app, "warnock");
  test::press(app, SDLK_RETURN), test::release(app, SDLK_RETURN);
  test::press(app, SDLK_ESCAPE);
  CHECK(app.overlay() == Overlay::none);
  REQUIRE(app.racing());
  CHECK(app.race().chosen() == std::vector<std::string>{"z-buffer", "scan-line", "warnock"});

  // A key of one run does nothing here but say so.
  test::press(app, SDLK_g);
  CHECK(app.overlay() == Overlay::none);
  CHECK(app.session().message.find("race") != std::string::npos);
  app.session().message.clear();

  // What is copied opens the same race.
  app.race().go_to(700);
  test::press(app, SDLK_c, KMOD_LCTRL);
  CHECK(app.command_line().ends_with("--race 'z-buffer,scan-line,warnock' --race-by operations --at 700"));
  app.session().message.clear();
  PictureOptions how;
  how.race = RaceAsked{{"z-buffer", "scan-line", "warnock"}, compare::Measure::operations, 700, false};
  how.run_by = test::made_anew;
  const test::Bytes here = test::picture(app);
  CHECK(Pictures(trace, how).at(50).rgb == here);

  test::press(app, SDLK_ESCAPE);
  CHECK_FALSE(app.racing());
  CHECK(test::picture(app) == one_run);
}

TEST_CASE("a click on a bar goes there, and the window names who runs at every size") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = racing();
  for (const auto& [width, height] : {std::pair{1280, 720}, {640, 360}, {1920, 1080}})
    for (const bool presenter : {false, true}) {
      Settings settings;
      settings.presenter = presenter;
      Stage stage(trace, options, settings, width, height);
      App& app = stage.app();
      app.open_race(RaceAsked{{"z-buffer", "bsp", "warnock", "ray-casting"}, compare::Measure::steps, 0, false});
      CHECK(!test::picture(app).empty());
      if (width != 1280 || presenter) continue;
      test::click(app, 640, 650);
      CHECK(app.race().at() > app.race().end() / 3);
      CHECK(app.race().at() < 2 * app.race().end() / 3);
      check_all(app.race());
    }
}

TEST_CASE("lines that cross are found where they do, as far as they clearly differ") {
  const auto line = [](const char* title, std::vector<std::pair<int, double>> costs) {
    compare::GrowthLine made{title, {}, ""};
    for (const auto& [polygons, cost] : costs)
      made.points.push_back({polygons, static_cast<std::int64_t>(cost), 0, cost / 1e6, 3});
    return made;
  };
  // N² / 100 and 10 N: equal at N = 1000; the third is as good as the second.
  const std::vector<compare::GrowthLine> lines{
      line("A", {{25, 6.25}, {100, 100}, {250, 625}, {1000, 10000}, {2500, 62500}}),
      line("B", {{25, 250}, {100, 1000}, {250, 2500}, {1000, 10000}, {2500, 25000}, {10000, 100000}}),
      line("C", {{25, 251}, {100, 990}, {250, 2510}, {1000, 9990}, {2500, 25100}, {10000, 99000}})};
  const auto found = compare::crossings(lines, compare::Measure::time);
  REQUIRE(found.size() == 2);
  for (const compare::Crossing& crossing : found) {
    CHECK(crossing.first == 0);
    CHECK(crossing.polygons == doctest::Approx(1000).epsilon(0.02));
    CHECK(crossing.rounded() == 1000);
    CHECK(crossing.cost == doctest::Approx(0.01).epsilon(0.03));
  }
  // Of a pair that is as good as equal for a while the place where it changes over is what counts.
  std::vector<compare::GrowthLine> slow{line("A", {{25, 100}, {100, 1010}, {250, 2490}, {1000, 9000}}),
                                        line("B", {{25, 250}, {100, 1000}, {250, 2500}, {1000, 5000}})};
  REQUIRE(compare::crossings(slow, compare::Measure::time).size() == 1);
  CHECK(compare::crossings(slow, compare::Measure::time)[0].polygons < 100);
  const std::string told = compare::tell_growth(lines, compare::Measure::time);
  CHECK(told.find("A costs less than B up to about 1\u00a0000 polygons, and more beyond.") != std::string::npos);
  CHECK(told.find("With 25 polygons A costs least; with 2\u00a0500 B and C cost least") != std::string::npos);
  CHECK(compare::crossings({lines[1], lines[2]}, compare::Measure::time).empty());
  CHECK(compare::tell_growth({lines[1], lines[2]}, compare::Measure::time).find("no two of them cross") !=
        std::string::npos);
}

TEST_CASE("what is measured for the chart is what a recording of that scene holds, it goes on cell by cell, and ends") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = racing();
  Stage stage(trace, options, Settings{}, 1280, 720);
  App& app = stage.app();
  app.open_race(RaceAsked{{"z-buffer", "scan-line"}, compare::Measure::steps, 0, false});
  test::press(app, SDLK_TAB);
  REQUIRE(app.shows_growth());
  CHECK(app.growth().lines.empty());  // nothing is measured that nobody asked for
  test::press(app, SDLK_RETURN);
  REQUIRE(app.growth().at_work);
  const test::Bytes begun = test::picture(app);
  while (app.growth().next < 4) app.frame();
  CHECK(test::picture(app) != begun);
  test::press(app, SDLK_ESCAPE);
  CHECK_FALSE(app.growth().at_work);
  REQUIRE(app.racing());
  for (const compare::GrowthLine& line : app.growth().lines) {
    REQUIRE(line.points.size() >= 2);
    const compare::GrowthPoint& point = line.points[1];
    CHECK(point.polygons == compare::growth_sizes[1]);
    CHECK(point.seconds > 0);
    const Scene scene = compare::random_scene(point.polygons, compare::growth_layers, compare::growth_side, 1);
    Conventions conventions;
    conventions.cull = false;
    const Method& by = line.title == "Z-buffer" ? method("z-buffer") : method("scan-line");
    TraceRecorder recorder(header_for(by, conventions), scene);
    by.record(scene, conventions, recorder);
    recorder.finish();
    const Trace recorded = Trace::from_bytes(recorder.take_bytes(), "recorded");
    CHECK(point.steps == recorded.size());
    CHECK(point.operations == operations_up_to(recorded, recorded.size()));
  }
  // The next press begins anew.
  test::press(app, SDLK_RETURN);
  CHECK(app.growth().next == 0);
}
