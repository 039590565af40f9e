// Formulas set in type: a fraction is one wherever it can be made to fit.
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "sim/classroom/lesson.hpp"
#include "sim/words/explain.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// What is drawn of a fraction that stands on one line, or nothing. What is set in type has no "_" either.
std::string fraction_on_one_line(App& app) {
  app.settle();
  for (const std::string& word : test::letters_of(app.ui().fonts).words)
    for (const char* sign : {")/", "/(", "(x_", "(y_", "(z_"})
      if (word.find(sign) != std::string::npos) return word;
  return "";
}

}  // namespace

TEST_CASE(
    "law: long fractions are set as fractions, and on one line only where the pane is narrower than a few words") {
  for (const char* id : {"hidden-line", "plane-slopes", "viewing"}) {
    CAPTURE(id);
    Lesson lesson = find_lesson(id);
    const Trace trace = run_lesson(lesson);
    for (const auto& [width, presenter] : {std::pair(279, false), {400, true}}) {
      CAPTURE(width);
      CAPTURE(presenter);
      Settings settings;
      settings.presenter = presenter;
      App app(trace, nullptr, settings, width, 720);  // the pane alone
      REQUIRE(app.show_only("happened"));
      for (const Stop& stop : lesson.stops) {
        CAPTURE(stop.position);
        app.session().go_to(stop.position);
        CHECK(fraction_on_one_line(app) == "");
      }
    }
  }
  // Stacked higher than five lines nobody reads it as one.
  Lesson narrow = find_lesson("hidden-line");
  const Trace trace = run_lesson(narrow);
  App app(trace, nullptr, Settings{}, 173, 720);
  REQUIRE(app.show_only("happened"));
  app.session().go_to(115);
  CHECK(fraction_on_one_line(app) != "");
}
