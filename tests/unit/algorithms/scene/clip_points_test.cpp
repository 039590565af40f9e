// Scenes whose points are in clip coordinates.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "tests/golden/golden.hpp"
#include "tests/matrices.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "traces/check/check.hpp"
#include "traces/formulas/walk.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;

namespace {

Scene read(const std::string& text) {
  return look_at_scene(read_scene(text, "s.toml", "s", [](const std::string&) { return PolygonSoup(); }).scene, {});
}

/// The polygons of a scene through its matrices, as a program would have them before the division by w.
std::string in_clip_coordinates(const Scene& scene, const char* coordinates) {
  const glm::dmat4 all = scene.camera.matrices->projection * scene.camera.matrices->view;
  std::string text = fmt::format("coordinates = \"{}\"\n[raster]\nwidth = {}\nheight = {}\n[options]\ncull = false\n",
                                 coordinates, scene.raster.width, scene.raster.height);
  for (const Facet& facet : scene.facets) {
    text += "[[polygon]]\npoints = [";
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const glm::dvec4 c = all * glm::dvec4(scene.points[scene.corners[facet.first_corner + k]], 1);
      text += fmt::format("[{}, {}, {}, {}], ", c.x, c.y, c.z, c.w);
    }
    text += "]\n";
  }
  return text;
}

/// glFrustum()'s matrix, and the same with z_c from 0 to w_c.
Scene through(const char* name, bool from_zero) {
  ViewOptions view;
  view.width = 33, view.height = 22, view.theta = 33, view.phi = 62;
  glm::dmat4 matrix = frustum(-0.1, 0.4, -0.25, 0.15, 0.5, 9);
  if (from_zero)
    for (int column = 0; column < 4; ++column) matrix[column][2] = (matrix[column][2] + matrix[column][3]) / 2;
  return seen_through(look_at_scene(load_scene(name).scene, view), matrix, 0.5, 9);
}

const std::string head = "coordinates = \"clip\"\n[[polygon]]\npoints = ";

}  // namespace

TEST_SUITE("scenes in clip coordinates") {
  TEST_CASE("show the picture of the scene that they come from, also what is partly behind the eye") {
    for (const char* name : {"pyramid-behind", "cube", "cyclic"})
      for (const bool from_zero : {false, true}) {
        CAPTURE(name);
        CAPTURE(from_zero);
        const Scene scene = through(name, from_zero),
                    clip = read(in_clip_coordinates(scene, from_zero ? "clip_zero_to_one" : "clip"));
        CHECK(clip.camera.near == doctest::Approx(0.5));
        CHECK(clip.camera.far == doctest::Approx(9));
        Conventions conventions;
        conventions.cull = false, conventions.depth = Conventions::Depth::zero_to_one;
        const Trace run = recorded_by("z-buffer", clip, conventions);
        CHECK(check(run).causes.empty());
        const Picture one = formulas::end_of(recorded_by("z-buffer", scene, conventions)).picture,
                      other = formulas::end_of(run).picture;
        CHECK(one.polygon == other.polygon);
        for (std::size_t pixel = 0; pixel < one.depth.size(); ++pixel)
          if (one.polygon[pixel] != no_polygon) CHECK(one.depth[pixel] == doctest::Approx(other.depth[pixel]));
      }
  }

  TEST_CASE("what is not of one projection is refused by its line") {
    const auto error = [](const std::string& text) { return input_error([&] { read(text); }); };
    CHECK(contains(error(head + "[[0, 0, 1], [1, 0, 1], [0, 1, 2]]\n"),
                   "s.toml:3: a point in clip coordinates does not"));
    CHECK(contains(error(head + "[[0, 0, 0, 1],\n[1, 0, 2, 3],\n[0, 1, 5, 2]]\n"),
                   "s.toml:5: z is 5, and other points say z = 1 w -1, which is 1"));
    CHECK(contains(error(head + "[[0, 0, 1, 1], [1, 0, 2, 2], [0, 1, 3, 3]]\n"), "no projection with a near plane"));
    CHECK(
        contains(error(head + "[[0, 0, 0.5, 1], [1, 0, 0.5, 1], [0, 1, 0.5, 1]]\n"), "give near and far in [camera]"));
    CHECK(contains(error(head + "[[0, 0, 0, 1], [1, 0, 1, 2], [0, 1, 2, 3]]\n[camera]\nrho = 3\n"),
                   "'rho' stands in a scene in clip coordinates"));
    CHECK(contains(error(head + "[[0, 0, 0, 1], [1, 0, 1, 2], [0, 1, 2, 3]]\n[light]\nposition = [1, 1, 1]\n"),
                   "needs a scene in world coordinates"));
    CHECK(contains(error(head + "[[0, 0, 0, 1], [1, 0, 1, 2], [0, 1, 2, 3]]\n[[mesh]]\nbuiltin = \"cube\"\n"),
                   "a mesh cannot stand in a scene in clip coordinates"));
  }

  TEST_CASE("planes: at infinity, reversed, and given where all points have the same w") {
    const Scene infinite = read(head + "[[0, 0, 0, 1], [1, 0, 1, 2], [0, 1, 2, 3]]\n");
    CHECK(infinite.camera.near == doctest::Approx(0.5));
    CHECK(is_infinitely_far(infinite.camera));
    // z_c = -w_c/8 + 9/8: 1 at w = 1, 0 at w = 9.
    const Scene reversed = read(
        "coordinates = \"clip_zero_to_one\"\n[[polygon]]\npoints = [[0, 0, 0.875, 2], [1, 0, 0.875, "
        "2], [0, 1, 0.5, 5]]\n");
    CHECK(reversed.camera.near == doctest::Approx(1));
    CHECK(reversed.camera.far == doctest::Approx(9));
    const std::string card = head + "[[0, 0, 0.5, 1], [1, 0, 0.5, 1], [0, 1, 0.5, 1]]\n";
    CHECK(read(card + "[camera]\nnear = 0.5\nfar = 1.5\n").camera.far == 1.5);
    CHECK(contains(input_error([&] { read(card + "[camera]\nnear = 0.5\nfar = 3\n"); }), "z is 0.5"));
  }
}
