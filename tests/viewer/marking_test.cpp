// What a lesson asks to be marked by hand: by mouse, by keys, wrong, helped, right.
#include <doctest/doctest.h>

#include "sim/classroom/lesson.hpp"
#include "sim/classroom/marking.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// A lesson at its stop of this heading.
struct AtStop {
  Lesson lesson;
  Trace trace;
  App app;
  AtStop(const char* id, const std::string& heading)
      : lesson(find_lesson(id)), trace(run_lesson(lesson)), app(trace, &lesson, {}, 1280, 720) {
    for (std::size_t k = 0; k < lesson.stops.size(); ++k)
      if (lesson.stops[k].heading.find(heading) != std::string::npos) app.session().to_stop(static_cast<int>(k));
    REQUIRE(app.session().marking());
    app.settle();
  }
  bool done() {
    return app.session().marks().checked && judge_marks(*app.session().marking(), app.session().marks().made).done();
  }
  /// Moves the selection to the pixel, from where it is.
  void walk_to(Cell to) {
    if (!app.session().selected) test::press(app, SDLK_RIGHT, KMOD_LALT);
    REQUIRE(app.session().selected);
    for (int guard = 0; *app.session().selected != to && guard < 100; ++guard) {
      const Cell here = *app.session().selected;
      const bool up = app.session().scene().raster.y_up;
      test::press(app,
                  here.x < to.x           ? SDLK_RIGHT
                  : here.x > to.x         ? SDLK_LEFT
                  : (here.y < to.y) == up ? SDLK_UP
                                          : SDLK_DOWN,
                  KMOD_LALT);
    }
    REQUIRE(*app.session().selected == to);
  }
};

}  // namespace

TEST_CASE("pixels are marked by keys, a wrong one is said, a second press takes it away, and then it is right") {
  AtStop at("edge-table", "four crossings");
  const std::vector<std::int32_t> right = at.app.session().marking()->right;
  const int width = at.app.session().scene().raster.width;
  REQUIRE(right == std::vector<std::int32_t>{8 * width + 2, 8 * width + 3, 8 * width + 4, 8 * width + 9, 8 * width + 10,
                                             8 * width + 11, 8 * width + 12});
  const std::int64_t position = at.app.session().position();
  for (const std::int32_t pixel : right) {
    at.walk_to({pixel % width, pixel / width});
    test::press(at.app, SDLK_RETURN);
  }
  at.walk_to({5, 8});
  test::press(at.app, SDLK_RETURN);
  test::press(at.app, SDLK_RETURN, KMOD_LCTRL);
  CHECK(at.app.session().marks().checked);
  CHECK_FALSE(at.done());
  const test::Bytes wrong = test::picture(at.app);
  test::press(at.app, SDLK_RETURN);
  CHECK_FALSE(at.app.session().marks().checked);
  test::press(at.app, SDLK_RETURN, KMOD_LCTRL);
  CHECK(at.done());
  CHECK(test::picture(at.app) != wrong);
  CHECK(at.app.session().position() == position);
}

TEST_CASE("pixels are marked by clicks, and how they were marked does not change the picture") {
  AtStop at("edge-table", "four crossings"), by_keys("edge-table", "four crossings");
  const std::vector<std::int32_t> right = at.app.session().marking()->right;
  const int width = at.app.session().scene().raster.width;
  for (int y = 60; y < 500; y += 9)
    for (int x = 20; x < 440; x += 9) {
      test::move_mouse(at.app, x, y);
      const auto cell = at.app.ui().pointed;
      if (!cell) continue;
      const std::int32_t pixel = cell->y * width + cell->x;
      const auto& made = at.app.session().marks().made;
      if (std::find(right.begin(), right.end(), pixel) == right.end()) continue;
      if (std::find(made.begin(), made.end(), pixel) == made.end()) test::click(at.app, x, y);
    }
  REQUIRE(at.app.session().marks().made.size() == right.size());
  for (const std::int32_t pixel : at.app.session().marks().made) {
    by_keys.walk_to({pixel % width, pixel / width});
    test::press(by_keys.app, SDLK_RETURN);
  }
  for (AtStop* one : {&at, &by_keys}) {
    test::press(one->app, SDLK_RETURN, KMOD_LCTRL);
    CHECK(one->done());
    test::move_mouse(one->app, 1, 719);
    one->app.session().select({});
  }
  CHECK(test::picture(at.app) == test::picture(by_keys.app));
}

TEST_CASE("an edge is put into its bucket by a click on a scan line, another click moves the mark") {
  AtStop at("edge-table", "By hand: edge 4");
  CHECK(at.app.session().marking()->right == std::vector<std::int32_t>{7});
  at.app.session().mark(Cell{3, 9});
  at.app.session().mark(Cell{5, 7});
  CHECK(at.app.session().marks().made == std::vector<std::int32_t>{7});
  test::press(at.app, SDLK_RETURN, KMOD_LCTRL);
  CHECK(at.done());
}

TEST_CASE("an order is given by the keys of its polygons, with hints and what is right where they are asked for") {
  AtStop at("painter", "By hand");
  // K, L, W, T by number of their polygons: the choices 1, 2, 3 and 4.
  for (const SDL_Keycode key : {SDLK_3, SDLK_2}) test::press(at.app, key);
  test::press(at.app, SDLK_RETURN, KMOD_LCTRL);
  CHECK_FALSE(at.done());
  test::press(at.app, SDLK_2);
  for (const SDL_Keycode key : {SDLK_4, SDLK_2, SDLK_1}) test::press(at.app, key);
  test::press(at.app, SDLK_RETURN, KMOD_LCTRL);
  CHECK(at.done());

  AtStop helped("painter", "By hand");
  const std::size_t hints = helped.app.session().marking()->hints.size();
  for (std::size_t k = 0; k < hints; ++k) test::press(helped.app, SDLK_h, KMOD_LCTRL);
  CHECK(helped.app.session().marks().hints == hints);
  CHECK_FALSE(helped.app.session().marks().shown);
  test::press(helped.app, SDLK_h, KMOD_LCTRL);
  CHECK(helped.app.session().marks().shown);
}

TEST_CASE("marks stay with their stop, and where nothing is asked to be marked that is said") {
  AtStop at("worked-example", "By hand");
  at.app.session().mark(Cell{0, 2});
  const int stop = at.app.session().stop();
  at.app.session().next_stop(1);
  CHECK_FALSE(at.app.session().marking());
  test::press(at.app, SDLK_RETURN, KMOD_LCTRL);
  CHECK(at.app.session().message == "Nothing is asked to be marked here.");
  at.app.session().to_stop(stop);
  CHECK(at.app.session().marks().made.size() == 1);
}
