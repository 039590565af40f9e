// What is visible, where a scene from elsewhere holds numbers that lead nowhere.
#include <doctest/doctest.h>

#include <limits>

#include "sim/truth/sight.hpp"
#include "sim/truth/truth.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;

namespace {

/// How many pixels the polygons of a scene are candidates of.
int pixels_of(const Scene& scene) {
  const compare::Truth truth(scene, false);
  int pixels = 0;
  for (std::int32_t y = 0; y < scene.raster.height; ++y)
    for (std::int32_t x = 0; x < scene.raster.width; ++x) pixels += truth.at(x, y).empty() ? 0 : 1;
  return pixels;
}

/// A triangle in screen coordinates, as a program may write it that has no camera.
Scene triangle(double x) {
  Scene scene;
  scene.points = {{x, 0, 5}, {7, 0, 5}, {0, 7, 5}};
  scene.polygons = {{"A", {}, 0}};
  scene.facets = {{0, 0, 3}};
  scene.corners = {0, 1, 2};
  scene.camera.kind = Camera::Kind::screen;
  scene.raster = {8, 8, false};
  return scene;
}

}  // namespace

TEST_CASE("a polygon with a place that is no number is seen nowhere") {
  CHECK(pixels_of(triangle(0)) > 0);
  CHECK(pixels_of(triangle(std::numeric_limits<double>::quiet_NaN())) == 0);
  CHECK(pixels_of(triangle(std::numeric_limits<double>::infinity())) == 0);
}

TEST_CASE("a facet is in a pixel's square where it covers some of it, and not where it touches it") {
  const auto in_square = [](const std::vector<glm::dvec3>& corners) {
    const auto at = compare::facet_at(test::screen_scene(16, 16, {corners}), 0, false, 5, 5);
    REQUIRE(at);
    CHECK(!at->candidate.covers);
    return at->in_square;
  };
  CHECK(!in_square({{5.5, 5.5, 1}, {12, 5.5, 1}, {12, 12, 1}}));  // in a corner
  CHECK(!in_square({{5.5, 2, 1}, {12, 6, 1}, {5.5, 12, 1}}));     // along a side
  CHECK(!in_square({{5, 6, 1}, {10, 1, 1}, {12, 12, 1}}));        // an edge through a corner
  CHECK(in_square({{5.25, 5.5, 1}, {12, 5.25, 1}, {12, 12, 1}}));
  CHECK(in_square({{5.25, 2, 1}, {12, 6, 1}, {5.25, 12, 1}}));
  CHECK(in_square({{5.25, 5.25, 1}, {5.375, 5.25, 1}, {5.25, 5.375, 1}}));  // wholly inside it
}
