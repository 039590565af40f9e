// The naive painter's algorithm: right where z extents are apart, and wrong just where it is known to be.
#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/depth_sort/painter.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/depth_sort/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

struct Painted {
  std::vector<std::int32_t> order;  ///< polygons as they were drawn
  int wrong = 0;                    ///< pixels at which the Z-buffer shows another, not equally deep polygon
};

Painted paint(const Scene& scene, bool cull = false) {
  Conventions conventions;
  conventions.cull = cull;
  CollectRecorder record;
  const Picture picture = painter::run(scene, conventions, record);
  Painted painted;
  for (const PieceDraw& draw : record.all<PieceDraw>()) painted.order.push_back(draw.polygon);
  painted.wrong = wrong_pixels(scene, conventions, picture);
  return painted;
}

using Order = std::vector<std::int32_t>;

}  // namespace

TEST_SUITE("painter") {
  TEST_CASE("z extents apart: back to front, and right") {
    const Painted painted = paint(screen_scene(16, 16, {square(2, 2, 6, 3), square(4, 4, 6, 8), square(0, 5, 9, 5)}));
    CHECK(painted.order == Order{1, 2, 0});
    CHECK(painted.wrong == 0);
  }

  TEST_CASE("of equal farthest z the later in the file is drawn first, so that the earlier is seen") {
    const Painted painted = paint(screen_scene(16, 16, {square(2, 2, 6, 3), square(4, 4, 6, 3), square(0, 5, 9, 3)}));
    CHECK(painted.order == Order{2, 1, 0});
    CHECK(painted.wrong == 0);
  }

  TEST_CASE("a long polygon that slants past a small one: the farthest z says nothing about the place they share") {
    const Painted painted = paint(slanting_past());
    CHECK(painted.order == Order{0, 1});
    CHECK(painted.wrong == 9);  // the whole small one, which lies behind
  }

  TEST_CASE("it fails on polygons that intersect, and on those that overlap in a ring") {
    CHECK(paint(look_at_scene(load_scene("intersecting").scene, {})).wrong > 20);
    CHECK(paint(look_at_scene(load_scene("cyclic").scene, {})).wrong > 5);
    CHECK_FALSE(method("painter").exact);
  }

  TEST_CASE("one polygon, none, one without area") {
    CHECK(paint(screen_scene(8, 8, {square(2, 2, 4, 1)})).order == Order{0});
    CHECK(paint(screen_scene(8, 8, {})).order.empty());
    CHECK(paint(screen_scene(8, 8, {{{1, 1, 1}, {3, 3, 1}, {5, 5, 1}}})).order.empty());
  }
}
