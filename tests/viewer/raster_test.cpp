// How a raster is laid into a pane: as small as it must be, as large as numbers need.
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/panes/raster_pane.hpp"
#include "sim/viewer/panes/raster_words.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Raster raster_of(std::int32_t width, std::int32_t height) {
  Raster raster;
  raster.width = width, raster.height = height;
  return raster;
}

constexpr RasterInk ink{0xff000001, 0xff000002, 0xff000003, 0xff000004};
constexpr Pixel32 little = 0xff00ff00, much = 0xffff0000;

}  // namespace

TEST_CASE(
    "of counts a small picture shows the greatest under each pixel, in colours of the scale, of all else the mean") {
  for (const bool y_up : {false, true})
    for (const int box : {7, 33, 64, 99}) {
      Raster raster = raster_of(100, 100);
      raster.y_up = y_up;
      const RasterMap map(raster, {}, box, box);
      REQUIRE(map.cell < 1);
      for (int at = 0; at < 10'000; at += 37) {
        std::vector<Pixel32> cells(10'000, hatched_cell);
        std::vector<double> counts(10'000, std::nan(""));
        for (std::size_t i = 1; i < cells.size(); i += 2) cells[i] = little, counts[i] = 1;
        cells[static_cast<std::size_t>(at)] = much, counts[static_cast<std::size_t>(at)] = 5;
        Canvas canvas;
        canvas.resize(box, box);
        paint_raster(canvas, map, cells, ink, &counts);
        std::map<Pixel32, int> shown;
        for (int y = 0; y < box; ++y)
          for (int x = 0; x < box; ++x) ++shown[canvas.row(y)[x]];
        CAPTURE(box);
        CAPTURE(at);
        CHECK(shown[much] == 1);
        CHECK(shown[much] + shown[little] + shown[ink.hatch] + shown[ink.outside] == box * box);
        if (at % 370 != 0) continue;
        paint_raster(canvas, map, cells, ink);
        bool pure = false;
        for (int y = 0; y < box; ++y)
          for (int x = 0; x < box; ++x) pure = pure || canvas.row(y)[x] == much;
        CHECK((!pure || box > 50));
      }
    }
}

TEST_CASE("a number in a cell has two decimals, or all that it has, or is not there") {
  const auto ten_each = [](int decimals) { return 10.0 * (decimals + 2); };
  CHECK(decimals_that_fit(3, 60, ten_each) == 3);
  CHECK(decimals_that_fit(3, 40, ten_each) == 2);
  CHECK_FALSE(decimals_that_fit(3, 39, ten_each));
  CHECK_FALSE(decimals_that_fit(2, 39, ten_each));
  CHECK(decimals_that_fit(1, 30, ten_each) == 1);
  CHECK_FALSE(decimals_that_fit(1, 29, ten_each));
  CHECK(decimals_that_fit(0, 20, ten_each) == 0);
}

TEST_CASE("one may zoom until numbers in projector type fit the cells of a large raster, and no farther") {
  for (const Raster& raster : {raster_of(1024, 768), raster_of(640, 480), raster_of(4096, 4096)}) {
    RasterView view;
    view.zoom = most_zoom(raster);
    CHECK(RasterMap(raster, view, 300, 260).cell >= 64);
  }
  CHECK(most_zoom(raster_of(16, 16)) == 64);
  const Trace trace = test::record_run("delhi");
  App app(trace, nullptr, {}, 640, 480);
  for (int i = 0; i < 40; ++i) test::press(app, SDLK_z);
  CHECK(app.ui().view.zoom == most_zoom(trace.scene().raster));
  for (int i = 0; i < 40; ++i) test::press(app, SDLK_z, KMOD_LSHIFT);
  CHECK(app.ui().view.zoom == 1);
}

TEST_CASE("law: the letters of polygons are whole, however narrow the frame is: those that make room for others, too") {
  Lesson lesson = find_lesson("comparison");
  const Trace trace = run_lesson(lesson);
  for (const int width : {640, 800, 960, 1024, 1280, 1600, 1920})
    for (const bool presenter : {false, true}) {
      CAPTURE(width);
      CAPTURE(presenter);
      Settings settings;
      settings.presenter = presenter;
      App app(trace, &lesson, settings, width, width * 3 / 4);
      app.session().go_to(trace.size());
      app.settle();
      CHECK(test::cut_at_the_side(test::letters_of(app.ui().fonts)).empty());
    }
}
