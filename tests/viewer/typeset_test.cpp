// Formulas set in type: a fraction is one wherever it can be made to fit.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/ranges.h>

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
    for (const auto& one : {std::pair(279, false), {400, true}}) {
      const auto width = one.first;
      const bool presenter = one.second;
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

namespace {

/// The words at which lines end: right of them nothing stands.
std::vector<std::string> ends_of_lines(const test::Letters& drawn) {
  std::vector<std::string> ends;
  for (std::size_t k = 0; k < drawn.all.size(); ++k) {
    const test::Letter& letter = drawn.all[k];
    if (k + 1 < drawn.all.size() && drawn.all[k + 1].word == letter.word) continue;
    const float middle = (letter.first.y + letter.last.y) / 2;
    if (std::ranges::none_of(drawn.all, [&](const test::Letter& other) {
          return other.first.x >= letter.last.x && other.first.y < middle + other.size / 2 &&
                 other.last.y > middle - other.size / 2;
        }))
      ends.push_back(drawn.words[letter.word]);
  }
  return ends;
}

}  // namespace

TEST_CASE("law: no line of a formula ends in an operator, and of several equations each stands on one line") {
  for (Lesson& lesson : all_lessons()) {
    CAPTURE(lesson.id);
    const Trace trace = run_lesson(lesson);
    App app(trace, nullptr, {}, 279, 720);  // the pane alone
    REQUIRE(app.show_only("happened"));
    for (const Stop& stop : lesson.stops) {
      CAPTURE(stop.position);
      app.session().go_to(stop.position);
      app.settle();
      for (std::string word : ends_of_lines(test::letters_of(app.ui().fonts))) {
        CAPTURE(word);
        while (word.ends_with(' ')) word.pop_back();
        for (const char* sign : {"+", "\u2212", "=", "\u2264", "<", ">"}) CHECK_FALSE(word.ends_with(sign));
      }
    }
  }
  Lesson lesson = find_lesson("scan-line");
  const Trace trace = run_lesson(lesson);
  App app(trace, nullptr, {}, 150, 720);
  REQUIRE(app.show_only("happened"));
  app.session().go_to(lesson.stops[2].position);  // A, B, C and D of a plane
  app.settle();
  const std::vector<std::string> ends = ends_of_lines(test::letters_of(app.ui().fonts));
  for (const char* end : {"A = 0.2425, B = 0,", "C = \u22120.9701,", "D = \u22121.2127"}) {
    CAPTURE(fmt::to_string(fmt::join(ends, "|")));
    CHECK(std::ranges::find(ends, end) != ends.end());
  }
}
