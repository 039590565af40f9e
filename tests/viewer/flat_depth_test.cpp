// What is said of the depth buffer and of the edge table where all polygons are equally deep, or one edge is all.
#include <algorithm>

#include <doctest/doctest.h>

#include "sim/classroom/lesson.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"

using namespace zstep;
using namespace zstep::viewer;

TEST_CASE("where all polygons have one depth the legend says what hatched pixels hold, and one edge is one edge") {
  Lesson lesson = find_lesson("edge-table");
  const Trace trace = run_lesson(lesson);
  App app(trace, &lesson, {}, 1280, 720);
  const auto is_drawn = [&](const std::string& text) {
    test::picture(app);
    const std::vector<std::string> words = test::letters_of(app.ui().fonts).words;
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return word == text; });
  };
  app.session().to_stop(1);
  app.set_lead("depth");
  CHECK(is_drawn("every depth is 0 or \u221e"));
  CHECK_FALSE(is_drawn("every depth is 0"));
  app.session().to_stop(2);
  REQUIRE(app.session().state().machine.edge_table.size() == 1);
  CHECK(is_drawn("1 edge"));
  app.session().to_stop(3);
  CHECK_FALSE(is_drawn("1 edges"));
}
