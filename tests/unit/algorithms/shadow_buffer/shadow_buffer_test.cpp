// The shadow buffer: a square that floats over a floor, under a lamp.
#include <doctest/doctest.h>

#include <cmath>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/shadow_buffer/shadow_buffer.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/error.hpp"
#include "traces/record/all_recorders.hpp"

using namespace zstep;

namespace {

/// A floor of 4 x 4 and, one unit above it, a square of 1 x 1; the lamp hangs 6 above the middle.
Scene floor_and_square(std::int32_t side) {
  Scene scene;
  test::add_polygon(scene, {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  test::add_polygon(scene, {{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0.5, 0.5, 1}, {-0.5, 0.5, 1}});
  scene.polygons[0].color = {200, 100, 50};
  scene.polygons[1].color = {10, 20, 30};
  test::look(scene, Camera::Kind::perspective, 8, 10, 40, 1, 20);
  scene.camera.window = 0.4;
  scene.raster = {side, side, false};
  scene.light = Light{{0, 0, 6}, {0, 0, 0}, 0.6, 1, 10};
  return scene;
}

Conventions with_bias(const char* bias) {
  Conventions conventions;
  conventions.options["bias"] = bias;
  return conventions;
}

std::int64_t dark_pixels(const Picture& picture) {
  std::int64_t count = 0;
  for (const std::uint32_t ink : picture.ink) count += ink != no_ink;
  return count;
}

}  // namespace

TEST_SUITE("shadow buffer") {
  TEST_CASE(
      "the square's shadow is where the rays through its corners meet the floor, to a pixel of the light's picture") {
    const Scene scene = floor_and_square(64);
    CollectRecorder record;
    const Picture picture = shadow_buffer::run(scene, Conventions{}, record);
    // From 6 above, a square of half a side 0.5 at height 1 shades the floor up to 0.5 * 6/5; a pixel of the light's
    // picture is 2 * 0.6 * 6 / 64 wide there.
    const double edge = 0.6, pixel = 2 * 0.6 * 6 / 64;
    std::int64_t dark = 0, lit = 0;
    for (const ShadowCompare& compare : record.all<ShadowCompare>()) {
      if (picture.polygon[picture.at(compare.x, compare.y)] != 0) continue;
      // The light's picture is seen from above, its rows along one axis of the floor and its columns along the other.
      const double across = std::abs(compare.x_light - 31.5) * pixel, along = std::abs(compare.y_light - 31.5) * pixel;
      const double outside = std::max(across, along) - edge;
      if (outside > pixel) CHECK(compare.lit);
      if (outside < -pixel) CHECK_FALSE(compare.lit);
      ++(compare.lit ? lit : dark);
    }
    CHECK(dark > 60);
    CHECK(lit > 500);
  }

  TEST_CASE("in shadow a polygon keeps four tenths of its colour, and the lit ones their own") {
    const Scene scene = floor_and_square(32);
    NullRecorder nothing;
    const Picture picture = shadow_buffer::run(scene, Conventions{}, nothing);
    std::int64_t dark = 0;
    for (std::size_t pixel = 0; pixel < picture.ink.size(); ++pixel) {
      if (picture.ink[pixel] == no_ink) continue;
      ++dark;
      CHECK(picture.polygon[pixel] == 0);  // nothing lies over the square
      CHECK(color_of(picture.ink[pixel]) == Color{80, 40, 20});
    }
    CHECK(dark > 20);
  }

  TEST_CASE("polygons and depths are the Z-buffer's, and the light's picture is that of the Z-buffer at the light") {
    const Scene scene = floor_and_square(32);
    NullRecorder nothing;
    Picture picture = shadow_buffer::run(scene, Conventions{}, nothing);
    const Picture eye = z_buffer::run(scene, Conventions{}, nothing);
    CHECK(picture.polygon == eye.polygon);
    CHECK(picture.depth == eye.depth);
  }

  TEST_CASE("a light at the eye sees what the eye sees: there is no shadow") {
    Scene scene = floor_and_square(48);
    scene.light = Light{scene.camera.eye, {0, 0, 0}, scene.camera.window, scene.camera.near, scene.camera.far};
    NullRecorder nothing;
    CHECK(dark_pixels(shadow_buffer::run(scene, with_bias("1"), nothing)) == 0);
  }

  TEST_CASE("without a bias a lit surface shades itself, as its depths are those of another raster") {
    Scene scene = floor_and_square(48);
    scene.facets.pop_back();  // nothing there to cast a shadow
    NullRecorder nothing;
    CHECK(dark_pixels(shadow_buffer::run(scene, with_bias("0"), nothing)) > 0);
    CHECK(dark_pixels(shadow_buffer::run(scene, with_bias("10"), nothing)) == 0);
  }

  TEST_CASE("what lies beside the light's window or behind the light is dark") {
    Scene scene = floor_and_square(32);
    scene.light->window = 0.1;
    NullRecorder nothing;
    const Picture narrow = shadow_buffer::run(scene, Conventions{}, nothing);
    CHECK(dark_pixels(narrow) > 250);
    scene.light = Light{{0, 0, -6}, {0, 0, -12}, 0.6, 1, 10};
    const Picture behind = shadow_buffer::run(scene, Conventions{}, nothing);
    std::int64_t seen = 0;
    for (const std::int32_t polygon : behind.polygon) seen += polygon != no_polygon;
    CHECK(dark_pixels(behind) == seen);
  }

  TEST_CASE("an empty scene has no shadow, and a scene without a light is refused before the run") {
    Scene scene = floor_and_square(8);
    scene.facets.clear();
    NullRecorder nothing;
    CHECK(dark_pixels(shadow_buffer::run(scene, Conventions{}, nothing)) == 0);
    scene.light.reset();
    CHECK_THROWS_AS(check_run(method("shadow-buffer"), scene, Conventions{}), InputError);
  }
}
