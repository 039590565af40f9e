// The canonical view volume: the scene after the division by w.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/description.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/words/explain.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// Corners of what is left of a polygon there.
int corners_of(const Scene& cube, const std::string& name) {
  int count = 0;
  for (const Facet& facet : cube.facets)
    if (polygon_label(cube, facet.polygon) == name) count += facet.corner_count;
  return count;
}

}  // namespace

TEST_CASE("of the lesson on clipping the cube has what clipping leaves: nothing of O and N, S cut at the near plane") {
  Lesson lesson = find_lesson("clipping");
  const Trace trace = run_lesson(lesson);
  const Scene cube = in_canonical_volume(trace.scene());
  const std::map<std::string, int> left{{"I", 3}, {"K", 4}, {"O", 0}, {"Q", 5}, {"S", 4}, {"N", 0}};
  for (const auto& one : left) CHECK_MESSAGE(corners_of(cube, one.first) == one.second, one.first);
  CHECK(cube.points.at(0) == glm::dvec3(-0.125, 0.875, 0.125));
  App app(trace, &lesson, {}, 1280, 720);
  app.session().to_stop(6);
  CHECK(describe_step(app).find("Polygon S: ") != std::string::npos);
  CHECK(app.lead() == "canonical");
  const test::Bytes shown = test::picture(app);
  app.set_lead("scene");
  CHECK(test::picture(app) != shown);
}

TEST_CASE("law: of every lesson's run, whatever its camera, all that is in the cube lies within it, and is drawn") {
  int perspective = 0, parallel = 0, screen = 0;
  for (Lesson& lesson : all_lessons()) {
    CAPTURE(lesson.id);
    const Trace trace = run_lesson(lesson);
    const Scene cube = in_canonical_volume(trace.scene());
    for (const glm::dvec3& point : cube.points)
      for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(point[axis]) <= 1 + 1e-9);
    const Camera::Kind kind = trace.scene().camera.kind;
    ++(kind == Camera::Kind::perspective ? perspective : kind == Camera::Kind::orthographic ? parallel : screen);
    CHECK(cube.points.empty() == (kind == Camera::Kind::screen));
    App app(trace, nullptr, {}, 1280, 720);
    app.set_lead("canonical");
    for (const std::int64_t step : {std::int64_t{0}, trace.size() / 3, trace.size()}) {
      app.session().go_to(step);
      test::picture(app);
    }
  }
  CHECK((perspective > 0 && parallel > 0 && screen > 0));
}

TEST_CASE(
    "the scene says of K's vertices which are in and which are out, and names r and v where the stop labels them") {
  const auto words_at = [](const char* name, int stop) {
    Lesson lesson = find_lesson(name);
    const Trace trace = run_lesson(lesson);
    App app(trace, &lesson, {}, 1280, 720);
    app.session().to_stop(stop);
    test::picture(app);
    return test::letters_of(app.ui().fonts).words;
  };
  const auto has = [](const std::vector<std::string>& words, const std::string& word) {
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& one) { return one.find(word) != std::string::npos; });
  };
  const auto words = words_at("clipping", 15);
  for (const char* shown : {"6 in", "7 out", "8 out", "9 in"}) CHECK_MESSAGE(has(words, shown), shown);
  CHECK_FALSE(has(words_at("clipping", 10), "0 in"));  // I is wholly inside
  const auto light = words_at("light-at-vertices", 5), before = words_at("light-at-vertices", 4);
  const auto named = [](const std::vector<std::string>& all, const char* word) {
    return std::count(all.begin(), all.end(), word) > 0;
  };
  CHECK((named(light, "r") && named(light, "v")));
  CHECK((!named(before, "r") && named(before, "v")));
}
