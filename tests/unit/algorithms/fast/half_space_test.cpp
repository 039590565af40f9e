// Vectorised half-space against half_space.cpp: every bit of both buffers.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "algorithms/fast/half_space.hpp"
#include "algorithms/half_space/half_space.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/fast/same_bits.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;

namespace {

/// How many pictures the fast way drew.
int check_same(const Scene& scene) {
  NullRecorder record;
  static Picture kept;
  int fast = 0;
  for (const bool cull : {false, true})
    for (const auto depth : {Conventions::Depth::pseudodepth, Conventions::Depth::view}) {
      Conventions conventions;
      conventions.cull = cull;
      if (scene.camera.kind != Camera::Kind::screen) conventions.depth = depth;
      const Picture taught = half_space::run(scene, conventions, record);
      for (const int threads : {1, 3}) {  // into what the run before has left
        if (!half_space::run_fast(scene, conventions, kept, threads)) continue;
        ++fast;
        CHECK(test::same_bits(kept, taught));
      }
    }
  return fast;
}

}  // namespace

TEST_SUITE("fast/half_space") {
  TEST_CASE("every built-in scene, on its own raster and on narrow ones") {
    int fast = 0;
    for (const BuiltIn& built_in : built_in_scenes()) {
      const std::string name(built_in.name);
      CAPTURE(name);
      const Scene scene = load_scene(name).scene;
      fast += check_same(look_at_scene(scene, {}));
      for (const int width : {1, 7, 9, 97}) {
        ViewOptions options;
        options.width = width, options.height = 31 + width % 5;
        fast += check_same(look_at_scene(scene, options));
      }
    }
    CHECK(fast > 100);
  }

  TEST_CASE("the teapot in polygons of every size, parallel and in perspective") {
    for (const std::string name : {"teapot:2", "teapot:10"})
      for (const bool orthographic : {false, true}) {
        CAPTURE(name);
        ViewOptions options;
        options.width = 240, options.height = 180, options.orthographic = orthographic;
        CHECK(check_same(look_at_scene(load_scene(name).scene, options)) == 8);
      }
  }

  TEST_CASE(
      "triangles, parallelograms and needles, clipped by all planes, and concave stars that are left to the taught "
      "way") {
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
      CAPTURE(seed);
      test::Numbers random(seed);
      Scene scene;
      scene.raster = {61, 47, false};
      const double size = seed % 3 == 0 ? 0.15 : 1.2;
      for (int i = 0; i < 60; ++i) {
        const glm::dvec3 centre = random.in_box(1.2), u = random.in_box(size), v = random.in_box(size);
        const glm::dvec3 needle = u + random.in_box(1e-7);
        if (i % 3 == 0)
          test::add_polygon(scene, std::vector<glm::dvec3>{centre, centre + u, centre + u + v, centre + v});
        else test::add_polygon(scene, std::vector<glm::dvec3>{centre, centre + u, centre + (i % 3 == 1 ? v : needle)});
      }
      const auto kind = seed % 2 == 0 ? Camera::Kind::perspective : Camera::Kind::orthographic;
      test::look(scene, kind, random.in_box(2), random.in_box(0.5), 0.1, 4);
      CHECK(check_same(scene) > 0);
      test::add_polygon(scene, test::random_star(random, random.in_box(0.3), 1, 9));
      check_same(scene);
    }
  }

  TEST_CASE("what it cannot draw as taught it does not draw") {
    const Scene scene = look_at_scene(load_scene("pyramid").scene, {});
    Picture picture;
    Conventions conventions;
    conventions.options["stepping"] = "increments";
    CHECK(!half_space::run_fast(scene, conventions, picture));
    conventions.options = {{"ties", "last"}};
    CHECK(!half_space::run_fast(scene, conventions, picture));
    conventions.options = {{"hierarchical-z", "on"}, {"tiles", "8"}};
    CHECK(half_space::run_fast(scene, conventions, picture));
  }
}
