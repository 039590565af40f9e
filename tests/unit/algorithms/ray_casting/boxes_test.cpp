// Whatever spares a ray its tests, the picture is the same to the bit; and so is cast_fast's.
#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "algorithms/fast/ray_casting.hpp"
#include "algorithms/ray_casting/ray_casting.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;

namespace {

bool same_bits(const Picture& one, const Picture& other) {
  return one.polygon == other.polygon && one.depth.size() == other.depth.size() &&
         std::memcmp(one.depth.data(), other.depth.data(), one.depth.size() * sizeof(double)) == 0;
}

Picture cast(const Scene& scene, Conventions conventions, const std::string& boxes) {
  conventions.options = {{"boxes", boxes}};
  NullRecorder record;
  return ray_casting::run(scene, conventions, record);
}

int check_same(const Scene& scene) {
  int drawn = 0;
  for (const bool cull : {true, false}) {
    CAPTURE(cull);
    Conventions conventions;
    conventions.cull = cull;
    const Picture naive = cast(scene, conventions, "none");
    for (const std::string boxes : {"facet", "hierarchy", "grid"}) {
      CAPTURE(boxes);
      CHECK(same_bits(naive, cast(scene, conventions, boxes)));
    }
    CHECK(same_bits(naive, ray_casting::cast_fast(scene, conventions)));
    drawn = 0;
    for (const std::int32_t polygon : naive.polygon) drawn += polygon != no_polygon;
  }
  return drawn;
}

}  // namespace

TEST_SUITE("ray_casting/boxes") {
  TEST_CASE("every built-in scene") {
    for (const BuiltIn& built_in : built_in_scenes()) {
      const std::string name(built_in.name);
      CAPTURE(name);
      for (const bool orthographic : {false, true}) {
        ViewOptions options;
        options.width = 24, options.height = 18, options.orthographic = orthographic;
        const Scene file = load_scene(name == "teapot" ? "teapot:3" : name).scene;
        if (file.camera.kind == Camera::Kind::screen && orthographic) continue;
        if (file.camera.kind == Camera::Kind::screen) options.orthographic.reset();
        check_same(look_at_scene(file, options));
      }
    }
  }

  TEST_CASE("soups of triangles and stars in space and in planes of coordinates, the eye among them") {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(seed);
      test::Numbers random(seed);
      Scene scene;
      for (int i = 0; i < 50; ++i) {
        const glm::dvec3 centre = random.in_box(1.2);
        std::vector<glm::dvec3> corners = test::random_star(random, centre, seed % 2 == 0 ? 1 : 0.2, 3 + i % 9);
        if (i % 3 == 0) {  // flat: its box has no thickness
          for (glm::dvec3& corner : corners) corner[i % 9 / 3] = centre[i % 9 / 3];
        }
        if (i % 10 == 9) corners[1] = corners[0] + 1e-9 * random.in_box(1);  // a needle
        test::add_polygon(scene, corners);
      }
      scene.raster = {23, 17, false};
      const auto kind = seed % 3 == 0 ? Camera::Kind::orthographic : Camera::Kind::perspective;
      test::look(scene, kind, random.in_box(seed % 5 == 0 ? 0.3 : 4), {0, 0, 0}, 0.01, 8);
      CHECK(check_same(scene) > 0);
    }
  }

  TEST_CASE("screen scenes with corners on pixel centres, edges that coincide and depths that are equal") {
    test::Numbers random(4);
    for (int run = 0; run < 20; ++run) {
      CAPTURE(run);
      std::vector<std::vector<glm::dvec3>> polygons;
      for (int i = 0; i < 25; ++i) {
        std::vector<glm::dvec3> corners;
        const double z = std::floor(random.between(0, 4));
        for (int k = 0; k < 3 + i % 4; ++k) {
          const double x = std::floor(random.between(-3, 15)), y = std::floor(random.between(-3, 12));
          corners.push_back({x, y, i % 2 == 0 ? z : z + x});
        }
        polygons.push_back(corners);
      }
      CHECK(check_same(test::screen_scene(12, 9, polygons)) > 20);
    }
  }

  TEST_CASE("no polygon, and polygons without area") {
    CHECK(check_same(test::screen_scene(5, 4, {})) == 0);
    CHECK(check_same(
              test::screen_scene(5, 4, {{{0, 0, 1}, {4, 3, 1}, {2, 1.5, 1}}, {{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}})) == 0);
  }
}
