// T_1 … T_4 in the scene: by key, by mouse, by a stop of a lesson.
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("Shift+T shows T_1 to T_4 one after the other, each another picture, and then none") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App app(trace, nullptr, {}, 1280, 720);
  app.set_lead("scene");
  std::vector<test::Bytes> pictures{test::picture(app)};
  for (int step = 1; step <= 4; ++step) {
    test::press(app, SDLK_t, KMOD_LSHIFT);
    CHECK(viewing_step(app.ui()) == step);
    pictures.push_back(test::picture(app));
    for (int k = 0; k < step; ++k) CHECK(pictures[static_cast<std::size_t>(k)] != pictures.back());
  }
  test::press(app, SDLK_t, KMOD_LSHIFT);
  CHECK(viewing_step(app.ui()) == 0);
  app.session().message.clear();
  CHECK(test::picture(app) == pictures.front());
}

TEST_CASE("the scene and the first lesson turn the axes by the same angle") {
  Lesson lesson = find_lesson("viewing");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  const std::array<std::string, 6> angles{"", "", "\u221253.13\u00b0", "126.87\u00b0", "", ""};
  for (int stop = 0; stop < static_cast<int>(lesson.stops.size()); ++stop) {
    app.session().to_stop(stop);
    const std::string& angle = angles[static_cast<std::size_t>(viewing_step(app.ui()))];
    if (angle.empty()) continue;
    test::picture(app);
    int said = 0;
    for (const std::string& word : test::letters_of(app.ui().fonts).words)
      if (const std::size_t at = word.find(angle); at != std::string::npos)
        said += !word.substr(0, at).ends_with("\u2212");
    CHECK_MESSAGE(said == 2, angle);
  }
}

TEST_CASE("a scene on the screen has no such steps, and the window says so") {
  const Trace trace = test::record_run(test::in_checkout("tests/golden/edges.toml"));
  App app(trace, nullptr, {}, 1280, 720);
  test::press(app, SDLK_t, KMOD_LSHIFT);
  CHECK(viewing_step(app.ui()) == 0);
  CHECK(app.session().message.find("do not make up its viewing") != std::string::npos);
}

TEST_CASE("the first lesson's stops show the step that they speak of, a reader's choice holds until the next") {
  Lesson lesson = find_lesson("viewing");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  std::vector<int> shown;
  for (int stop = 0; stop < static_cast<int>(lesson.stops.size()); ++stop) {
    app.session().to_stop(stop);
    if (const int step = viewing_step(app.ui()); step > 0 && step < 5) {
      CHECK(lesson.stops[static_cast<std::size_t>(stop)].heading.find(
                std::string("T") + std::vector<std::string>{"₁", "₂", "₃", "₄"}[static_cast<std::size_t>(step - 1)]) ==
            0);
      CHECK(app.lead() == "scene");
      shown.push_back(stop);
    }
  }
  REQUIRE(shown.size() == 4);
  app.session().to_stop(shown[1]);
  choose_viewing_step(app.ui(), 4);
  CHECK(viewing_step(app.ui()) == 4);
  app.session().to_stop(shown[2]);
  CHECK(viewing_step(app.ui()) == 3);
  app.session().to_stop(shown[1]);
  CHECK(viewing_step(app.ui()) == 4);
  app.session().to_stop(0);
  CHECK(viewing_step(app.ui()) == 0);
}

TEST_CASE("of T_1 and T_2 one order takes the eye to the origin, and the other does not, as the lesson has it") {
  Lesson lesson = find_lesson("clipping");
  const Trace trace = run_lesson(lesson);
  const auto ways = ways_of_eye(trace.scene().camera, lesson.stops.at(3).orders);
  REQUIRE(ways.size() == 2);
  CHECK(glm::length(ways[0].back()) < 1e-9);
  CHECK(glm::length(ways[1].at(1) - glm::dvec3(0, 5, 0)) < 1e-9);
  CHECK(glm::length(ways[1].back() - glm::dvec3(-4, 2, 0)) < 1e-9);
  Camera level = trace.scene().camera;
  level.kind = Camera::Kind::orthographic;
  CHECK(ways_of_eye(level, {{1}}).empty());
}
