// What is visible, where a scene from elsewhere holds numbers that lead nowhere.
#include <doctest/doctest.h>

#include <limits>

#include "sim/truth/truth.hpp"

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
