// Laws of what is read: at every stop of every lesson, in windows of every size and in every look, no word is cut or
// covered, none stands on another, none is small or faint. Measured from what is drawn.
#include <cstdlib>

#include <doctest/doctest.h>
#include <fmt/ranges.h>

#include "sim/classroom/lesson.hpp"
#include "tests/viewer/drawer_pages.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/with_mistake.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

constexpr std::pair<int, int> sizes_of_window[] = {{1280, 720}, {1600, 900}, {1920, 1080}, {3840, 2160}};
enum class Dress { light, dark, presenter };

/// `covers`: what lies over the panes for a moment may.
void check_read(App& app, bool covers = false) {
  app.settle();
  const test::Letters drawn = test::letters_of(app.ui().fonts);
  CHECK(drawn.all.size() > 100);
  const auto none = [](const char* what, const std::vector<std::string>& found) {
    INFO(what, ": ", fmt::format("{}", fmt::join(found, "; ")));
    CHECK(found.empty());
  };
  none("cut", test::cut_at_the_side(drawn));
  if (!covers) none("covered", drawn.covered);
  none("over each other", test::over_each_other(drawn));
  none("small", test::smaller_than(drawn, 13));
  none("faint", test::faint(app, drawn));
}

/// With each page of the drawer.
void check_drawer_read(App& app) {
  const Cell cell = test::a_drawn_pixel(app);
  for (const Drawer page : test::all_pages()) {
    CAPTURE(static_cast<int>(page));
    test::open_page(app, page, cell);
    check_read(app);
    app.open(Drawer::none);
  }
}

/// Each stop in one size, seldom in the largest; with ZSTEP_ALL_SIZES set in all of them, which takes six times as
/// long.
void check_stops(Dress dress) {
  const bool all = std::getenv("ZSTEP_ALL_SIZES") != nullptr;
  Settings settings;
  settings.dark = dress == Dress::dark, settings.presenter = dress == Dress::presenter;
  constexpr int turns[] = {0, 1, 2, 0, 1, 2, 3};
  int turn = 2 * static_cast<int>(dress);
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    CAPTURE(lesson.id);
    const int stops = static_cast<int>(lesson.stops.size());
    for (int n = 0; n < 4; ++n) {
      const auto [width, height] = sizes_of_window[n];
      CAPTURE(width);
      App app(trace, &lesson, settings, width, height);
      for (int stop = 0; stop < stops; ++stop) {
        if (!all && turns[(stop + turn) % 7] != n) continue;
        app.session().to_stop(stop);
        CAPTURE(stop);
        CAPTURE(app.session().position());
        check_read(app);
      }
    }
    ++turn;
  }
}

}  // namespace

TEST_CASE("law: all that stands in a light window is read, at the stops of every lesson") { check_stops(Dress::light); }
TEST_CASE("law: all that stands in a dark window is read, at the stops of every lesson") { check_stops(Dress::dark); }
TEST_CASE("law: all that stands before a class is read, at the stops of every lesson") {
  check_stops(Dress::presenter);
}
TEST_CASE("law: all that stands in a window as small as a phone's is read, at the stops of every lesson") {
  int turn = 0;
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);
    CAPTURE(lesson.id);
    for (const auto& [width, height] : {std::pair{390, 844}, {844, 390}}) {
      CAPTURE(width);
      Settings settings;
      settings.dark = ++turn % 2 == 0;
      App app(trace, &lesson, settings, width, height);
      // Each stop upright or on its side, and the step after it, where the lesson does not speak.
      for (int stop = width < height ? 0 : 1; stop < static_cast<int>(lesson.stops.size()); stop += 2) {
        app.session().to_stop(stop);
        CAPTURE(stop);
        check_read(app);
        if (stop % 4 > 1 || app.session().question_open()) continue;
        app.session().move(Unit::event, 1);
        check_read(app);
      }
    }
  }
}
TEST_CASE("law: all that is asked is read in the drawer") {
  Lesson lesson = find_lesson("z-buffer");
  const Trace trace = run_lesson(lesson);
  int turn = 0;
  for (const Dress dress : {Dress::light, Dress::dark, Dress::presenter})
    for (const auto& [width, height] : sizes_of_window) {
      if (++turn % 2 == 0 && width == 3840) continue;  // the largest takes longest
      CAPTURE(static_cast<int>(dress));
      CAPTURE(width);
      Settings settings;
      settings.dark = dress == Dress::dark, settings.presenter = dress == Dress::presenter;
      App app(trace, turn % 2 == 0 ? nullptr : &lesson, settings, width, height);
      app.session().go_to(867);
      check_drawer_read(app);
    }
}
TEST_CASE("law: all that stands in a window with two runs is read") {
  const Trace trace = test::record_run("pyramid-behind");
  const Trace wrong = test::with_mistake(trace, "\"nearer\":true", "\"nearer\":false");
  const diff::DiffReport report = diff::compare(wrong, trace);
  const AgainstRun both{&trace, &report, true};
  int turn = 0;
  for (const Dress dress : {Dress::light, Dress::dark, Dress::presenter})
    for (const auto& [width, height] : sizes_of_window) {
      if (++turn % 2 == 0 && width == 3840) continue;
      CAPTURE(static_cast<int>(dress));
      CAPTURE(width);
      Settings settings;
      settings.dark = dress == Dress::dark, settings.presenter = dress == Dress::presenter;
      App app(wrong, nullptr, settings, width, height);
      app.show_against(both);
      for (const std::int64_t step : {std::int64_t{0}, report.causes.front().first.a, wrong.size() / 2, wrong.size()}) {
        CAPTURE(step);
        app.session().go_to(step);
        check_read(app);
      }
    }
}
TEST_CASE("law: all that stands on the start page, and all that Ctrl+P finds, is read") {
  const Trace trace = test::record_run("pyramid");
  const auto offers = [] {
    std::vector<Offer> all;
    for (const Lesson& lesson : all_lessons())
      all.push_back({Offer::What::lesson,
                     lesson.id,
                     lesson.title,
                     lesson.summary,
                     static_cast<int>(lesson.stops.size()),
                     static_cast<int>(all.size()) + 1,
                     {},
                     lesson.theme,
                     reading_minutes(lesson)});
    for (const Method& one : methods())
      all.push_back({Offer::What::method, std::string(one.id), std::string(one.title), std::string(one.paper)});
    all.push_back({Offer::What::scene, "cube", "a cube", "six faces", 0, 0, {2, 1, {200, 0, 0, 0, 0, 200}}});
    return all;
  };
  for (const Dress dress : {Dress::light, Dress::dark, Dress::presenter})
    for (const auto& [width, height] : {std::pair{390, 844}, {640, 360}, {1280, 720}, {1600, 900}, {1920, 1080}}) {
      CAPTURE(static_cast<int>(dress));
      CAPTURE(width);
      Settings settings;
      settings.dark = dress == Dress::dark, settings.presenter = dress == Dress::presenter;
      settings.see_stop("bsp", 3), settings.see_stop("z-buffer", 1000);
      App app(trace, nullptr, settings, width, height);
      app.offer(offers);
      app.open_start();
      check_read(app, true);
      app.put("/usr/");
      check_read(app, true);
      app.open(Overlay::palette);
      app.put("z");
      check_read(app, true);
    }
}
TEST_CASE("law: all that is asked on a phone is read") {
  Lesson lesson = find_lesson("z-buffer");
  const Trace trace = run_lesson(lesson);
  for (const auto& [width, height] : {std::pair{390, 844}, {844, 390}}) {
    CAPTURE(width);
    App app(trace, &lesson, {}, width, height);
    app.session().go_to(867);
    check_drawer_read(app);
    for (const Overlay overlay : {Overlay::menu, Overlay::settings, Overlay::palette, Overlay::go_to}) {
      CAPTURE(static_cast<int>(overlay));
      app.open(overlay);
      check_read(app, true);
      app.open(Overlay::none);
    }
  }
}
