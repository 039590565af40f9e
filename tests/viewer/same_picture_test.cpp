// The law of the window: what it shows at a step is what `--at STEP --screenshot` draws, however a reader came there.
#include <doctest/doctest.h>

#include "sim/viewer/pictures.hpp"
#include "sim/viewer/stage.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/drive.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

constexpr int window_width = 1280, window_height = 720;

/// What a screenshot shows there: nothing was drawn before it.
test::Bytes from_screenshot(const Trace& trace, const Lesson* lesson, std::int64_t at) {
  PictureOptions options;
  options.width = window_width, options.height = window_height, options.lesson = lesson;
  return Pictures(trace, options).at(at).rgb;
}

/// By the arrow keys, a frame for each step as a window draws them.
test::Bytes walked(App& app, std::int64_t from, std::int64_t to) {
  app.session().go_to(from);
  app.frame();
  while (app.session().position() != to) {
    test::press(app, app.session().position() < to ? SDLK_RIGHT : SDLK_LEFT);
    app.frame();
  }
  return test::picture(app);
}

test::Bytes played(App& app, std::int64_t from, std::int64_t to, int speed) {
  Session& s = app.session();
  s.go_to(from);
  app.frame();
  s.speed = speed;
  s.playing = true;
  double now = 1000;
  for (int i = 0; i < 4000 && s.playing && s.position() < to; ++i) s.play(now += 1.0), app.frame();
  s.playing = false;
  s.speed = Settings().speed;
  if (s.position() != to || !s.message.empty()) s.go_to(to);  // it halted before, went beyond, or says why it waits
  return test::picture(app);
}

test::Bytes resized_and_back(App& app) {
  app.resize(900, 600);
  (void)test::picture(app);
  app.resize(window_width, window_height);
  return test::picture(app);
}

/// One of the ways to a step after the other, from wherever the reader was before.
void check_ways(App& app, const Trace& trace, const Lesson* lesson, std::int64_t at, int turn) {
  CAPTURE(at);
  CAPTURE(turn);
  const test::Bytes wanted = from_screenshot(trace, lesson, at);
  if (turn % 3 == 0) {
    const bool forwards = walked(app, std::max<std::int64_t>(0, at - 7), at) == wanted;
    CHECK(forwards);
    const bool resized = resized_and_back(app) == wanted;
    CHECK(resized);
  } else if (turn % 3 == 1) {
    const bool backwards = walked(app, std::min(trace.size(), at + 5), at) == wanted;
    CHECK(backwards);
  } else {
    app.session().go_to(trace.size());
    app.frame();
    // By steps, and at the speeds of spans, lines and polygons.
    const bool by_playing =
        played(app, std::max<std::int64_t>(0, at - 5), at, turn % 2 == 0 ? 4 : 7 + turn / 6 % 3) == wanted;
    CHECK(by_playing);
  }
}

}  // namespace

TEST_CASE("law: at the stops of every lesson the window is the headless picture, however one came there") {
  int turn = 0;
  for (Lesson& lesson : all_lessons()) {
    CAPTURE(lesson.id);
    const Trace trace = run_lesson(lesson);
    App app(trace, &lesson, {}, window_width, window_height);
    app.session().to_stop(0);
    app.frame();
    const int count = static_cast<int>(lesson.stops.size()), every = 9 * test::sparse;
    for (int stop = 0; stop < count; ++stop, ++turn) {
      // N to each, looked at by a frame, as in a class; some are held against their pictures.
      if (stop > 0) test::press(app, SDLK_n), app.frame();
      if (stop % every != turn % every) continue;
      const std::int64_t at = lesson.stops[static_cast<std::size_t>(stop)].position;
      const bool first_there = stop == 0 || lesson.stops[static_cast<std::size_t>(stop - 1)].position != at;
      CAPTURE(stop);
      if (!first_there) continue;  // --at shows the first of those that speak there
      const bool by_n = test::picture(app) == from_screenshot(trace, &lesson, at);
      CHECK(by_n);
      check_ways(app, trace, &lesson, at, turn);
      app.session().to_stop(stop);
    }
    // The end, as a reader comes to it from a stop that is not there.
    app.session().to_stop(0);
    app.frame();
    const test::Bytes end = from_screenshot(trace, &lesson, trace.size());
    test::press(app, SDLK_END);
    const bool at_end = test::picture(app) == end;
    CHECK(at_end);
  }
}

TEST_CASE("law: in every method's golden trace the window is the headless picture, however one came there") {
  int turns = 0, of_half_space = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    // Each run keeps its place, whatever other runs come to be there.
    const int turn = trace.header().algorithm == "half-space" ? turns + ++of_half_space : ++turns;
    if (turn % test::sparse != 0) return;
    CAPTURE(name);
    App app(trace, nullptr, {}, window_width, window_height);
    app.frame();
    // Another place in each, so that over all of them every part of a run is seen.
    check_ways(app, trace, nullptr, trace.size() * (turn % 7 + 1) / 8, turn);
  });
}

TEST_CASE("moves by every unit come to the picture of the step, and so does the way back from another method") {
  const Trace trace = open_jsonl(test::golden_files().front());
  App app(trace, nullptr, {}, window_width, window_height);
  for (const Unit unit : {Unit::pixel, Unit::span, Unit::scan_line, Unit::polygon}) {
    app.session().go_to(trace.size() / 3);
    app.frame();
    app.session().move(unit, 1);
    app.session().message.clear();
    CAPTURE(unit_word(unit));
    const bool same = test::picture(app) == from_screenshot(trace, nullptr, app.session().position());
    CHECK(same);
  }
  ViewerOptions options;
  options.other_method = [](const Trace& now, int) {
    return std::optional(
        OtherRun{test::recorded_by(now.header().algorithm == "z-buffer" ? "painter" : "z-buffer", now.scene()), true});
  };
  const Trace first = test::recorded_by("z-buffer", trace.scene());
  Stage stage(first, options, Settings{}, window_width, window_height);
  (void)test::picture(stage.app());
  for (int i = 0; i < 2; ++i) {
    stage.switch_method(1);
    (void)test::picture(stage.app());
    const std::int64_t at = stage.trace().size() / 2;
    stage.app().session().go_to(at);
    const bool same = test::picture(stage.app()) == from_screenshot(stage.trace(), nullptr, at);
    CHECK(same);
  }
}
