// [light] and the keys of materials in scene files, materials of OBJ files, and the light's window and planes.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "algorithms/viewing/camera.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;

namespace {

const std::string triangle = "[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n";
const std::string cube = "[[mesh]]\nbuiltin = \"cube\"\n";

PolygonSoup glass_mesh() {
  return read_obj(
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl glass\nf 1 2 3\nusemtl plain\nf 1 2 3\n", "m.obj",
      [](std::string_view) {
        return MaterialFile{"m.mtl", "newmtl glass\nKd 0 0 1\nd 0.25\nNi 1.5\nnewmtl plain\nNi 0\nTr -halo 0\n"};
      });
}

SceneFile read(const std::string& text) {
  return read_scene(text, "s.toml", "s", [](const std::string&) { return glass_mesh(); });
}
std::string error_of(const std::string& text) {
  return input_error([&] { read(text); });
}

/// Whether the light sees the point: before its far plane, behind its near one, within its window.
bool lit(const Light& light, glm::dvec3 point) {
  const viewing::Lens lens(viewing::camera_of(light), {64, 64, false}, Conventions::Depth::view);
  const glm::dvec3 view = viewing::camera_of(light).view * glm::dvec4(point, 1);
  if (!(view.z > light.near && view.z < light.far)) return false;
  const glm::dvec3 on_plane = lens.project(view);
  return std::abs(on_plane.x) < light.window && std::abs(on_plane.y) < light.window;
}

}  // namespace

TEST_SUITE("lights and materials") {
  TEST_CASE("materials of polygons and meshes") {
    const Scene scene =
        read(triangle + "opacity = 0.5\nreflectance = 0.25\nrefraction = 1.5\n" + triangle + cube + "reflectance = 1\n")
            .scene;
    CHECK(scene.polygons[0].material == Material{0.5, 0.25, 1.5});
    CHECK(scene.polygons[1].material == Material{});
    for (std::size_t i = 2; i < 8; ++i) CHECK(scene.polygons[i].material == Material{1, 1, 1});
  }

  TEST_CASE("an OBJ's d, Tr and Ni fill the material, the scene file's keys go before them") {
    const Scene own = read("[[mesh]]\nfile = \"m.obj\"\n").scene;
    CHECK(own.polygons[0].material == Material{});
    CHECK(own.polygons[1].material == Material{0.25, 0, 1.5});
    CHECK(own.polygons[1].color == Color{0, 0, 255});
    CHECK(own.polygons[2].material == Material{});
    const Scene stated = read("[[mesh]]\nfile = \"m.obj\"\nopacity = 0.75\n").scene;
    CHECK(stated.polygons[0].material == Material{0.75, 0, 1});
    CHECK(stated.polygons[1].material == Material{0.75, 0, 1.5});
  }

  TEST_CASE("a wrong material is said with its line") {
    CHECK(contains(error_of(triangle + "opacity = 1.5\n"), "s.toml:3: opacity is 1.5; it goes from 0 to 1"));
    CHECK(contains(error_of(triangle + "reflectance = -1\n"), "s.toml:3: reflectance is -1; it goes from 0 to 1"));
    CHECK(contains(error_of(cube + "refraction = 0\n"), "s.toml:3: refraction is 0; it goes from 0.1 to 10"));
    CHECK(contains(error_of(triangle + "opacity = nan\n"), "s.toml:3: opacity is nan"));
    CHECK(contains(error_of(triangle + "opacitty = 1\n"), "did you mean 'opacity'?"));
  }

  TEST_CASE("a light is read, and what is not given comes from the scene") {
    const SceneFile file = read("[light]\nposition = [4, 0, 5]\n" + cube);
    REQUIRE(file.scene.light);
    CHECK(*file.scene.light == Light{{4, 0, 5}, {0, 0, 0}, 0, 0, 0});
    const Scene scene = look_at_scene(file.scene, {});
    const Light& light = *scene.light;
    // The ball round the cube has radius √3, at distance √41.
    CHECK(light.window == doctest::Approx(1.05 * std::tan(std::asin(std::sqrt(3.0 / 41)))));
    CHECK(light.near == doctest::Approx(std::sqrt(41.0) - 1.01 * std::sqrt(3.0)));
    CHECK(light.far == doctest::Approx(std::sqrt(41.0) + 1.01 * std::sqrt(3.0)));
    for (const glm::dvec3& point : scene.points) CHECK(lit(light, point));
    CHECK_FALSE(read(cube).scene.light);
  }

  TEST_CASE("what is given of a light stays") {
    const Scene scene = look_at_scene(
        read("[light]\nposition = [0, 0, 5]\ntarget = [1, 0, 0]\nwindow = 0.5\nnear = 1\nfar = 9\n" + cube).scene, {});
    CHECK(*scene.light == Light{{0, 0, 5}, {1, 0, 0}, 0.5, 1, 9});
  }

  TEST_CASE("a light that looks past the scene, or stands in it, still sees it as far as a camera can") {
    const Scene past = look_at_scene(read("[light]\nposition = [6, 0, 0]\ntarget = [0, 5, 0]\n" + cube).scene, {});
    for (const glm::dvec3& point : past.points) CHECK(lit(*past.light, point));
    for (const char* position : {"[0, 0, 0.5]", "[0, 0, 1e-9]", "[0, 0, 1.7]", "[1e-3, 0, 0]"}) {
      const Scene inside = look_at_scene(
          read("[light]\ntarget = [0, 0, 9]\nposition = " + std::string(position) + "\n" + cube).scene, {});
      CHECK(inside.light->near > 0);
      CHECK(inside.light->near < inside.light->far);
      CHECK(inside.light->window == doctest::Approx(1.05 * std::tan(80 * 3.14159265358979323846 / 180)));
    }
    // The scene is behind it.
    const Scene behind = look_at_scene(read("[light]\nposition = [0, 0, 9]\ntarget = [0, 0, 10]\n" + cube).scene, {});
    CHECK(behind.light->near > 0);
    CHECK(behind.light->near < behind.light->far);
    for (const char* planes : {"near = 100", "far = 0.001", "near = 1e-3", "far = 1e6"}) {
      const Scene some =
          look_at_scene(read("[light]\nposition = [0, 0, 9]\n" + std::string(planes) + "\n" + cube).scene, {});
      CHECK(some.light->near > 0);
      CHECK(some.light->near < some.light->far);
    }
  }

  TEST_CASE("fitting a scene moves its light with it") {
    ViewOptions options;
    options.fit = true;
    const std::string far_away = cube + "translate = [10, 0, 0]\nscale = 2\n";
    const Light light =
        *look_at_scene(
             read("[light]\nposition = [10, 0, 8]\ntarget = [10, 0, 1]\nnear = 2\nfar = 12\n" + far_away).scene,
             options)
             .light;
    const double size = 2 * std::sqrt(3.0);
    CHECK(light.position.z == doctest::Approx(8 / size));
    CHECK(light.position.x == doctest::Approx(0));
    CHECK(light.target.z == doctest::Approx(1 / size));
    CHECK(light.near == doctest::Approx(2 / size));
    CHECK(light.far == doctest::Approx(12 / size));
  }

  TEST_CASE("a wrong light is said with its line") {
    CHECK(contains(error_of("[light]\n" + cube), "s.toml:1: the light has no position"));
    CHECK(contains(error_of("[light]\nposition = [0, 0, 0]\n" + cube), "s.toml:2: the light stands at its target"));
    CHECK(contains(error_of("[light]\nposition = [1, 0, 0]\nnear = 0\n" + cube), "s.toml:3: near is 0"));
    CHECK(contains(error_of("[light]\nposition = [1, 0, 0]\nnear = 3\nfar = 2\n" + cube),
                   "s.toml:4: far is not greater"));
    CHECK(contains(error_of("[light]\nposition = [1, 0, 0]\nwindow = -1\n" + cube), "s.toml:3: window is -1"));
    CHECK(contains(error_of("[light]\nposition = [1, 0, 0]\nposiiton = 1\n" + cube), "did you mean 'position'?"));
    CHECK(contains(error_of("light = 3\n" + cube), "write it as a table: [light]"));
    CHECK(contains(error_of("coordinates = \"screen\"\n[light]\nposition = [1, 0, 0]\n" + triangle),
                   "a light needs a scene in world coordinates"));
  }
}
