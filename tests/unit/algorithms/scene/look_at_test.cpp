// From a scene and options to a scene that can be drawn.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "algorithms/scene/load.hpp"
#include "algorithms/viewing/camera.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

Scene points_scene(std::vector<glm::dvec3> points) {
  Scene scene;
  scene.points = std::move(points);
  scene.polygons = {{"A", {}, 0}};
  scene.facets = {{0, 0, 3}};
  scene.corners = {0, 1, 2};
  scene.camera.rho = 0;
  return scene;
}

const Scene unit = points_scene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});

bool near_to(glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b) < 1e-12; }

}  // namespace

TEST_SUITE("look at a scene") {
  TEST_CASE("Eckert's camera by options") {
    ViewOptions options;
    options.rho = 4, options.theta = 90, options.phi = 90, options.d = 3, options.window = 2;
    options.width = 20, options.height = 10;
    const Scene scene = look_at_scene(unit, options);
    CHECK(scene.camera.view == viewing::eckert_view(4, 90, 90));
    CHECK(near_to(scene.camera.eye, {0, 4, 0}));
    CHECK(scene.camera.d == 3);
    CHECK(scene.camera.window == 2);
    CHECK(scene.raster == Raster{20, 10, false});
    // z_v runs from 3 to 4; a hundredth of that on both sides
    CHECK(scene.camera.near == doctest::Approx(2.99));
    CHECK(scene.camera.far == doctest::Approx(4.01));
  }

  TEST_CASE("near and far: given, from the extent, with the eye inside, with everything behind the eye") {
    ViewOptions options;
    options.rho = 0.5, options.theta = 0, options.phi = 90;
    const Scene inside = look_at_scene(points_scene({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}), options);
    CHECK(inside.camera.far == doctest::Approx(1.5 + 0.02));
    CHECK(inside.camera.near == doctest::Approx(inside.camera.far / 1000));
    const Scene behind = look_at_scene(points_scene({{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}), options);
    CHECK(behind.camera.near > 0);
    CHECK(behind.camera.far > behind.camera.near);
    const Scene flat = look_at_scene(points_scene({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}), options);
    CHECK(flat.camera.near < 0.5);
    CHECK(flat.camera.far > 0.5);
    options.near = 0.25, options.far = 10;
    const Scene given = look_at_scene(unit, options);
    CHECK(given.camera.near == 0.25);
    CHECK(given.camera.far == 10);
    options.far.reset();
    options.near = 100;
    CHECK(look_at_scene(unit, options).camera.far > 100);
    options.near.reset();
    options.far = 1e-3;
    const Scene close = look_at_scene(unit, options);
    CHECK(close.camera.far == 1e-3);
    CHECK(close.camera.near < close.camera.far);
    CHECK(close.camera.near > 0);
  }

  TEST_CASE("orthographic: near may be negative, eye is the direction towards it") {
    ViewOptions options;
    options.orthographic = true, options.rho = 0.5, options.theta = 0, options.phi = 90;
    const Scene scene = look_at_scene(points_scene({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}), options);
    CHECK(scene.camera.kind == Camera::Kind::orthographic);
    CHECK(scene.camera.near == doctest::Approx(-0.52));
    CHECK(scene.camera.far == doctest::Approx(1.52));
    CHECK(near_to(scene.camera.eye, {1, 0, 0}));
    options = {};
    options.orthographic = true;
    const Scene pyramid = look_at_scene(load_scene("pyramid").scene, options);
    CHECK(glm::length(pyramid.camera.eye) == doctest::Approx(1));
    CHECK(near_to(pyramid.camera.eye, viewing::eckert_eye(1, 30, 60)));
    options.orthographic = false;
    CHECK(look_at_scene(pyramid, options).camera.kind == Camera::Kind::perspective);
  }

  TEST_CASE(
      "without a distance the whole scene is in the picture, however large it is and whatever the raster's shape") {
    NullRecorder record;
    for (const double size : {1e-6, 1.0, 1e9})
      for (const auto& [width, height] : {std::pair{40, 20}, std::pair{20, 40}}) {
        Scene scene = points_scene({});
        scene.facets.clear();
        scene.corners.clear();
        const Scene cube = load_scene("cube").scene;
        scene = cube;
        scene.camera = Camera{};
        scene.camera.rho = 0;
        for (glm::dvec3& point : scene.points) point *= size;
        ViewOptions options;
        options.width = width, options.height = height;
        const Picture picture = z_buffer::run(look_at_scene(scene, options), {}, record);
        int drawn = 0;
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x) {
            const bool here = picture.polygon[picture.at(x, y)] != no_polygon;
            if (here) ++drawn;
            if (x == 0 || y == 0 || x == width - 1 || y == height - 1) CHECK(!here);
          }
        CHECK(drawn > 50);
      }
  }

  TEST_CASE("fit: the box's centre to the origin, the farthest vertex at distance 1") {
    ViewOptions options;
    options.fit = true;
    const Scene scene = look_at_scene(points_scene({{10, 20, 30}, {14, 20, 30}, {10, 22, 30}, {14, 22, 34}}), options);
    glm::dvec3 low(9), high(-9);
    double farthest = 0;
    for (const glm::dvec3& p : scene.points) {
      low = glm::min(low, p);
      high = glm::max(high, p);
      farthest = std::max(farthest, glm::length(p));
    }
    CHECK(near_to(low + high, {0, 0, 0}));
    CHECK(farthest == doctest::Approx(1));
    CHECK(scene.points[0].x == doctest::Approx(-2 / 3.0));
    const Scene one_point = look_at_scene(points_scene({{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}), options);
    CHECK(one_point.points[0] == glm::dvec3(0));
  }

  TEST_CASE("options override a scene's own camera, wherever its eye stands") {
    Scene scene = unit;
    scene.camera.polar = false;
    scene.camera.view = viewing::look_at_view({0, 0, 7}, {0, 0, 0}, {0, 1, 0});
    scene.camera.eye = {0, 0, 7};
    const Scene own = look_at_scene(scene, {});
    CHECK(!own.camera.polar);
    CHECK(own.camera.eye == glm::dvec3(0, 0, 7));
    CHECK(own.camera.near < 7);
    CHECK(own.camera.far > 7);
    ViewOptions options;
    options.theta = 0;
    const Scene turned = look_at_scene(scene, options);
    CHECK(turned.camera.polar);
    CHECK(turned.camera.rho > 1);
  }

  TEST_CASE("impossible options are InputErrors") {
    const auto error_of = [](auto&& set) {
      ViewOptions options;
      set(options);
      return input_error([&] { look_at_scene(unit, options); });
    };
    const double infinite = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(contains(error_of([](ViewOptions& o) { o.rho = 0; }), "rho: it is 0; it must be greater than 0"));
    CHECK(contains(error_of([&](ViewOptions& o) { o.rho = nan; }), "rho: nan is no number for it"));
    CHECK(contains(error_of([&](ViewOptions& o) { o.theta = infinite; }), "theta"));
    CHECK(contains(error_of([](ViewOptions& o) { o.d = -1; }), "d: it is -1"));
    CHECK(contains(error_of([](ViewOptions& o) { o.window = 0; }), "window"));
    CHECK(contains(error_of([](ViewOptions& o) { o.near = -1; }), "near: it is -1; in perspective"));
    CHECK(contains(error_of([](ViewOptions& o) { o.near = 2, o.far = 1; }), "far: it is 1, but near is 2"));
    CHECK(contains(error_of([](ViewOptions& o) { o.near = 2, o.far = 2; }), "far"));
    CHECK(contains(error_of([](ViewOptions& o) { o.width = 0; }), "size: 0x64"));
    CHECK(contains(error_of([](ViewOptions& o) { o.height = -5; }), "size"));
    CHECK(contains(error_of([](ViewOptions& o) { o.width = 16384, o.height = 16384; }), "size"));
    ViewOptions options;
    options.theta = 3;
    CHECK(contains(input_error([&] { look_at_scene(load_scene("foley").scene, options); }), "screen coordinates"));
    options = {};
    options.fit = true;
    CHECK(contains(input_error([&] { look_at_scene(load_scene("foley").scene, options); }), "screen coordinates"));
    options = {};
    options.width = 5;
    CHECK(look_at_scene(load_scene("foley").scene, options).raster.width == 5);
  }
}
