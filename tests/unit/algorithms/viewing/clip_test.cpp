// Clipping in homogeneous coordinates: what is left, how it is numbered, and that shared edges stay shared.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "algorithms/viewing/clip.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

struct Clipped {
  CollectRecorder record;
  viewing::Vertices vertices;
  clipping::Outline outline;
  bool drawn = false;
};

Clipped clip(const Scene& scene, std::size_t facet = 0) {
  Clipped result;
  const viewing::Lens lens(scene.camera, scene.raster, Conventions::Depth::pseudodepth);
  result.vertices = viewing::view_vertices(scene, lens, result.record);
  result.drawn =
      clipping::find_outline(scene, scene.facets[facet], false, lens, result.vertices, result.outline, result.record);
  return result;
}

// The eye at the origin looks along -x_w; z_w is up and y_w to the right.
Scene seen_from_origin(const std::vector<glm::dvec3>& view_points) {
  Scene scene;
  std::vector<glm::dvec3> world;
  for (const glm::dvec3& v : view_points) world.push_back({-v.z, v.x, v.y});
  test::add_polygon(scene, world);
  test::look(scene, Camera::Kind::perspective, glm::dvec3(0, 0, 0), {-1, 0, 0}, 1, 10);
  scene.raster = {32, 32, false};
  return scene;
}

}  // namespace

TEST_SUITE("viewing/clip") {
  TEST_CASE("what lies inside is left alone") {
    const Clipped result = clip(seen_from_origin({{-1, -1, 4}, {1, -1, 4}, {0, 1, 4}}));
    CHECK(result.drawn);
    CHECK(result.outline == clipping::Outline{0, 1, 2});
    CHECK(result.record.all<ClipTest>().at(0).outside_some == 0);
    CHECK(result.record.all<ClipVertex>().empty());
    CHECK(result.record.all<OutlineVertex>().size() == 3);
  }

  TEST_CASE("what lies outside one plane is rejected without being clipped") {
    const Clipped result = clip(seen_from_origin({{9, -1, 4}, {12, -1, 4}, {9, 1, 4}}));
    CHECK(!result.drawn);
    CHECK(result.record.all<ClipTest>().at(0).outside_all == 1 << static_cast<int>(ClipPlane::right));
    CHECK(result.record.all<PolygonReject>().at(0).reason == Reject::outside);
    CHECK(result.record.all<ClipVertex>().empty());
  }

  TEST_CASE("a corner cut off by the near plane: two new vertices, numbered after the scene's, with their projection") {
    const Clipped result = clip(seen_from_origin({{0, -0.5, 3}, {0.4, 0.5, 3}, {0, 0, -1}}));
    CHECK(result.drawn);
    CHECK(result.outline == clipping::Outline{0, 1, 3, 4});
    const auto crossings = result.record.all<ClipCross>();
    REQUIRE(crossings.size() == 2);
    CHECK(crossings[0].plane == ClipPlane::near);
    CHECK(crossings[0].vertex_inside == 1);
    CHECK(crossings[0].vertex_outside == 2);
    CHECK(crossings[0].t == doctest::Approx(0.5));  // from z_v = 3 to -1, the plane at 1
    CHECK(crossings[0].z_v == doctest::Approx(1));
    CHECK(crossings[1].vertex_inside == 0);  // from the inside end again
    int against_near = 0;  // the point behind the eye is outside the planes at the sides too, so they are tried as well
    for (const ClipVertex& vertex : result.record.all<ClipVertex>()) against_near += vertex.plane == ClipPlane::near;
    CHECK(against_near == 3);
    // Projected: the two points in front of the near plane at first, then the two new ones.
    std::vector<std::int32_t> projected;
    for (const Projection& projection : result.record.all<Projection>()) projected.push_back(projection.vertex);
    CHECK(projected == std::vector<std::int32_t>{0, 1, 3, 4});
    CHECK(result.record.all<Projection>().back().z == doctest::Approx(-1));
  }

  TEST_CASE("a vertex exactly on a plane is inside and makes no new vertex") {
    const Clipped result = clip(seen_from_origin({{0, 0, 1}, {0.5, 0.5, 4}, {-0.5, 0.5, 4}}));
    CHECK(result.outline == clipping::Outline{0, 1, 2});
    const Clipped cut = clip(seen_from_origin({{0, 0, 1}, {0.5, 0, 4}, {0, 0.5, -4}}));
    CHECK(cut.drawn);
    CHECK(cut.record.all<ClipCross>().size() == 1);
  }

  TEST_CASE("new vertices are numbered anew for each facet") {
    Scene scene = seen_from_origin({{0, -0.5, 3}, {0.4, 0.5, 3}, {0, 0, -1}});
    test::add_polygon(scene, {1, 0, 2});
    CHECK(clip(scene, 1).outline == clipping::Outline{1, 0, 3, 4});
  }

  TEST_CASE("random polygons around the eye: the outline lies in the view volume and its area is what sampling says") {
    test::Numbers random(99);
    int clipped = 0;
    for (int run = 0; run < 3000; ++run) {
      std::vector<glm::dvec3> points;
      for (int i = 0; i < 3; ++i) points.push_back(random.in_box(6));
      const Scene scene = seen_from_origin(points);
      const Clipped result = clip(scene);
      if (!result.drawn) continue;
      clipped += !result.record.all<ClipCross>().empty();
      for (const std::int32_t index : result.outline) {
        const viewing::Vertex& vertex = result.vertices[static_cast<std::size_t>(index)];
        REQUIRE(vertex.raster.x >= -0.5 - 1e-9);
        REQUIRE(vertex.raster.x <= 31.5 + 1e-9);
        REQUIRE(vertex.raster.y >= -0.5 - 1e-9);
        REQUIRE(vertex.raster.y <= 31.5 + 1e-9);
        REQUIRE(vertex.raster.z >= -1 - 1e-9);
        REQUIRE(vertex.raster.z <= 1 + 1e-9);
        REQUIRE(vertex.view.z >= 1 - 1e-9);
        REQUIRE(vertex.view.z <= 10 + 1e-9);
      }
    }
    CHECK(clipped > 500);
  }

  TEST_CASE("two polygons that share an edge cut it in the same bits, whichever way round they run") {
    test::Numbers random(7);
    int shared = 0;
    for (int run = 0; run < 2000; ++run) {
      Scene scene = seen_from_origin({random.in_box(5), random.in_box(5), random.in_box(5), random.in_box(5)});
      scene.facets.clear(), scene.corners.clear(), scene.polygons.clear();
      test::add_polygon(scene, {0, 1, 2});
      test::add_polygon(scene, {1, 0, 3});
      // The pieces of the edge between 0 and 1 that each of them makes, by plane.
      std::map<std::pair<int, bool>, glm::dvec3> first;
      for (std::size_t facet = 0; facet < 2; ++facet) {
        const Clipped result = clip(scene, facet);
        std::set<std::int32_t> on_edge{0, 1};  // vertices known to lie on the shared edge
        for (const ClipCross& cross : result.record.all<ClipCross>()) {
          if (!on_edge.count(cross.vertex_inside) || !on_edge.count(cross.vertex_outside)) continue;
          on_edge.insert(cross.vertex);
          const auto key = std::make_pair(static_cast<int>(cross.plane), cross.vertex_inside == 0);
          const glm::dvec3 point(cross.x_v, cross.y_v, cross.z_v);
          if (facet == 0) first[key] = point;
          if (facet == 0 || !first.count(key)) continue;
          REQUIRE(first[key] == point);
          ++shared;
        }
      }
    }
    CHECK(shared > 500);
  }
}
