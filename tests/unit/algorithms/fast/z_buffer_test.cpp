// run_fast against the loop that is taught: every bit of both buffers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "algorithms/fast/z_buffer.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/fast/same_bits.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;

namespace {

int drawn(const Picture& picture) {
  int count = 0;
  for (const std::int32_t polygon : picture.polygon) count += polygon != no_polygon;
  return count;
}

std::vector<Conventions> all_conventions() {
  std::vector<Conventions> all;
  for (int option = 0; option < 16; ++option) {
    Conventions conventions;
    conventions.depth = static_cast<Conventions::Depth>(option & 1);
    conventions.interpolation = static_cast<Conventions::Interpolation>(option >> 1 & 1);
    conventions.coverage = static_cast<Conventions::Coverage>(option >> 2 & 1);
    conventions.cull = (option >> 3 & 1) == 0;
    all.push_back(conventions);
  }
  return all;
}

// How many pixels are drawn under those conventions that draw most.
int check_same(const Scene& scene, const std::vector<Conventions>& all) {
  NullRecorder record;
  static Picture kept;
  int count = 0;
  for (const Conventions& conventions : all) {
    const Picture taught = z_buffer::run(scene, conventions, record);
    CHECK(test::same_bits(z_buffer::run_fast(scene, conventions), taught));
    for (const int threads : {1, 2, 3, 7}) {  // into what the run before has left
      z_buffer::run_fast(scene, conventions, kept, threads);
      CHECK(test::same_bits(kept, taught));
    }
    count = std::max(count, drawn(taught));
  }
  return count;
}

int check_same(const Scene& scene) { return check_same(scene, all_conventions()); }

// The two that take the fast way, with and without back faces.
std::vector<Conventions> fast_conventions() {
  std::vector<Conventions> both(2);
  both[1].cull = false, both[1].depth = Conventions::Depth::view;
  return both;
}

// Triangles, quadrangles, stars and needles around the eye's line of sight, some behind the eye.
Scene soup(std::uint64_t seed, int polygons, double size) {
  test::Numbers random(seed);
  Scene scene;
  for (int i = 0; i < polygons; ++i) {
    const glm::dvec3 centre = random.in_box(1.2);
    switch (i % 5) {
      case 0:
        test::add_polygon(scene, test::random_star(random, centre, size, 3 + i % 17));
        break;
      case 1: {
        const glm::dvec3 u = random.in_box(size), v = random.in_box(size);
        test::add_polygon(scene, std::vector<glm::dvec3>{centre, centre + u, centre + u + v, centre + v});
        break;
      }
      case 2: {
        const glm::dvec3 along = random.in_box(size);
        test::add_polygon(scene, std::vector<glm::dvec3>{centre, centre + along, centre + along + random.in_box(1e-7)});
        break;
      }
      default: {
        const glm::dvec3 second = centre + random.in_box(size);
        test::add_polygon(scene, std::vector<glm::dvec3>{centre, second, centre + random.in_box(size)});
      }
    }
  }
  return scene;
}

}  // namespace

TEST_SUITE("fast/z_buffer") {
  TEST_CASE("every built-in scene, on its own raster and on one of 1 to 97 columns") {
    for (const BuiltIn& built_in : built_in_scenes()) {
      const std::string name(built_in.name);
      CAPTURE(name);
      const Scene scene = load_scene(name).scene;
      check_same(look_at_scene(scene, {}), fast_conventions());
      for (const int width : {1, 7, 8, 9, 97}) {
        ViewOptions options;
        options.width = width, options.height = 31 + width % 5;
        check_same(look_at_scene(scene, options), fast_conventions());
      }
    }
  }

  TEST_CASE("the teapot in polygons of every size, under every convention") {
    for (const std::string name : {"teapot:2", "teapot:10"}) {
      CAPTURE(name);
      for (const bool orthographic : {false, true}) {
        ViewOptions options;
        options.width = 240, options.height = 180, options.orthographic = orthographic;
        CHECK(check_same(look_at_scene(load_scene(name).scene, options)) > 3000);
      }
    }
  }

  TEST_CASE("soups of triangles, parallelograms, concave stars and needles, clipped by all planes") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      CAPTURE(seed);
      Scene scene = soup(seed, 60, seed % 3 == 0 ? 0.15 : 1.2);
      scene.raster = {seed % 2 == 0 ? 64 : 61, 48, false};
      const auto kind = seed % 4 == 0 ? Camera::Kind::orthographic : Camera::Kind::perspective;
      const double away = seed % 3 == 1 ? 0.2 : 3;
      test::look(scene, kind, {away, 0.3, 0.4}, {0, 0, 0}, 0.1, 4);
      CHECK(check_same(scene) > 0);
    }
  }

  TEST_CASE("screen scenes: corners on pixel centres, edges that coincide, polygons beyond the raster") {
    test::Numbers random(5);
    for (int run = 0; run < 40; ++run) {
      CAPTURE(run);
      std::vector<std::vector<glm::dvec3>> polygons;
      for (int i = 0; i < 30; ++i) {
        std::vector<glm::dvec3> corners;
        const int count = 3 + i % 5;
        for (int k = 0; k < count; ++k) {
          const double x = random.between(-6, 22), y = random.between(-6, 18), z = random.between(0, 9);
          const bool whole = run % 2 == 0;
          corners.push_back({whole ? std::floor(x) : x, whole ? std::floor(y) : y, whole ? std::floor(z) : z});
        }
        polygons.push_back(corners);
      }
      CHECK(check_same(test::screen_scene(16, 12, polygons)) > 100);
    }
  }

  TEST_CASE("what is degenerate: no polygon, no area, edge-on, coordinates without bounds, one pixel") {
    CHECK(check_same(test::screen_scene(5, 4, {})) == 0);
    const double huge = 1e300, far_away = 2e9, none = std::nan("");
    CHECK(check_same(test::screen_scene(9, 9,
                                        {{{0, 0, 0}, {8, 8, 0}, {4, 4, 0}},                // a line
                                         {{3, 3, 1}, {3, 3, 1}, {3, 3, 1}},                // a point
                                         {{1, 1, huge}, {7, 1, -huge}, {4, 7, huge}},      // depths that overflow
                                         {{0, 0, 1}, {far_away, 0, 1}, {0, far_away, 1}},  // dropped
                                         {{none, 0, 1}, {5, 0, 1}, {0, 5, 1}},             // dropped
                                         {{-1e8, -1e8, 2}, {1e8, -1e8, 2}, {0, 1e8, 2}},   // all of the raster
                                         {{2, 2, -1}, {6, 2, -1}}}))                       // two corners
          == 81);
    CHECK(check_same(test::screen_scene(1, 1, {{{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}})) == 1);

    Scene scene = test::cube(0.5);
    const glm::dvec3 point(0.1, 0.2, 0.7);
    test::add_polygon(scene, std::vector<glm::dvec3>{point, point, point});
    test::add_polygon(scene, std::vector<glm::dvec3>{point, point * 2.0, point * 3.0});
    test::add_polygon(scene, std::vector<glm::dvec3>{{2, 0.3, 0.4}, {1, 0.15, 0.2}, {1, 0.15, 0.4}});
    test::add_polygon(scene, std::vector<glm::dvec3>{point, {1e-9, 0, 0.7}, {0, 1e-13, 0.7}});
    scene.raster = {40, 30, false};
    test::look(scene, Camera::Kind::perspective, {4, 0.6, 0.8}, {0, 0, 0}, 1, 8);
    CHECK(check_same(scene) > 0);
  }

  TEST_CASE("polygons seen ever nearer to edge-on, and ever smaller, around where the taught test decides") {
    Scene scene;
    for (int i = 0; i < 60; ++i) {
      const double tilt = std::pow(10.0, -16 + i * 0.25), y = -0.9 + 0.03 * i;
      test::add_polygon(
          scene, std::vector<glm::dvec3>{{-0.5, y, 0}, {0.5, y, tilt}, {0.5, y + 0.02, tilt}, {-0.5, y + 0.02, 0}});
      const double size = std::pow(10.0, -8 + i * 0.125);
      test::add_polygon(scene, std::vector<glm::dvec3>{{0, y, 0.2}, {0, y + size, 0.2}, {0, y + 1, 0.2 + size * size}});
    }
    scene.raster = {80, 60, false};
    test::look(scene, Camera::Kind::perspective, {4, 0, 0}, {0, 0, 0}, 1, 8);
    CHECK(check_same(scene) > 0);
    test::look(scene, Camera::Kind::orthographic, {4, 0, 0}, {0, 0, 0}, 1, 8);
    CHECK(check_same(scene) > 0);
  }
}
