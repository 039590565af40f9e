// Hidden lines of polygons that touch, cross, coincide, or are none.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/hidden_line/line_runs.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;
using namespace zstep::hidden_line;
using namespace zstep::test;

TEST_SUITE("hidden_line/degenerate") {
  const std::vector<glm::dvec3> flat = {{2, 2, 1}, {20, 2, 1}, {20, 20, 1}, {2, 20, 1}};

  TEST_CASE("nothing, a single polygon, and what is no polygon") {
    CHECK(hide(test::screen_scene(32, 32, {})).inked() == 0);
    CHECK(hide(test::screen_scene(32, 32, {flat})).pieces_of(true) == 4);
    CHECK(hide(test::screen_scene(32, 32, {flat})).lines_of(LineKind::boundary) == 4);
    CHECK(hide(test::screen_scene(32, 32, {{{1, 1, 0}, {5, 5, 0}, {3, 3, 0}}})).inked() == 0);
    CHECK(hide(test::screen_scene(32, 32, {{{1, 1, 0}, {5, 5, 0}}})).inked() == 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(hide(test::screen_scene(32, 32, {{{1, 1, 0}, {nan, 5, 0}, {3, 9, 0}}})).inked() == 0);
  }

  TEST_CASE("duplicates and coplanar polygons hide nothing of each other") {
    const Run twice = hide(test::screen_scene(32, 32, {flat, flat}));
    CHECK(twice.pieces_of(true) == 8);
    CHECK(twice.pieces_of(false) == 0);
    const Run overlap = hide(test::screen_scene(32, 32, {flat, {{10, 10, 1}, {28, 10, 1}, {28, 28, 1}, {10, 28, 1}}}));
    CHECK(overlap.pieces_of(false) == 0);
  }

  TEST_CASE("cyclic: each of three hides a part of the next") {
    const Run run = hide(seen("cyclic"), false);
    check_sums(run);
    CHECK(run.lines.size() == 9);
    CHECK(run.pieces_of(false) >= 3);
    CHECK(run.pieces_of(true) >= 9);
  }

  TEST_CASE("intersecting: edges end where they go into a face") {
    const Run run = hide(seen("intersecting"), false);
    check_sums(run);
    const std::vector<LineCross> crossings = run.record.all<LineCross>();
    CHECK(std::any_of(crossings.begin(), crossings.end(), [](const LineCross& c) { return c.in_space; }));
  }

  TEST_CASE("a face seen edge-on hides nothing, its edges are drawn") {
    const Run run =
        hide(test::screen_scene(32, 32, {{{5, 5, 0}, {15, 15, 3}, {15, 15, 0}}, {{2, 8, 5}, {28, 8, 5}, {20, 28, 5}}}));
    check_sums(run);
    CHECK(run.pieces_of(false) == 0);
  }

  TEST_CASE("an edge seen end-on is a point, and is not drawn") {
    const Run run = hide(test::screen_scene(32, 32, {{{5, 5, 0}, {5, 5, 3}, {15, 9, 0}}}));
    CHECK(run.lines.size() == 2);
  }

  TEST_CASE("a polygon that is not planar: the cuts between its facets are no edges") {
    Scene scene = test::screen_scene(32, 32, {});
    scene.points = {{2, 2, 0}, {20, 2, 0}, {20, 20, 5}, {2, 20, 0}};
    scene.polygons.push_back({"A", {}, 0});
    scene.corners = {0, 1, 2, 0, 2, 3};
    scene.facets = {{0, 0, 3}, {0, 3, 3}};
    CHECK(hide(scene).lines.size() == 4);
    CHECK(wires(scene).lines.size() == 4);
  }

  TEST_CASE("a third face at an edge and neighbours that run the other way round: all is drawn") {
    Scene scene = test::screen_scene(32, 32, {});
    scene.points = {{2, 2, 0}, {20, 2, 0}, {20, 20, 5}, {2, 20, 0}, {9, 28, 0}};
    for (const auto& corners : std::vector<std::vector<std::int32_t>>{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 1, 4}})
      test::add_polygon(scene, corners);
    const Run run = hide(scene);
    check_sums(run);
    CHECK(run.lines.size() >= 8);
  }

  TEST_CASE("lines far beyond the raster cost no more than the raster") {
    const Run run = hide(test::screen_scene(32, 32, {{{-9e8, 16, 0}, {9e8, 16, 0}, {0, 9e8, 0}}}));
    CHECK(run.inked() == 32);
  }
}
