// Input that is no picture of anything has a stated outcome, and never a crash.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

struct Outcome {
  std::vector<Reject> rejects;
  std::int64_t pixels = 0;
};

Outcome draw(const Scene& scene, Conventions conventions = {}) {
  CollectRecorder record;
  conventions.cull = false;
  const Picture picture = z_buffer::run(scene, conventions, record);
  Outcome outcome;
  for (const PolygonReject& reject : record.all<PolygonReject>()) outcome.rejects.push_back(reject.reason);
  outcome.pixels = static_cast<std::int64_t>(picture.polygon.size()) -
                   std::count(picture.polygon.begin(), picture.polygon.end(), no_polygon);
  return outcome;
}

Outcome draw_viewed(const std::vector<glm::dvec3>& points) {
  Scene scene;
  test::add_polygon(scene, points);
  test::look(scene, Camera::Kind::perspective, 4, 0, 90, 1, 10);
  return draw(scene);
}

using Rejects = std::vector<Reject>;

}  // namespace

TEST_SUITE("z_buffer/degenerate") {
  TEST_CASE("in space: no area, no finite number, too few corners") {
    const glm::dvec3 a(0, 0, 0), b(0, 1, 0), c(0, 0, 1);
    CHECK(draw_viewed({a, b, c}).rejects.empty());
    CHECK(draw_viewed({a, b}).rejects == Rejects{Reject::degenerate});
    CHECK(draw_viewed({}).rejects == Rejects{Reject::degenerate});
    CHECK(draw_viewed({a, a, a}).rejects == Rejects{Reject::degenerate});
    CHECK(draw_viewed({a, b, b * 2.0}).rejects == Rejects{Reject::degenerate});
    CHECK(draw_viewed({a, b, c, b}).rejects == Rejects{Reject::degenerate});
    for (const double bad : {not_a_number, infinite, -infinite, 1e200, std::numeric_limits<double>::max()}) {
      CHECK(draw_viewed({a, b, {0, bad, 1}}).rejects.size() == 1);
      CHECK(draw_viewed({{bad, bad, bad}, b, c}).rejects.size() == 1);
    }
    CHECK(draw_viewed({a, {1, 0, 0}, {-1, 0, 1}}).rejects == Rejects{Reject::edge_on});
    CHECK(draw_viewed({{5, 0, 0}, {6, 1, 0}, {7, 0, 1}}).rejects == Rejects{Reject::outside});  // behind the eye
  }

  TEST_CASE("a huge polygon is clipped to the picture") {
    CHECK(draw_viewed({{0, -1e6, -1e6}, {0, 1e6, -1e6}, {0, 0, 1e6}}).pixels == 64 * 64);
  }

  TEST_CASE("a repeated corner changes nothing") {
    const auto pixels = draw_viewed({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}).pixels;
    CHECK(pixels > 0);
    CHECK(draw_viewed({{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}}).pixels == pixels);
  }

  TEST_CASE("on the raster: limited to it, and what is no number is dropped") {
    for (const auto coverage : {Conventions::Coverage::top_left, Conventions::Coverage::inclusive}) {
      Conventions conventions;
      conventions.coverage = coverage;
      const auto on_raster = [&](const std::vector<glm::dvec3>& points) {
        return draw(test::screen_scene(8, 8, {points}), conventions);
      };
      CHECK(on_raster({{-100, -100, 0}, {100, -100, 0}, {100, 100, 0}, {-100, 100, 0}}).pixels == 64);
      CHECK(on_raster({{-1e8, -1e8, 0}, {1e8, -1e8, 0}, {1e8, 1e8, 0}, {-1e8, 1e8, 0}}).pixels == 64);
      CHECK(on_raster({{20, 0, 0}, {30, 0, 0}, {25, 9, 0}}).pixels == 0);
      CHECK(on_raster({{-20, 0, 0}, {-30, 0, 0}, {-25, 9, 0}}).pixels == 0);
      CHECK(on_raster({{0, 20, 0}, {5, 30, 0}, {9, 25, 0}}).pixels == 0);
      CHECK(on_raster({{0, -20, 0}, {5, -30, 0}, {9, -25, 0}}).pixels == 0);
      for (const double bad : {not_a_number, infinite, -infinite, 1e300}) {
        CHECK(on_raster({{0, 0, 0}, {5, 0, 0}, {bad, 5, 0}}).rejects == Rejects{Reject::degenerate});
        CHECK(on_raster({{0, 0, 0}, {5, 0, 0}, {5, bad, 0}}).rejects == Rejects{Reject::degenerate});
      }
      CHECK(on_raster({{0, 0, not_a_number}, {5, 0, 0}, {5, 5, 0}}).rejects == Rejects{Reject::degenerate});
      CHECK(on_raster({{0, 0, 0}, {5, 5, 0}}).rejects == Rejects{Reject::degenerate});
    }
  }

  TEST_CASE("edges shorter than any number, and polygons of no height") {
    for (const double tiny : {1e-320, 1e-300, 1e-16}) {
      CHECK(draw(test::screen_scene(8, 8, {{{0, -tiny, 0}, {8, tiny, 0}, {4, tiny / 2, 1}}})).rejects.empty());
      CHECK(draw(test::screen_scene(8, 8, {{{3 - tiny, 0, 0}, {3 + tiny, 0, 0}, {3, 8, 1}}})).rejects.empty());
    }
    CHECK(draw(test::screen_scene(8, 8, {{{0, 3, 0}, {4, 3, 0}, {8, 3, 0}}})).pixels == 0);
    CHECK(draw(test::screen_scene(8, 8, {{{3, 0, 0}, {3, 4, 0}, {3, 8, 0}}})).pixels == 0);
  }

  TEST_CASE("depths too far apart to subtract draw nothing where they have no difference, and do no harm") {
    CHECK(draw(test::screen_scene(8, 8, {{{0, 0, -1.7e308}, {8, 0, 1.7e308}, {8, 8, 1.7e308}}})).rejects.empty());
  }

  TEST_CASE("a scene without polygons, and a raster without pixels") {
    CHECK(draw(test::screen_scene(8, 8, {})).pixels == 0);
    CHECK(draw(test::screen_scene(0, 0, {{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}}})).pixels == 0);
  }
}
