// A second eye: the run that a lesson shows beside its own with another eye, in the plan, in the tree and in the scene.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "sim/classroom/lesson.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("law: the run beside a lesson's with another eye has the same tree, and goes through it in another order") {
  int seen = 0;
  for (Lesson& lesson : all_lessons()) {
    if (lesson.method != "bsp") continue;
    const Trace trace = run_lesson(lesson);
    for (const Stop& stop : lesson.stops) {
      if (stop.beside.empty()) continue;
      ++seen;
      Replay one(trace), other(*stop.beside[0].run);
      one.go_to(trace.size()), other.go_to(stop.beside[0].run->size());
      const MethodState &a = one.state().machine, &b = other.state().machine;
      CHECK(trace.scene().camera.eye != stop.beside[0].run->scene().camera.eye);
      REQUIRE(a.tree.size() == b.tree.size());
      for (std::size_t node = 0; node < a.tree.size(); ++node) {
        CHECK(a.tree[node].parent == b.tree[node].parent);
        CHECK(a.tree[node].pieces == b.tree[node].pieces);
      }
      CHECK(!std::equal(a.drawn.begin(), a.drawn.end(), b.drawn.begin(), b.drawn.end()));
    }
  }
  CHECK(seen > 0);
}

TEST_CASE("the plan names both eyes, and both trees tell their order") {
  Lesson lesson = find_lesson("many-eyes");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  for (std::size_t stop = 0; stop < lesson.stops.size(); ++stop) {
    if (lesson.stops[stop].focus != "plan") continue;
    app.session().to_stop(static_cast<int>(stop));
    CHECK_MESSAGE(test::times_written(app, "eye 1") == 1, lesson.stops[stop].heading);
    CHECK_MESSAGE(test::times_written(app, "eye 2") == 1, lesson.stops[stop].heading);
  }
  const auto beside =
      std::find_if(lesson.stops.begin(), lesson.stops.end(), [](const Stop& stop) { return !stop.beside.empty(); });
  REQUIRE(beside != lesson.stops.end());
  app.session().to_stop(static_cast<int>(beside - lesson.stops.begin()));
  CHECK(test::times_written(app, "#1") == 2);
  CHECK(test::times_written(app, "#8") == 1);
}

TEST_CASE("a lesson's scene shows the angles of the eye where the lesson gives them, and how a vertex is projected") {
  Lesson lesson = find_lesson("viewing");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  const auto named = [&](int stop, const std::string& what) {
    app.session().to_stop(stop);
    return test::times_written(app, what);
  };
  CHECK(named(0, "\u03b8") == 0);
  CHECK(named(1, "\u03b8") >= 1);
  const auto first = [&](const std::string& step) {
    for (std::size_t k = 0; k < lesson.stops.size(); ++k)
      if (lesson.stops[k].anchor.find(step) != std::string::npos) return static_cast<int>(k);
    return -1;
  };
  const int asks = first("before: project where vertex == 0"), tells = first("at: project where vertex == 0");
  REQUIRE(asks >= 0);
  REQUIRE(tells >= 0);
  app.session().to_stop(asks);
  test::picture(app);
  const auto before = test::letters_of(app.ui().fonts).words;
  app.session().to_stop(tells);
  test::picture(app);
  const auto after = test::letters_of(app.ui().fonts).words;
  const auto has = [](const auto& words, const std::string& part) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return word.find(part) != std::string::npos; });
  };
  CHECK_FALSE(has(before, "= 16"));  // which is asked for
  CHECK(has(after, "= 16"));
}
