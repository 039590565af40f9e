// The depth buffer as a relief: heights, colours, the floor, blocks of large buffers, and what the mouse finds there.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "sim/viewer/panes/relief.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

constexpr Color floor_color{1, 2, 3};

Room relief(const Trace& trace, const Picture& picture) {
  return relief_of(picture, trace.scene().raster, depth_range(trace), DepthScale(), floor_color);
}

/// How high the top of a column lies.
double top_of(const Room& room, std::int32_t column) {
  for (const Facet& facet : room.polygons().facets)
    if (facet.polygon == 3 * column)
      return room.polygons()
          .points[static_cast<std::size_t>(room.polygons().corners[static_cast<std::size_t>(facet.first_corner)])]
          .z;
  return std::nan("");
}

}  // namespace

TEST_CASE("law: of two pixels the nearer stands higher, and infinity is the floor") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size());
  const Picture& picture = app.session().picture();
  const Room room = relief(trace, picture);
  const DepthRange range = depth_range(trace);
  int compared = 0, floor = 0;
  for (std::int32_t k = 0; k < 625; ++k) {
    const double a = picture.depth[static_cast<std::size_t>(k)],
                 b = picture.depth[static_cast<std::size_t>((k * 7 + 3) % 625)];
    const double high = top_of(room, k), other = top_of(room, (k * 7 + 3) % 625);
    if (!std::isfinite(a)) {
      ++floor;
      CHECK(high == 0);
      CHECK(room.polygons().polygons[static_cast<std::size_t>(3 * k)].color.red <= floor_color.red);
      continue;
    }
    CHECK(high > 0);
    if (!std::isfinite(b)) continue;
    const double near = std::clamp(range.share(a), 0.0, 1.0), far = std::clamp(range.share(b), 0.0, 1.0);
    if (std::abs(near - far) < 1e-12) continue;
    ++compared;
    CHECK((high > other) == (near < far));
  }
  CHECK(compared > 20);
  CHECK(floor > 50);
}

TEST_CASE("law: a large buffer has a column for each block, as high as the nearest pixel in it") {
  std::mt19937 random(3);
  Raster raster{200, 130, false};
  CHECK(relief_block(raster) == 4);
  CHECK(relief_block({64, 64, false}) == 1);
  CHECK(relief_block({65, 10, false}) == 2);
  Picture picture(raster.width, raster.height);
  for (double& depth : picture.depth)
    depth = random() % 3 == 0 ? std::uniform_real_distribution<double>(0, 1)(random)
                              : std::numeric_limits<double>::infinity();
  DepthRange range;
  range.near = 0, range.far = 1, range.known = true;
  const Room room = relief_of(picture, raster, range, DepthScale(), floor_color);
  for (std::int32_t k = 0; k < 50 * 33; k += 17) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::int32_t y = k / 50 * 4; y < std::min(k / 50 * 4 + 4, 130); ++y)
      for (std::int32_t x = k % 50 * 4; x < k % 50 * 4 + 4; ++x)
        nearest = std::min(nearest, picture.depth[picture.at(x, y)]);
    CAPTURE(k);
    CHECK(top_of(room, k) == doctest::Approx(std::isfinite(nearest) ? 0.35 * 50 * (1 - 0.92 * nearest) : 0));
  }
}

TEST_CASE("the relief comes and goes by its key, turns with the mouse, and its steps are told apart") {
  const Trace trace = test::record_run("pyramid", test::of_size(25, 25));
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size() / 2);
  app.set_lead("depth");
  const test::Bytes flat = test::picture(app);
  test::press(app, SDLK_d, KMOD_LSHIFT);
  const test::Bytes relief = test::picture(app);
  CHECK(relief != flat);
  const State before = app.session().state();
  const int x = 640, y = 300;
  test::move_mouse(app, x, y);
  test::mouse_button(app, x, y, true);
  test::move_mouse(app, x + 80, y + 20);
  test::mouse_button(app, x + 80, y + 20, false);
  CHECK(app.ui().relief_look.turn != 0);
  CHECK_FALSE(app.session().selected);  // a drag selects nothing
  test::move_mouse(app, 1, 1);
  CHECK(test::picture(app) != relief);
  CHECK(app.session().state() == before);
  app.ui().relief_look = {};
  app.session().go_to(trace.size());
  CHECK(test::picture(app) != relief);
  app.session().go_to(trace.size() / 2);
  CHECK(test::picture(app) == relief);
  test::click(app, x, y);
  CHECK(app.session().selected);
  app.session().selected.reset();
  test::move_mouse(app, 1, 1);
  test::press(app, SDLK_d, KMOD_LSHIFT);
  test::press(app, SDLK_ESCAPE);
  CHECK_FALSE(app.ui().relief);
}
