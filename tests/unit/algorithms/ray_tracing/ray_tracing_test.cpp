// Ray tracing: the two laws of optics, and colours mixed by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "algorithms/ray_casting/ray_casting.hpp"
#include "algorithms/ray_tracing/ray_tracing.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/where.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

Conventions to_depth(int depth, const std::string& boxes = "none") {
  Conventions conventions;
  conventions.options = {{"depth", std::to_string(depth)}, {"boxes", boxes}};
  return conventions;
}

// Walls across x, w wide, facing the eye or turned away from it.
void add_wall(Scene& scene, double x, double w, bool towards_eye, Color color, Material material = {}) {
  std::vector<glm::dvec3> corners{{x, -w, -w}, {x, w, -w}, {x, w, w}, {x, -w, w}};
  if (!towards_eye) corners = {corners[3], corners[2], corners[1], corners[0]};
  test::add_polygon(scene, corners);
  scene.polygons.back().color = color;
  scene.polygons.back().material = material;
}

// One pixel, one ray: from (4, 0, 0) along -x.
Scene one_ray() {
  Scene scene;
  scene.raster = {1, 1, false};
  scene.background = {0, 0, 255};
  return scene;
}

Color seen(Scene scene, int depth, CollectRecorder& record) {
  test::look(scene, Camera::Kind::perspective, 4, 0, 90, 0.1, 100);
  const Picture picture = ray_tracing::run(scene, to_depth(depth), record);
  REQUIRE(picture.ink.size() == 1);
  REQUIRE(picture.polygon[0] != no_polygon);
  const std::vector<ColorWrite> writes = record.all<ColorWrite>();
  REQUIRE(writes.size() == 1);
  const Color color{static_cast<std::uint8_t>(writes[0].r8), static_cast<std::uint8_t>(writes[0].g8),
                    static_cast<std::uint8_t>(writes[0].b8)};
  CHECK(picture.ink[0] == ink_of(color));
  return color;
}

Color seen(const Scene& scene, int depth) {
  CollectRecorder record;
  return seen(scene, depth, record);
}

constexpr Color red{255, 0, 0}, green{0, 255, 0}, black{0, 0, 0};

}  // namespace

TEST_SUITE("ray_tracing") {
  TEST_CASE("a mirror sends light back at the angle at which it came, from either side") {
    for (const double side : {1.0, -1.0}) {
      const glm::dvec3 out = ray_tracing::mirrored({3, -4, 0}, {0, side, 0});
      CHECK(out == glm::dvec3(3, 4, 0));
    }
  }

  TEST_CASE("Snell: from air at 45 degrees into n = sqrt 2 at 30 degrees, and back, beyond 45 degrees no way out") {
    const double n = std::sqrt(2.0), third = std::sqrt(3.0) / 2;
    const glm::dvec3 normal(0, 1, 0), slanting(std::sqrt(0.5), -std::sqrt(0.5), 0);
    const auto in = ray_tracing::refracted(slanting, normal, 1, n);
    REQUIRE(in);
    CHECK(in->x == doctest::Approx(0.5));
    CHECK(in->y == doctest::Approx(-third));
    const auto out = ray_tracing::refracted(*in, normal, n, 1);
    REQUIRE(out);
    CHECK(out->x == doctest::Approx(slanting.x));
    CHECK(out->y == doctest::Approx(slanting.y));
    CHECK_FALSE(ray_tracing::refracted(glm::dvec3(third, -0.5, 0), normal, n, 1));
    CHECK(ray_tracing::refracted(slanting, normal, 1.3, 1.3)->x == doctest::Approx(slanting.x));
  }

  TEST_CASE("colours are mixed by reflectance and opacity") {
    Scene mirror = one_ray();
    add_wall(mirror, 0, 1, true, red, {1, 0.5, 1});
    CHECK(seen(mirror, 1) == Color{128, 0, 128});  // half red, half of the blue behind the eye
    CHECK(seen(mirror, 0) == red);                 // at the last depth its own colour alone

    Scene pane = one_ray();
    add_wall(pane, 0, 1, true, red, {0.4, 0, 1});
    add_wall(pane, -2, 1, true, green);
    CHECK(seen(pane, 1) == Color{102, 153, 0});  // 0.4 red + 0.6 green

    Scene both = one_ray();
    add_wall(both, 0, 1, true, black, {0.5, 0.2, 1});
    add_wall(both, -2, 1, true, green);
    CHECK(seen(both, 1) == Color{0, 102, 51});  // 0.2 blue + 0.8 (0.5 black + 0.5 green)
  }

  TEST_CASE("two mirrors that face each other: a ray for each depth, and no more") {
    Scene scene = one_ray();
    add_wall(scene, 0, 1, true, red, {1, 1, 1});
    add_wall(scene, 6, 1, false, green, {1, 1, 1});  // behind the eye
    for (const int depth : {0, 1, 2, 5, 8}) {
      CAPTURE(depth);
      CollectRecorder record;
      CHECK(seen(scene, depth, record) == (depth % 2 == 0 ? red : green));
      const std::vector<RayBegin> rays = record.all<RayBegin>();
      CHECK(rays.size() == static_cast<std::size_t>(depth) + 1);
      for (std::size_t i = 1; i < rays.size(); ++i) {
        CHECK(rays[i].parent == static_cast<std::int32_t>(i) - 1);
        CHECK(rays[i].role == RayRole::reflected);
      }
    }
  }

  TEST_CASE("through a slab of glass a ray goes on in its old direction, beside where it was") {
    Scene scene;
    scene.raster = {1, 1, false};
    const Material glass{0, 0, 1.5};
    test::add_polygon(scene, std::vector<glm::dvec3>{{1, -9, -9}, {-1, 9, -9}, {-1, 9, 9}, {1, -9, 9}});
    scene.polygons.back().material = glass;
    test::add_polygon(scene, std::vector<glm::dvec3>{{0, -9, 9}, {-2, 9, 9}, {-2, 9, -9}, {0, -9, -9}});
    scene.polygons.back().material = glass;
    CollectRecorder record;
    seen(scene, 3, record);
    const std::vector<RayBegin> rays = record.all<RayBegin>();
    REQUIRE(rays.size() == 3);
    CHECK(rays[1].role == RayRole::transmitted);
    CHECK(std::abs(rays[1].dir_y) > 0.01);  // bent
    CHECK(rays[2].dir_x == doctest::Approx(-1));
    CHECK(rays[2].dir_y == doctest::Approx(0));
    CHECK(std::abs(rays[2].y_0) > 0.01);
  }

  TEST_CASE("where light cannot leave, all of it is mirrored") {
    // A ray inside glass meets its back at more than the critical angle: n = 3 and 45 degrees.
    Scene scene = one_ray();
    test::add_polygon(scene, std::vector<glm::dvec3>{{-1, 1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, 1, 1}});
    scene.polygons.back().material = Material{0, 0, 3};
    CollectRecorder record;
    test::look(scene, Camera::Kind::perspective, 4, 0, 90, 0.1, 100);
    Conventions conventions = to_depth(2);
    conventions.cull = false;
    ray_tracing::run(scene, conventions, record);
    const std::vector<RayBegin> rays = record.all<RayBegin>();
    REQUIRE(rays.size() == 2);
    CHECK(rays[1].role == RayRole::reflected);
  }

  TEST_CASE("a light: what it does not reach is dimmed to four tenths") {
    Scene scene = one_ray();
    add_wall(scene, 0, 1, true, red);
    scene.light = Light{{4, 0, 3}, {0, 0, 0}, 1, 1, 9};
    CHECK(seen(scene, 1) == red);
    test::add_polygon(scene, std::vector<glm::dvec3>{{2, -1, 1}, {2, 1, 1}, {2, 1, 2}, {2, -1, 2}});  // in between
    CollectRecorder record;
    CHECK(seen(scene, 1, record) == Color{102, 0, 0});
    CHECK(record.all<RayBegin>().back().role == RayRole::shadow);
    CHECK(record.all<RayEnd>().front().nearest_facet == 1);
  }

  TEST_CASE("polygon and depth are ray casting's, at every depth, the colour does not depend on the boxes") {
    const Scene scene = look_at_scene(load_scene(test::in_checkout("lessons/scenes/mirror.toml")).scene, {});
    NullRecorder record;
    const Picture cast = ray_casting::run(scene, {}, record);
    for (const int depth : {0, 3}) {
      const Picture plain = ray_tracing::run(scene, to_depth(depth), record);
      CHECK(plain.polygon == cast.polygon);
      CHECK(plain.depth == cast.depth);
      for (const std::string boxes : {"facet", "hierarchy", "grid"}) {
        CAPTURE(boxes);
        CHECK(ray_tracing::run(scene, to_depth(depth, boxes), record) == plain);
      }
    }
  }

  TEST_CASE("no polygon: the background alone") {
    NullRecorder record;
    const Picture picture = ray_tracing::run(test::screen_scene(3, 2, {}), {}, record);
    for (const std::int32_t polygon : picture.polygon) CHECK(polygon == no_polygon);
  }
}
