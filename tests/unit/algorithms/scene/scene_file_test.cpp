// Scene files.
#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;

namespace {

SceneFile read(const std::string& text) {
  return read_scene(text, "s.toml", "s",
                    [](const std::string& path) { return read_mesh(test::in_checkout("tests/data/meshes/") + path); });
}

std::string error_of(const std::string& text) {
  return input_error([&] { read(text); });
}

const std::string triangle = "[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n";

/// The ```toml blocks of a Markdown file.
std::vector<std::string> examples(const std::string& path) {
  std::ifstream in(test::in_checkout(path));
  std::vector<std::string> blocks;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line == "```toml") {
      inside = true;
      blocks.emplace_back();
    } else if (line == "```") inside = false;
    else if (inside) blocks.back() += line + "\n";
  }
  return blocks;
}

}  // namespace

TEST_SUITE("scene files") {
  TEST_CASE("polygons take the order that is asked for, and keep_points keeps the numbers of the list") {
    const std::string two =
        "[[polygon]]\nname = \"A\"\ncorners = [3, 0, 2]\n[[polygon]]\nname = \"B\"\ncorners = [2, 1, 3]\n";
    const std::string points = "points = [[0, 0, 0], [1, 0, 0], [0, 0, 0], [0, 1, 1]]\n";
    const Scene plain = read(points + two).scene, kept = read("keep_points = true\n" + points + two).scene,
                turned = read("order = [\"B\", \"A\"]\nkeep_points = true\n" + points + two).scene;
    CHECK(plain.points.size() == 3);
    CHECK(kept.points.size() == 4);
    CHECK(kept.corners == std::vector<std::int32_t>{3, 0, 2, 2, 1, 3});
    CHECK(*turned.polygons[0].name == "B");
    CHECK(turned.corners == std::vector<std::int32_t>{2, 1, 3, 3, 0, 2});
    CHECK(turned.facets[0].polygon == 0);
    CHECK(turned.points == kept.points);
    CHECK(error_of("order = [\"B\"]\n" + points + two) ==
          "s.toml:1: the order names 1 of 2 polygons; give each polygon's name once");
    CHECK(error_of("order = [\"B\", \"B\"]\n" + points + two) ==
          "s.toml:1: 'B' is in the order twice; give each polygon's name once");
    CHECK(error_of("order = [\"B\", \"C\"]\n" + points + two) ==
          "s.toml:1: there is no polygon 'C' to put in order; give each polygon's name once");
    CHECK(error_of("keep_points = true\n" + triangle) ==
          "s.toml:1: keep_points is for scenes all of whose points stand in one list; remove it, or give points = [[x, "
          "y, z], …] and polygons with corners");
  }

  TEST_CASE("the examples of docs/scene-format.md are scenes") {
    const auto blocks = examples("docs/scene-format.md");
    REQUIRE(blocks.size() == 8);
    for (const std::string& block : blocks) CHECK_MESSAGE(error_of(block) == "no error", block);

    const SceneFile file = read(blocks[1]);
    const Scene& scene = file.scene;
    CHECK(scene.name == "everything");
    CHECK(scene.source == "s.toml");
    CHECK(scene.raster == Raster{64, 48, false});
    CHECK(scene.camera.rho == 8);
    CHECK(scene.camera.near == 1);
    CHECK(scene.camera.far == 20);
    CHECK(file.conventions == Conventions{});
    CHECK(scene.polygons[0] == Polygon{"A", {230, 159, 0}, 29});
    CHECK(scene.polygons[1].color == Color{0, 0x72, 0xb2});
    CHECK(scene.polygons[2].color == Color{230, 159, 0});
    CHECK(scene.polygons[2].source_line == 39);
    CHECK(scene.polygons.size() == 2 + 6 + 28 * 16);
    CHECK(scene.points[0] == glm::dvec3(1, 1, -1));
    CHECK(scene.points.size() == scene.point_lines.size());
    // Points have the lines of their own files, and the scene says where it placed those.
    CHECK(scene.point_lines[0] == 5);
    REQUIRE(scene.placements.size() == 2);
    CHECK(scene.placements[0].source == "house.off");
    CHECK(scene.placements[0].line == 39);
    const std::int32_t house = scene.placements[0].first_point;
    REQUIRE(placement_of(scene, house) == &scene.placements[0]);
    CHECK(scene.point_lines[static_cast<std::size_t>(house)] > 0);
    CHECK(scene.file_points[static_cast<std::size_t>(house)] == glm::dvec3(-1, -1.5, -1));
    CHECK(scene.placements[0](scene.file_points[static_cast<std::size_t>(house)]) ==
          scene.points[static_cast<std::size_t>(house)]);
    CHECK(placement_of(scene, house - 1) == nullptr);
    CHECK(scene.file_points[0] == scene.points[0]);
    CHECK(scene.placements[1].first_point + scene.placements[1].point_count ==
          static_cast<std::int32_t>(scene.points.size()));
    // The house's corner (-1, -1.5, -1): halved, a quarter turn to the left, two units along -y.
    CHECK(scene.points[7] == glm::dvec3(0.75, -2.5, -0.5));
  }

  TEST_CASE("defaults") {
    const SceneFile file = read(triangle);
    CHECK(file.scene.name == "s");
    CHECK(file.scene.raster == Raster{64, 64, false});
    CHECK(file.scene.camera.rho == 0);
    CHECK(file.scene.camera.d == 2);
    CHECK(file.scene.polygons[0] == Polygon{"A", palette[0], 1});
    CHECK(file.scene.point_lines == std::vector<std::int32_t>{2, 2, 2});
    CHECK(file.conventions.cull);
  }

  TEST_CASE("polygons and meshes keep the order of the file, unnamed ones take free letters") {
    const Scene scene =
        read("[[mesh]]\nbuiltin = \"cube\"\n" + triangle + "name = \"C\"\n[[mesh]]\nbuiltin = \"pyramid\"\n" + triangle)
            .scene;
    REQUIRE(scene.polygons.size() == 6 + 1 + 5 + 1);
    CHECK(scene.polygons[6].name == "C");
    CHECK(scene.polygons[6].source_line == 3);
    CHECK(scene.polygons[0].name == "A");
    CHECK(scene.polygons[2].name == "D");
    CHECK(scene.polygons[7].source_line == 6);
    CHECK(scene.facets[7].polygon == 7);
    CHECK(
        scene.points[static_cast<std::size_t>(scene.corners[static_cast<std::size_t>(scene.facets[7].first_corner)])] ==
        glm::dvec3(1, 1, -1));
  }

  TEST_CASE("polygons share the points they have in common") {
    const Scene scene = read(triangle + "[[polygon]]\npoints = [[1, 0, -0.0], [1, 1, 0], [0, 1, 0]]\n").scene;
    CHECK(scene.points.size() == 4);
    CHECK(scene.corners == std::vector<std::int32_t>{0, 1, 2, 1, 3, 2});
  }

  TEST_CASE("a mirrored mesh is turned round") {
    const Scene plain = read("[[mesh]]\nbuiltin = \"cube\"\n").scene,
                mirrored = read("[[mesh]]\nbuiltin = \"cube\"\nscale = [-1, 2, 1]\n").scene;
    const auto ring = [](const Scene& scene) {
      return std::vector<std::int32_t>(scene.corners.begin() + 4, scene.corners.begin() + 8);
    };
    CHECK(ring(plain) == std::vector<std::int32_t>{1, 2, 6, 5});
    CHECK(ring(mirrored) == std::vector<std::int32_t>{1, 5, 6, 2});
    CHECK(mirrored.points[0] == glm::dvec3(1, -2, -1));
  }

  TEST_CASE("screen coordinates") {
    const SceneFile file = read(
        "coordinates = \"screen\"\n[raster]\ny_axis = \"up\"\n[[polygon]]\npoints = [[0, 1], [2, 3, 4], [5, 6]]\n");
    CHECK(file.scene.camera.kind == Camera::Kind::screen);
    CHECK(file.scene.raster.y_up);
    CHECK(file.scene.points == std::vector<glm::dvec3>{{0, 1, 0}, {2, 3, 4}, {5, 6, 0}});
    CHECK(!file.conventions.cull);
  }

  TEST_CASE("options and cameras") {
    const SceneFile file = read(
        "[options]\ndepth = \"view\"\ninterpolation = \"increments\"\ncoverage = \"inclusive\"\ncull = false\n"
        "[camera]\northographic = true\neye = [5, 0, 0]\nfield_of_view = 90\nd = 3\n" +
        triangle);
    CHECK(file.conventions.depth == Conventions::Depth::view);
    CHECK(file.conventions.interpolation == Conventions::Interpolation::increments);
    CHECK(file.conventions.coverage == Conventions::Coverage::inclusive);
    CHECK(!file.conventions.cull);
    CHECK(file.scene.camera.kind == Camera::Kind::orthographic);
    CHECK(!file.scene.camera.polar);
    CHECK(file.scene.camera.window == doctest::Approx(3));
    CHECK((file.scene.camera.view * glm::dvec4(0, 1, 0, 1)) == glm::dvec4(1, 0, 5, 1));
  }

  TEST_CASE("which depth wins, what the buffer begins with and how outlines are filled") {
    const SceneFile file = read(
        triangle + "[options]\nties = \"last\"\nnearer = \"by-depth\"\ninitial_depth = \"far\"\nfill = \"non-zero\"\n");
    const std::map<std::string, std::string> wanted{{"ties", "last"}, {"initial-depth", "far"}, {"fill", "non-zero"}};
    CHECK(file.conventions.options == wanted);
    CHECK(contains(error_of(triangle + "[options]\nties = \"both\"\n"), "s.toml:4"));
  }

  TEST_CASE("a projection matrix of one's own, and a far plane at infinity") {
    // gluPerspective(90, 2, ...): half of the window's height is d, half of its width twice that.
    const std::string projection = "projection = [[0.5, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, -1], [0, 0, -1, 0]]\n";
    const SceneFile file = read("raster.width = 60\nraster.height = 30\n" + triangle + "[camera]\neye = [5, 0, 0]\n" +
                                projection + "near = 0.5\nfar = inf\n");
    const Scene own = look_at_scene(file.scene, {});
    const Scene plain = look_at_scene(read("raster.width = 60\nraster.height = 30\n" + triangle +
                                           "[camera]\neye = [5, 0, 0]\nd = 1\nwindow = 1\nnear = 0.5\nfar = 60\n")
                                          .scene,
                                      {});
    CHECK(own.camera.view == plain.camera.view);
    CHECK(own.camera.eye == plain.camera.eye);
    CHECK(own.camera.window == 1);
    CHECK(is_infinitely_far(own.camera));
    ViewOptions wider;  // another shape of the raster, the same matrix: squeezed
    wider.width = 30;
    CHECK(look_at_scene(file.scene, wider).camera.view[1][0] == doctest::Approx(own.camera.view[1][0] / 2));
    wider.window = 2;  // a camera of zstep's from there on
    CHECK(!look_at_scene(file.scene, wider).camera.matrices);
    const auto with_row = [&](const std::string& row, const std::string& more) {
      std::string text = projection;
      text.replace(text.find("[0, 0, -1, -1]"), 14, row);
      return input_error([&] {
        look_at_scene(read(triangle + "[camera]\neye = [5, 0, 0]\n" + text + "near = 0.5\nfar = inf\n" + more).scene,
                      {});
      });
    };
    CHECK(
        contains(with_row("[0, 0, 9, 9]", ""), "the row of z_c of its projection gives 9 at near = 0.5 and -9 at far"));
    CHECK(with_row("[0, 0, 0, 0]", "") == "no error");
    CHECK(with_row("[0, 0, -0.75, 0]", "").find("0.75 at near") != std::string::npos);
    CHECK(with_row("[0, 0, -0.75, -0.25]", "depth_range = [0.25, 0.75]\n") == "no error");
    CHECK(contains(error_of(triangle + "[camera]\ndepth_range = [1, 0]\n"), "the smaller one first"));
    CHECK(contains(error_of(triangle + "[camera]\ndepth_range = [1]\n"), "two numbers"));
    CHECK(contains(error_of(triangle + "[camera]\n" + projection), "'projection' stands without 'eye'"));
    CHECK(contains(error_of(triangle + "[camera]\neye = [5, 0, 0]\nd = 1\n" + projection), "keep one"));
    CHECK(contains(error_of(triangle + "[camera]\neye = [5, 0, 0]\nprojection = [[1, 0], [0, 1]]\n"),
                   "does not have four rows"));
  }

  TEST_CASE("what is not known is an error that names the line and the nearest word") {
    CHECK(error_of("bakground = \"white\"\n" + triangle) ==
          "s.toml:1: unknown key 'bakground' in the scene; did you mean 'background'?");
    CHECK(error_of(triangle + "colour = \"red\"\n") ==
          "s.toml:3: unknown key 'colour' in [[polygon]]; did you mean 'color'?");
    CHECK(error_of(triangle + "\n[camera]\nrho = 4\npih = 60\n") ==
          "s.toml:6: unknown key 'pih' in [camera]; did you mean 'phi'?");
    CHECK(contains(error_of(triangle + "[raster]\nsomething = 4\n"), "known are: width, height, y_axis"));
    CHECK(error_of(triangle + "color = \"vermilion\"\n") ==
          "s.toml:3: 'vermilion' is no colour; did you mean 'vermillion'?");
    CHECK(error_of(triangle + "color = \"#12345\"\n") == "s.toml:3: '#12345' is no colour; write #rrggbb");
    CHECK(error_of(triangle + "[options]\ndepth = \"pseudo\"\n") ==
          "s.toml:4: depth is 'pseudo'; did you mean 'pseudodepth'?");
    CHECK(error_of("[[mesh]]\nbuiltin = \"teapod\"\n") ==
          "s.toml:2: there is no built-in mesh 'teapod'; did you mean 'teapot'?");
    CHECK(contains(error_of("[[mesh]]\nbuiltin = \"teapot:65\"\n"),
                   "s.toml:1: the level is not a whole number from 1 to 64; write teapot:8"));
  }

  TEST_CASE("errors of meaning") {
    CHECK(contains(error_of(""), "s.toml: the scene has no polygons"));
    CHECK(contains(error_of("x = [1\n"), "s.toml:"));
    CHECK(contains(error_of("[[polygon]]\nname = \"A\"\n"), "s.toml:1: the polygon has no points"));
    CHECK(contains(error_of("[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0]]\n"),
                   "s.toml:1: the polygon has fewer than three corners"));
    CHECK(contains(error_of("[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0], [1, 0]]\n"),
                   "s.toml:2: a point is not a point; write [x, y, z]"));
    CHECK(contains(error_of("[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0],\n[1, nan, 0]]\n"),
                   "s.toml:3: y of a point is nan"));
    CHECK(contains(error_of("[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0],\n[1, \"a\", 0]]\n"),
                   "s.toml:3: y of a point is a text; write a number"));
    CHECK(contains(error_of("[[polygon]]\ncorners = [0, 1, 2]\n"), "put points = "));
    CHECK(contains(error_of("points = [[0, 0, 0]]\n[[polygon]]\ncorners = [0, 0, 1]\n"), "the indices are 0 to 0"));
    CHECK(contains(error_of("polygon = 3\n"), "s.toml:1: polygon is a whole number"));
    CHECK(contains(error_of("polygon = [3]\n"), "s.toml:1: polygon is not a table"));
    CHECK(contains(error_of(triangle + "name = \"A\"\n" + triangle + "name = \"A\"\n"),
                   "s.toml:6: a polygon named 'A' stands at line 1 already"));
    CHECK(contains(error_of(triangle + "[camera]\nrho = -1\n"), "s.toml:4: rho is -1; it must be greater than 0"));
    CHECK(contains(error_of(triangle + "[camera]\nrho = 1\neye = [1, 0, 0]\n"), "both 'rho' and 'eye'"));
    CHECK(contains(error_of(triangle + "[camera]\ntarget = [1, 0, 0]\n"), "'target' stands without 'eye'"));
    CHECK(contains(error_of(triangle + "[camera]\neye = [1, 0, 0]\ntarget = [1, 0, 0]\n"),
                   "the eye stands at its target"));
    CHECK(contains(error_of(triangle + "[camera]\nwindow = 1\nfield_of_view = 30\n"), "keep one"));
    CHECK(contains(error_of(triangle + "[camera]\nfield_of_view = 180\n"), "not below 180"));
    CHECK(contains(error_of(triangle + "[camera]\nnear = 2\nfar = 1\n"), "s.toml:5: far is not greater than near"));
    CHECK(contains(error_of(triangle + "[raster]\nwidth = 0\n"),
                   "s.toml:4: width is not a whole number from 1 to 16384"));
    CHECK(contains(error_of(triangle + "[raster]\nwidth = 16384\nheight = 16384\n"), "more than 33554432 pixels"));
    CHECK(contains(error_of(triangle + "[raster]\ny_axis = \"left\"\n"), "y_axis"));
    CHECK(contains(error_of("coordinates = \"screen\"\n" + triangle + "[camera]\nrho = 3\n"), "has no camera"));
    CHECK(contains(error_of("coordinates = \"screen\"\n[[mesh]]\nbuiltin = \"cube\"\n"), "a mesh cannot stand"));
    CHECK(contains(error_of("[[mesh]]\nscale = 2\n"), "neither 'file' nor 'builtin'"));
    CHECK(contains(error_of("[[mesh]]\nbuiltin = \"cube\"\nscale = [1, 0, 1]\n"), "a scale of 0"));
    CHECK(contains(error_of("[[mesh]]\nbuiltin = \"cube\"\nscale = 1e30\ntranslate = [1e30, 0, 0]\n"), "once placed"));
    CHECK(contains(error_of("[[mesh]]\nfile = \"nothing.off\"\n"), "there is no such file"));
    CHECK(contains(error_of("[[mesh]]\nfile = \"arrow.mtl\"\n"), "its extension names no mesh format"));
  }

  TEST_CASE("deep keys, long files, endless meshes") {
    std::string deep, header = "[";
    for (int i = 0; i < 200000; ++i) {
      deep += "a.";
      header += "\"a\" . ";
    }
    CHECK(contains(error_of("x = 1\n" + deep + "a = 1\n"), "s.toml:2: a key has more than 32 parts"));
    CHECK(contains(error_of(header + "a]\n"), "s.toml:1: a key has more than 32 parts"));
    CHECK(contains(error_of("x = {" + deep + "a = 1}\n"), "a key has more than 32 parts"));
    CHECK(contains(error_of("x = \"\"\"\"\"\"\n" + deep + "a = 1\n"), "a key has more than 32 parts"));
    CHECK(contains(error_of("x = '''\n'''''\n" + deep + "a = 1\n"), "s.toml:3: a key has more than 32 parts"));
    CHECK(contains(error_of("x = \"\\\"\"\n" + deep + "a = 1\n"), "a key has more than 32 parts"));
    // Dots that part no keys: in comments, strings and numbers.
    CHECK(error_of("# " + std::string(100, '.') + "\nname = \"" + std::string(100, '.') + "\" # " +
                   std::string(100, '.') + "\n" + triangle) == "no error");
    std::string many = "[[polygon]]\npoints = [[0.5, 0.5, 0.5]";
    for (int i = 0; i < 100; ++i) many += ", [0.5, 0.25, 0.125]";
    CHECK(error_of(many + "]\n") == "no error");
    CHECK(contains(error_of(std::string(3 << 20, '\n')), "at most 2097152 bytes"));
    std::string meshes;
    for (int i = 0; i < 1000; ++i) meshes += "[[mesh]]\nbuiltin = \"teapot:64\"\n";
    CHECK(contains(error_of(meshes), "there are more than"));
    std::string brackets = "x = ";
    for (int i = 0; i < 100000; ++i) brackets += "[";
    CHECK(contains(error_of(brackets), "s.toml:1"));
  }

  TEST_CASE("cut short after every byte, and every byte changed: a scene or an InputError") {
    const std::string text = examples("docs/scene-format.md")[1];
    for (std::size_t size = 0; size < text.size(); size += 3) error_of(text.substr(0, size));
    for (std::size_t at = 0; at < text.size(); at += 2)
      for (const int change : {0x01, 0x10, 0x80}) {
        std::string changed = text;
        changed[at] = static_cast<char>(changed[at] ^ change);
        error_of(changed);
      }
  }
}
