// Which pixels a polygon covers: the top-left rule, counted.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

// How often each pixel is reached by a polygon, whichever won.
std::vector<int> visits(const Scene& scene, const Conventions& conventions) {
  CollectRecorder record;
  const Picture picture = z_buffer::run(scene, conventions, record);
  std::vector<int> count(picture.polygon.size(), 0);
  for (const DepthCompare& compare : record.all<DepthCompare>()) ++count[picture.at(compare.x, compare.y)];
  return count;
}

int pixels(const Scene& scene, const Conventions& conventions = {}) {
  int sum = 0;
  for (const int count : visits(scene, conventions)) sum += count;
  return sum;
}

Conventions with(Conventions::Coverage coverage) {
  Conventions conventions;
  conventions.coverage = coverage;
  return conventions;
}

// A grid of points moved about at random, its cells cut into triangles: covers the raster without gap or overlap.
// `snap` puts points onto multiples of itself, so that edges run through pixel centres.
Scene random_triangulation(test::Numbers& random, std::int32_t raster, int cells, double snap) {
  Scene scene = test::screen_scene(raster, raster, {});
  const double low = -2, high = raster + 1;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      const double size = (high - low) / cells;
      double x = low + size * column, y = low + size * row;
      if (row > 0 && row < cells) y += random.between(-0.3, 0.3) * size;
      if (column > 0 && column < cells) x += random.between(-0.3, 0.3) * size;
      scene.points.push_back({std::round(x / snap) * snap, std::round(y / snap) * snap, random.between(0, 1)});
    }
  }
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const std::int32_t a = row * (cells + 1) + column, b = a + 1, c = a + cells + 1, d = c + 1;
      const bool down = random.engine() % 2 == 0;
      // Both ways round, and beginning anywhere.
      if (down) test::add_polygon(scene, {a, b, d}), test::add_polygon(scene, {a, d, c});
      else test::add_polygon(scene, {b, a, c}), test::add_polygon(scene, {c, b, d});
    }
  }
  return scene;
}

}  // namespace

TEST_SUITE("z_buffer/coverage") {
  TEST_CASE("Direct3D's examples of the top-left rule, pixel centres at integers") {
    CHECK(pixels(test::screen_scene(8, 8, {{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0}}})) == 25);
    CHECK(pixels(test::screen_scene(8, 8, {{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}}})) == 15);
    CHECK(pixels(test::screen_scene(8, 8, {{{0, 5, 0}, {0, 0, 0}, {5, 5, 0}}})) == 10);
  }

  TEST_CASE("inclusive coverage counts the right and lower edges too") {
    const Conventions inclusive = with(Conventions::Coverage::inclusive);
    CHECK(pixels(test::screen_scene(8, 8, {{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0}}}), inclusive) == 36);
    CHECK(pixels(test::screen_scene(8, 8, {{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}}}), inclusive) == 21);
    CHECK(pixels(test::screen_scene(8, 8, {{{0, 5, 0}, {0, 0, 0}, {5, 5, 0}}}), inclusive) == 21);
    // On the last row and column of the raster.
    CHECK(pixels(test::screen_scene(6, 6, {{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0}}}), inclusive) == 36);
    // A plateau below which the polygon goes on is no local maximum: (0,0)(6,0)(6,6)(3,6)(3,3)(0,3).
    CHECK(pixels(test::screen_scene(8, 8, {{{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {3, 6, 0}, {3, 3, 0}, {0, 3, 0}}}),
                 inclusive) == 3 * 7 + 4 * 4);
  }

  TEST_CASE("random triangulations: every pixel exactly once") {
    test::Numbers random(20260101);
    for (int run = 0; run < 60; ++run) {
      const double snap = run % 3 == 0 ? 1 : run % 3 == 1 ? 0.5 : 0x1p-30;
      const Scene scene = random_triangulation(random, 48, 2 + run % 9, snap);
      for (const auto interpolation : {Conventions::Interpolation::direct, Conventions::Interpolation::increments}) {
        Conventions conventions;
        conventions.interpolation = interpolation;
        const std::vector<int> count = visits(scene, conventions);
        CHECK(std::count(count.begin(), count.end(), 1) == 48 * 48);
      }
    }
  }

  TEST_CASE("inclusive coverage draws shared edges twice, which is why it is not the default") {
    test::Numbers random(20260101);
    const Scene scene = random_triangulation(random, 48, 6, 1);
    const std::vector<int> count = visits(scene, with(Conventions::Coverage::inclusive));
    CHECK(std::count(count.begin(), count.end(), 2) > 0);
  }

  TEST_CASE("a sampled pixel agrees with the even-odd rule, concave and self-intersecting polygons included") {
    test::Numbers random(20260101);
    for (int run = 0; run < 200; ++run) {
      std::vector<glm::dvec3> polygon;
      const int corners = 3 + run % 8;
      for (int i = 0; i < corners; ++i) polygon.push_back({random.between(-8, 40), random.between(-8, 40), 0});
      const std::vector<int> count = visits(test::screen_scene(32, 32, {polygon}), {});
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
          bool inside = false;
          for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
            const glm::dvec3 &p = polygon[i], &q = polygon[j];
            if ((p.y <= y) != (q.y <= y) && x >= p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y)) inside = !inside;
          }
          REQUIRE(count[static_cast<std::size_t>(y * 32 + x)] == static_cast<int>(inside));
        }
      }
    }
  }
}
