// The bar at the top: what there is room for, and what tells most the longest.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/window.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

const TitleMeasures& by_bytes() {
  static const TitleMeasures measures{
      [](const std::string& text) { return static_cast<float>(text.size()); },
      [](const std::string& text, float room) { return text.substr(0, static_cast<std::size_t>(room) - 3) + "\u2026"; },
      6};
  return measures;
}

std::string fitted_names(const std::vector<TitleName>& names, int room) {
  return joined_names(names_that_fit(names, static_cast<float>(room), by_bytes()));
}

}  // namespace

TEST_CASE("names go one by one, the least telling first, the most telling is cut before it goes") {
  const std::vector<TitleName> names{{"zstep"}, {"Hidden lines: cut each edge", 3}, {"Hidden lines", 2}, {"box", 1}};
  CHECK(fitted_names(names, 99) == "zstep \u00b7 Hidden lines: cut each edge \u00b7 Hidden lines \u00b7 box");
  CHECK(fitted_names(names, 55) == "Hidden lines: cut each edge \u00b7 Hidden lines \u00b7 box");
  CHECK(fitted_names(names, 45) == "Hidden lines: cut each edge \u00b7 Hidden lines");
  CHECK(fitted_names(names, 27) == "Hidden lines: cut each edge");
  CHECK(fitted_names(names, 20) == "Hidden lines: cut\u2026");
  CHECK(fitted_names(names, 5) == "");
  const std::vector<TitleName> runs{{"zstep"}, {"The Z-buffer", 3}, {"A: x.ztrace", 4}, {"B: much_longer.ztrace", 4}};
  CHECK(fitted_names(runs, 36) == "A: x.ztrace \u00b7 B: much_longer.ztrace");
  CHECK(fitted_names(runs, 30) == "A: x.ztrace \u00b7 B: much_long\u2026");
}

TEST_CASE("law: at the end of every lesson its title, or most of it, stands at the top, in a window of any size") {
  struct Window {
    int width, height;
    bool presenter;
  };
  for (Lesson& lesson : all_lessons()) {
    CAPTURE(lesson.id);
    const Trace trace = run_lesson(lesson);
    for (const auto& [width, height, presenter] :
         {Window{800, 600, false}, Window{1280, 720, false}, Window{1280, 720, true}, Window{1920, 1080, true}}) {
      CAPTURE(width);
      CAPTURE(presenter);
      Settings settings;
      settings.presenter = presenter;
      App app(trace, &lesson, settings, width, height);
      app.offer([] { return std::vector<Offer>{}; });
      for (const std::int64_t step : {std::int64_t{0}, trace.size() / 2, trace.size()}) {
        app.session().go_to(step);
        app.settle();
        const test::Letters drawn = test::letters_of(app.ui().fonts);
        const std::string begins = lesson.title.substr(0, std::min<std::size_t>(lesson.title.size(), 12));
        CHECK(std::any_of(drawn.all.begin(), drawn.all.end(), [&](const test::Letter& letter) {
          return letter.last.y < 40 && drawn.words[letter.word].find(begins) != std::string::npos;
        }));
      }
    }
  }
}
