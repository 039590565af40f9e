// The shadow buffer: a square that floats over a floor, under a lamp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/matrix.hpp>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/shadow_buffer/shadow_buffer.hpp"
#include "algorithms/viewing/camera.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/record/trace_recorder.hpp"

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

Conventions with(const char* bias, const char* slope_bias, const char* pcf) {
  Conventions conventions = with_bias(bias);
  conventions.options["slope-bias"] = slope_bias;
  conventions.options["pcf"] = pcf;
  return conventions;
}

/// A floor that the lamp sees at a slant, and nothing else.
Scene slanting_floor(std::int32_t side) {
  Scene scene = floor_and_square(side);
  scene.facets.pop_back();
  scene.light = Light{{4, 2, 3}, {0, 0, 0}, 0.5, 1, 10};
  return scene;
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

  TEST_CASE("slopes are how the distance from the light changes over a pixel of its picture, by differences, too") {
    const Scene scene = slanting_floor(64);
    const Camera lamp = viewing::camera_of(*scene.light);
    CollectRecorder record;
    shadow_buffer::run(scene, with("10", "2", "1"), record);
    // Where the light sees the floor, z = 0, through a point of its picture: how far along its line of sight.
    const glm::dmat4 back = glm::inverse(lamp.view);
    const auto distance = [&](double x, double y) {
      const glm::dvec4 along(((x + 0.5) / 32 - 1) * lamp.window, (1 - (y + 0.5) / 32) * lamp.window, 1, 0);
      return -lamp.eye.z / (back * along).z;
    };
    const std::vector<ShadowBias> all = record.all<ShadowBias>();
    const std::vector<ShadowCompare> compares = record.all<ShadowCompare>();
    REQUIRE(all.size() == compares.size());
    REQUIRE(all.size() > 500);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double x = compares[i].x_light, y = compares[i].y_light, h = 1e-4;
      CHECK(all[i].dz_dx_light == doctest::Approx((distance(x + h, y) - distance(x - h, y)) / (2 * h)).epsilon(1e-6));
      CHECK(all[i].dz_dy_light == doctest::Approx((distance(x, y + h) - distance(x, y - h)) / (2 * h)).epsilon(1e-6));
      const double greater = std::max(std::abs(all[i].dz_dx_light), std::abs(all[i].dz_dy_light));
      CHECK(all[i].bias == doctest::Approx(distance(x, y) / 100 + 2 * greater));
    }
  }

  TEST_CASE("once the slope frees a slanting floor of specks, however steep, and k times for k x k compares") {
    for (const double height : {4.0, 2.0, 1.0}) {
      CAPTURE(height);
      Scene scene = slanting_floor(48);
      scene.light->position.z = height;
      const auto lit_of_reached = [&](const Conventions& conventions) {
        std::int64_t wrong = 0;
        CollectRecorder record;
        shadow_buffer::run(scene, conventions, record);
        for (const ShadowCompare& compare : record.all<ShadowCompare>()) {
          const bool well_inside = compare.x_light > 2 && compare.x_light < 45 && compare.y_light > 2 &&
                                   compare.y_light < 45 && compare.z_light > -1 && compare.z_light < 1;
          wrong += well_inside && !compare.lit;
        }
        for (const LightShare& share : record.all<LightShare>()) CHECK(share.share <= 1);
        return wrong;
      };
      CHECK(lit_of_reached(with("0", "0", "1")) > 100);
      CHECK(lit_of_reached(with("0", "1", "1")) < 8);
      CHECK(lit_of_reached(with("0", "3", "3")) == 0);
    }
  }

  TEST_CASE("of k x k compares the share of light is how many say lit, and the colour follows it") {
    const Scene scene = floor_and_square(32);
    for (const char* k : {"3", "5", "7"}) {
      CollectRecorder record;
      const Picture picture = shadow_buffer::run(scene, with("10", "0", k), record);
      const std::vector<ShadowNeighbour> neighbours = record.all<ShadowNeighbour>();
      const std::int32_t across = k[0] - '0';
      std::size_t next = 0, partly = 0;
      const std::vector<LightShare> shares = record.all<LightShare>();
      const std::vector<ShadowCompare> compares = record.all<ShadowCompare>();
      REQUIRE(shares.size() == compares.size());
      for (std::size_t i = 0; i < shares.size(); ++i) {
        double lit = compares[i].lit ? 1 : 0;
        for (; next < neighbours.size() && neighbours[next].x == shares[i].x && neighbours[next].y == shares[i].y;
             ++next)
          lit += neighbours[next].lit ? 1 : 0;
        CHECK(shares[i].share == lit / (across * across));
        partly += shares[i].share > 0 && shares[i].share < 1;
        const std::size_t pixel = picture.at(shares[i].x, shares[i].y);
        if (picture.polygon[pixel] != 0) continue;
        const Color shown = color_at(picture, scene, pixel);
        CHECK(shown.red == std::lround(200 * (0.4 + 0.6 * shares[i].share)));
      }
      CHECK(next == neighbours.size());
      CHECK(partly > 10);
    }
  }

  TEST_CASE("with one compare and no slope the options change nothing") {
    const Scene scene = floor_and_square(32);
    NullRecorder nothing;
    CHECK(shadow_buffer::run(scene, with("10", "0", "1"), nothing) ==
          shadow_buffer::run(scene, Conventions{}, nothing));
  }

  TEST_CASE("check: a wrong bias, neighbour or share, and a verdict by another bias, is found at its step") {
    const Method& shadow = method("shadow-buffer");
    const Scene scene = floor_and_square(16);
    const auto first_cause = [&](auto change) {
      const Conventions conventions = with("10", "1", "3");
      CollectRecorder collected;
      shadow.collect(scene, conventions, collected);
      TraceRecorder recorder(header_for(shadow, conventions), scene);
      std::int64_t changed = 0, step = 0;
      for (const CollectedEvent& recorded : collected.events) {
        Event event = recorded.event;
        ++step;
        if (changed == 0 && change(event)) changed = step;
        record_any(recorder, recorded.step, event);
      }
      recorder.finish();
      const Trace trace = Trace::from_bytes(recorder.take_bytes(), "changed");
      const CheckReport report = check(trace);
      REQUIRE(changed > 0);
      REQUIRE_FALSE(report.causes.empty());
      CHECK(report.causes.front().first.step == changed);
      return std::string(report.causes.front().first.field);
    };
    CHECK(first_cause([](Event& event) {
            auto* e = get_if<ShadowBias>(&event);
            if (e) e->bias *= 1.01;
            return e != nullptr;
          }) == "bias");
    CHECK(first_cause([](Event& event) {
            auto* e = get_if<ShadowNeighbour>(&event);
            if (e) ++e->x_shadow;
            return e != nullptr;
          }) == "x_shadow");
    CHECK(first_cause([](Event& event) {
            auto* e = get_if<LightShare>(&event);
            if (!e || e->share == 1) return false;
            e->share += 1.0 / 9;
            return true;
          }) == "share");
    CHECK(first_cause([](Event& event) {
            auto* e = get_if<ShadowCompare>(&event);
            if (!e || e->lit) return false;
            e->lit = true;
            return true;
          }) == "lit");
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
