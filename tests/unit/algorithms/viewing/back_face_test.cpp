// The four formulations of the back-face test agree, on polygons of every shape and from everywhere.
#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "algorithms/viewing/back_face.hpp"
#include "algorithms/viewing/clip.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

FacingTest facing_of(const Scene& scene) {
  CollectRecorder record;
  const viewing::Lens lens(scene.camera, scene.raster, Conventions::Depth::pseudodepth);
  const viewing::Vertices vertices = viewing::view_vertices(scene, lens, record);
  const Facing facing = clipping::test_facing(scene, scene.corners, vertices, record);
  const FacingTest test = record.all<FacingTest>().at(0);
  CHECK(test.facing == facing);
  return test;
}

// Counter-clockwise as seen from the point `from`, or the other way round.
Scene triangle_seen_from_x(bool front) {
  Scene scene;
  test::add_polygon(scene, std::vector<glm::dvec3>{{0, -1, -1}, {0, 1, -1}, {0, 0, 1}});
  if (!front) std::swap(scene.corners[0], scene.corners[1]);
  return scene;
}

}  // namespace

TEST_SUITE("viewing/back_face") {
  TEST_CASE("a triangle seen from its front and from its back") {
    for (const auto kind : {Camera::Kind::perspective, Camera::Kind::orthographic}) {
      Scene scene = triangle_seen_from_x(true);
      test::look(scene, kind, 4, 0, 90, 1, 10);
      FacingTest test = facing_of(scene);
      CHECK(test.facing == Facing::front);
      CHECK(test.determinant > 0);
      CHECK(test.plane_at_eye > 0);
      CHECK(test.view_dot_normal < 0);
      CHECK(test.projected_normal_z < 0);

      scene = triangle_seen_from_x(false);
      test::look(scene, kind, 4, 0, 90, 1, 10);
      test = facing_of(scene);
      CHECK(test.facing == Facing::back);
      CHECK(test.determinant < 0);
      CHECK(test.plane_at_eye < 0);
      CHECK(test.view_dot_normal > 0);
      CHECK(test.projected_normal_z > 0);
    }
  }

  TEST_CASE("the numbers of Eckert's determinant, and the same from the other two in space") {
    Scene scene = triangle_seen_from_x(true);
    test::look(scene, Camera::Kind::perspective, 4, 0, 90, 1, 10);
    const FacingTest test = facing_of(scene);
    // V0 = (-1, -1, 4), V1 = (1, -1, 4), V2 = (0, 1, 4): |V0 V1 V2| = 16; twice the area, 4, times the distance, 4
    CHECK(test.determinant == doctest::Approx(16));
    CHECK(test.plane_at_eye == doctest::Approx(16));
    CHECK(test.view_dot_normal == doctest::Approx(-16));
  }

  TEST_CASE("all four agree on thousands of random polygons, wherever none is within rounding of zero") {
    test::Numbers random(4711);
    int front = 0, back = 0;
    for (int run = 0; run < 10000; ++run) {
      const bool perspective = run % 2 == 0;
      Scene scene;
      const double radius = random.between(0.05, 1);
      const glm::dvec3 centre = random.in_box(2);
      test::add_polygon(scene, test::random_star(random, centre, radius, 3 + run % 7));
      const double distance = random.between(6, 20);
      const glm::dvec3 eye = glm::normalize(random.in_box(1)) * distance;
      test::look(scene, perspective ? Camera::Kind::perspective : Camera::Kind::orthographic, eye, random.in_box(1),
                 0.5, 40);

      const FacingTest test = facing_of(scene);
      REQUIRE(std::isfinite(test.projected_normal_z));
      const double line = perspective ? glm::length(eye) : 1;
      const double normal = glm::length(clipping::newell_normal(scene, scene.corners));
      if (std::abs(test.view_dot_normal) < 1e-9 * line * normal) continue;
      const bool faces_away = test.facing == Facing::back;
      REQUIRE(test.facing != Facing::edge_on);
      REQUIRE((test.determinant < 0) == faces_away);
      REQUIRE((test.plane_at_eye < 0) == faces_away);
      REQUIRE((test.view_dot_normal > 0) == faces_away);
      REQUIRE((test.projected_normal_z > 0) == faces_away);
      REQUIRE(-test.determinant == doctest::Approx(test.view_dot_normal).epsilon(1e-6));
      ++(faces_away ? back : front);
    }
    CHECK(front > 4000);
    CHECK(back > 4000);
  }

  TEST_CASE("three consecutive vertices of a concave polygon mislead, the whole polygon does not") {
    Scene scene;  // an arrowhead whose first three corners turn the other way
    test::add_polygon(scene, std::vector<glm::dvec3>{{0, -1, -1}, {0, 0, -0.5}, {0, 1, -1}, {0, 0, 1}});
    test::look(scene, Camera::Kind::perspective, 4, 0, 90, 1, 10);
    CHECK(facing_of(scene).facing == Facing::front);
    CHECK(facing_of(scene).determinant > 0);
    Scene corner = scene;
    corner.corners.resize(3);
    CHECK(facing_of(corner).facing == Facing::back);
  }

  TEST_CASE("a polygon through the eye's plane is edge-on, one with a vertex behind the eye has no projected normal") {
    Scene scene;
    test::add_polygon(scene, std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    test::look(scene, Camera::Kind::perspective, 4, 37, 90, 1, 10);
    CHECK(facing_of(scene).facing == Facing::edge_on);
    test::look(scene, Camera::Kind::orthographic, 4, 37, 90, 1, 10);
    CHECK(facing_of(scene).facing == Facing::edge_on);

    test::look(scene, Camera::Kind::perspective, {-0.5, 0.2, 1}, {1, 0.2, 0}, 0.1, 10);
    CHECK(facing_of(scene).facing == Facing::front);
    CHECK(std::isfinite(facing_of(scene).projected_normal_z));
    scene.points[0].x = -9;
    CHECK(facing_of(scene).facing == Facing::front);
    CHECK(std::isnan(facing_of(scene).projected_normal_z));
  }
}
