// Input that is no picture of anything, and polygons that share a plane: a stated outcome each.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "algorithms/bsp/bsp.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using namespace zstep::bsp;
using test::screen_scene;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

using Points = std::vector<glm::dvec3>;

Conventions drawn_from(const std::string& order) {
  Conventions conventions;
  conventions.cull = false;
  conventions.options["order"] = order;
  conventions.options["root"] = "first";
  return conventions;
}

struct Run {
  CollectRecorder record;
  Picture picture;
  explicit Run(const Scene& scene, const std::string& order = "back-to-front")
      : picture(run(scene, drawn_from(order), record)) {}
  std::int64_t pixels() const {
    return std::count_if(picture.polygon.begin(), picture.polygon.end(), [](std::int32_t p) { return p >= 0; });
  }
  std::vector<Reject> rejects() const {
    std::vector<Reject> all;
    for (const PolygonReject& reject : record.all<PolygonReject>()) all.push_back(reject.reason);
    return all;
  }
};

Picture z_buffered(const Scene& scene) {
  NullRecorder nothing;
  return z_buffer::run(scene, drawn_from("back-to-front"), nothing);
}

const Points square{{1, 1, 2}, {6, 1, 2}, {6, 6, 2}, {1, 6, 2}};

Points moved(Points points, glm::dvec3 by) {
  for (glm::dvec3& point : points) point += by;
  return points;
}

}  // namespace

TEST_SUITE("bsp/degenerate") {
  TEST_CASE("no polygon: no tree, and the background, one: a node") {
    CHECK(Run(screen_scene(8, 8, {})).pixels() == 0);
    CHECK(Run(screen_scene(8, 8, {})).record.all<NodeMake>().empty());
    const Run one(screen_scene(8, 8, {square}));
    CHECK(one.picture == z_buffered(screen_scene(8, 8, {square})));
    CHECK(one.record.all<NodeMake>().size() == 1);
    CHECK(Run(screen_scene(0, 0, {square})).pixels() == 0);
  }

  TEST_CASE("no area, no finite number, too few corners: no plane, and left out") {
    for (const Points& bad :
         {Points{{0, 0, 0}, {4, 4, 4}, {2, 2, 2}}, Points{{0, 0, 0}, {1, 1, 1}}, Points{},
          Points{{0, 0, 0}, {5, 0, 0}, {5, not_a_number, 0}}, Points{{0, 0, 0}, {5, 0, 0}, {5, infinite, 0}},
          Points{{0, 0, 0}, {5, 0, 0}, {5, 1e200, 0}}}) {
      const Run with(screen_scene(8, 8, {bad, square}));
      CHECK(with.rejects() == std::vector<Reject>{Reject::degenerate});
      CHECK(with.record.all<NodeMake>().size() == 1);
      CHECK(with.pixels() == 25);
    }
  }

  TEST_CASE(
      "coplanar polygons share a node, where they overlap the first in the file is seen, whichever way they face") {
    Points turned = moved(square, {2, 1, 0});
    std::reverse(turned.begin(), turned.end());
    for (const auto& polygons : {std::vector<Points>{square, moved(square, {1, 1, 0}), turned},
                                 std::vector<Points>{turned, square, moved(square, {1, 1, 0})}}) {
      const Scene scene = screen_scene(10, 10, polygons);
      for (const std::string order : {"back-to-front", "front-to-back"}) {
        const Run one(scene, order);
        CHECK(one.picture == z_buffered(scene));
        CHECK(one.record.all<NodeMake>().size() == 1);
        CHECK(one.record.all<NodeAdd>().size() == 2);
      }
    }
  }

  TEST_CASE("the same polygon three times, also with another root: the first is seen") {
    const Scene scene = screen_scene(8, 8, {square, square, square});
    for (const std::string seed : {"1", "2", "3", "4"}) {
      Conventions conventions = drawn_from("back-to-front");
      conventions.options["root"] = "random";
      conventions.options["seed"] = seed;
      NullRecorder nothing;
      CHECK(run(scene, conventions, nothing) == z_buffered(scene));
    }
  }

  TEST_CASE("what lies within the tolerance of a plane is on it, what lies further off is not") {
    // The diagonal of the box is about 7.07, so the tolerance is 7.07e-9.
    CHECK(Run(screen_scene(8, 8, {square, moved(square, {0, 0, 6e-9})})).record.all<NodeMake>().size() == 1);
    const Run apart(screen_scene(8, 8, {square, moved(square, {0, 0, -9e-9})}));
    CHECK(apart.record.all<NodeMake>().size() == 2);
    CHECK(apart.picture.polygon[apart.picture.at(3, 3)] == 1);
  }

  TEST_CASE("intersecting and cyclically overlapping polygons are cut until each order is right") {
    const Points tilted{{1, 1, 0}, {6, 1, 4}, {6, 6, 4}, {1, 6, 0}};
    const Scene crossing = screen_scene(8, 8, {square, tilted});
    CHECK(Run(crossing).record.all<SplitVertex>().size() == 2);
    CHECK(Run(crossing).picture.polygon == z_buffered(crossing).polygon);

    const Points a{{0, 2, 0}, {16, 2, 8}, {16, 5, 8}, {0, 5, 0}}, b{{12, 0, 0}, {15, 0, 0}, {9, 16, 8}, {6, 16, 8}},
        c{{1, 0, 8}, {4, 0, 8}, {11, 16, 0}, {8, 16, 0}};
    const Scene cycle = screen_scene(17, 17, {a, b, c});
    const Run cut(cycle);
    CHECK(cut.record.all<SplitVertex>().size() >= 2);
    CHECK(cut.picture.polygon == z_buffered(cycle).polygon);
  }

  TEST_CASE("the eye in a polygon's plane: edge-on, not drawn, and its plane still divides the rest") {
    Scene scene;
    test::add_polygon(scene, Points{{1, 0, -1}, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}});  // the plane y = 0, with the eye
    test::add_polygon(scene, Points{{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}});  // cut by it
    test::look(scene, Camera::Kind::perspective, 4, 0, 90, 1, 10);
    const Run both(scene);
    CHECK(both.rejects() == std::vector<Reject>{Reject::edge_on});
    CHECK(both.record.all<SplitVertex>().size() == 2);
    CHECK(both.picture.polygon == z_buffered(scene).polygon);
  }

  TEST_CASE("concave polygons are cut into parts that hang together, without a trace of it in the picture") {
    // A comb whose three teeth reach through the second polygon's plane.
    const Points comb{{0, 0, 0}, {14, 0, 0}, {14, 9, 9}, {12, 9, 9}, {12, 2, 2}, {8, 2, 2},
                      {8, 9, 9}, {6, 9, 9},  {6, 2, 2},  {2, 2, 2},  {2, 9, 9},  {0, 9, 9}};
    const Points wall{{-1, -1, 5}, {15, -1, 5}, {15, 11, 5}, {-1, 11, 5}};
    for (const auto& polygons : {std::vector<Points>{wall, comb}, std::vector<Points>{comb, wall}}) {
      const Scene scene = screen_scene(16, 12, polygons);
      CHECK(Run(scene).picture.polygon == z_buffered(scene).polygon);
    }
  }

  TEST_CASE("a thousand polygons behind each other: a tree as deep as a list is built and gone through") {
    std::vector<Points> polygons;
    for (int i = 0; i < 1000; ++i) polygons.push_back(moved(square, {0, 0, i}));
    const Scene scene = screen_scene(8, 8, polygons);
    const Run deep(scene);
    CHECK(deep.record.all<NodeMake>().size() == 1000);
    CHECK(deep.picture == z_buffered(scene));
  }

  TEST_CASE("polygons that are drawn in no pixel, behind the eye and beside the view, do no harm") {
    Scene scene = test::cube(1);
    test::add_polygon(scene, Points{{50, 0, 0}, {50, 1, 0}, {50, 0, 1}});
    test::add_polygon(scene, Points{{0, 90, 0}, {0, 91, 0}, {0, 90, 1}});
    test::look(scene, Camera::Kind::perspective, 4, 30, 60, 1, 10);
    CHECK(Run(scene).picture.polygon == z_buffered(scene).polygon);
  }
}
