// Ray casting by hand: lessons/scenes/rays.toml has the eye at (6, 0, 0), the projection plane 2 before it, pixels half
// a unit wide, so that dX = (-2, x_p, y_p) with x_p = x/2 - 7/4 and y_p = 3/4 - y/2.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "algorithms/ray_casting/ray_casting.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/where.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

Scene five_rectangles() { return look_at_scene(load_scene(test::in_checkout("lessons/scenes/rays.toml")).scene, {}); }

Conventions with_boxes(const std::string& boxes) {
  Conventions conventions;
  conventions.options = {{"boxes", boxes}};
  return conventions;
}

Picture cast(const Scene& scene, bool cull = true) {
  Conventions conventions;
  conventions.cull = cull;
  NullRecorder record;
  return ray_casting::run(scene, conventions, record);
}

// The events of one ray: those between its RayBegin and its RayEnd.
template <class E>
std::vector<E> of_ray(const CollectRecorder& record, std::int32_t number) {
  std::vector<E> found;
  bool here = false;
  for (const auto& recorded : record.events) {
    if (const auto* begin = get_if<RayBegin>(&recorded.event)) here = begin->ray == number;
    if (const auto* event = get_if<E>(&recorded.event); event && here) found.push_back(*event);
  }
  return found;
}

}  // namespace

TEST_SUITE("ray_casting") {
  TEST_CASE("t of every plane on one ray, and the nearest of the facets that it passes inside") {
    CollectRecorder record;
    const Picture picture = ray_casting::run(five_rectangles(), {}, record);
    const std::int32_t pixel = 1 * 8 + 5;  // (5, 1): x_p = 3/4, y_p = 1/4

    const std::vector<RayBegin> begin = of_ray<RayBegin>(record, pixel);
    REQUIRE(begin.size() == 1);
    CHECK(begin[0].x_0 == doctest::Approx(6));
    CHECK(begin[0].dir_x == doctest::Approx(-2));
    CHECK(begin[0].dir_y == doctest::Approx(0.75));
    CHECK(begin[0].dir_z == doctest::Approx(0.25));

    // A: x = 2. B: x = -2. C: x + y = 3, so 6 - 2t + 3t/4 = 3. D: x = -4. E: x = 8, behind the eye.
    const std::vector<RayPlane> planes = of_ray<RayPlane>(record, pixel);
    REQUIRE(planes.size() == 5);
    const double t[] = {2, 4, 2.4, 5, -1};
    for (std::size_t i = 0; i < 5; ++i) CHECK(planes[i].t == doctest::Approx(t[i]));

    const std::vector<RayHit> hits = of_ray<RayHit>(record, pixel);
    REQUIRE(hits.size() == 4);  // not E
    CHECK_FALSE(hits[0].inside);
    CHECK_FALSE(hits[1].inside);
    CHECK((hits[2].inside && hits[2].nearest));
    CHECK(hits[2].x_hit == doctest::Approx(1.2));
    CHECK(hits[2].y_hit == doctest::Approx(1.8));
    CHECK(hits[2].z_hit == doctest::Approx(0.6));
    CHECK((hits[3].inside && !hits[3].nearest));

    const std::vector<RayEnd> end = of_ray<RayEnd>(record, pixel);
    REQUIRE(end.size() == 1);
    CHECK(end[0].nearest_facet == 2);
    CHECK(end[0].tests == 5);
    CHECK(view_depth(five_rectangles().camera, {}, picture.depth[picture.at(5, 1)]) == doctest::Approx(4.8));  // t d
  }

  TEST_CASE("the picture of the five rectangles") {
    const Picture picture = cast(five_rectangles());
    const std::string rows[] = {"........", ".AABCC..", ".AABCC..", "........"};
    for (std::int32_t y = 0; y < 4; ++y) {
      std::string row;
      for (std::int32_t x = 0; x < 8; ++x) {
        const std::int32_t polygon = picture.polygon[picture.at(x, y)];
        row += polygon == no_polygon ? '.' : static_cast<char>('A' + polygon);
      }
      CHECK(row == rows[y]);
    }
  }

  TEST_CASE("what each kind of boxes spares") {
    struct Case {
      std::string boxes;
      int planes, boxes_tested, cells;
    };
    for (const Case& expected : {Case{"none", 160, 0, 0}, Case{"facet", 12, 160, 0}}) {
      CAPTURE(expected.boxes);
      CollectRecorder record;
      ray_casting::run(five_rectangles(), with_boxes(expected.boxes), record);
      CHECK(static_cast<int>(record.all<RayPlane>().size()) == expected.planes);
      CHECK(static_cast<int>(record.all<BoxTest>().size()) == expected.boxes_tested);
      CHECK(static_cast<int>(record.all<CellVisit>().size()) == expected.cells);
    }
    // On a mesh a hierarchy and a grid spare nearly all tests, and the hierarchy spares most boxes, too.
    ViewOptions options;
    options.width = 24, options.height = 18;
    const Scene teapot = look_at_scene(load_scene("teapot:4").scene, options);
    std::map<std::string, std::int64_t> planes, boxes, spared;
    for (const std::string kind : {"none", "facet", "hierarchy", "grid"}) {
      CollectRecorder record;
      ray_casting::run(teapot, with_boxes(kind), record);
      planes[kind] = static_cast<std::int64_t>(record.all<RayPlane>().size());
      boxes[kind] = static_cast<std::int64_t>(record.all<BoxTest>().size());
      for (const Saved& saved : record.all<Saved>()) spared[kind] += saved.tests;
    }
    const std::int64_t all = 24 * 18 * static_cast<std::int64_t>(teapot.facets.size());
    CHECK(planes["none"] == all);
    CHECK(boxes["facet"] == all);
    for (const std::string kind : {"facet", "hierarchy", "grid"}) {
      CAPTURE(kind);
      CHECK(planes[kind] + spared[kind] == all);
      CHECK(planes[kind] < all / 50);
    }
    CHECK(boxes["hierarchy"] < all / 20);
  }

  TEST_CASE("depths are the Z-buffer's") {
    for (const bool orthographic : {false, true}) {
      ViewOptions options;
      options.width = 64, options.height = 48, options.orthographic = orthographic;
      const Scene scene = look_at_scene(load_scene("cube").scene, options);
      NullRecorder record;
      const Picture ours = cast(scene), theirs = z_buffer::run(scene, {}, record);
      int same = 0;
      for (std::size_t i = 0; i < ours.depth.size(); ++i) {
        if (ours.polygon[i] == no_polygon || ours.polygon[i] != theirs.polygon[i]) continue;
        CHECK(ours.depth[i] == doctest::Approx(theirs.depth[i]).epsilon(1e-12));
        ++same;
      }
      CHECK(same > 300);
    }
  }

  TEST_CASE("on a screen scene every pixel is the Z-buffer's: shared edges, corners on centres, even-odd, ties") {
    test::Numbers random(12);
    for (int run = 0; run < 30; ++run) {
      std::vector<std::vector<glm::dvec3>> polygons;
      for (int i = 0; i < 12; ++i) {
        std::vector<glm::dvec3> corners;
        for (int k = 0; k < 3 + i % 4; ++k) {
          const double x = std::floor(random.between(-2, 14)), y = std::floor(random.between(-2, 11));
          corners.push_back({x, y, std::floor(static_cast<double>(i % 3))});
        }
        polygons.push_back(corners);
      }
      const Scene scene = test::screen_scene(12, 9, polygons);
      NullRecorder record;
      CHECK(cast(scene).polygon == z_buffer::run(scene, {}, record).polygon);
    }
  }

  TEST_CASE("degenerate scenes: duplicates, facets edge-on, one polygon, the eye inside, planes behind the eye") {
    Scene twice;
    for (int i = 0; i < 2; ++i) test::add_polygon(twice, std::vector<glm::dvec3>{{0, -1, -1}, {0, 1, -1}, {0, 0, 1}});
    test::add_polygon(twice, std::vector<glm::dvec3>{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}});  // seen edge-on
    twice.raster = {16, 12, false};
    test::look(twice, Camera::Kind::perspective, {4, 0, 0}, {0, 0, 0}, 1, 9);
    const Picture picture = cast(twice);
    int first = 0, others = 0;
    for (const std::int32_t polygon : picture.polygon) first += polygon == 0, others += polygon > 0;
    CHECK(first > 0);  // of equal depths the one drawn first
    CHECK(others == 0);

    Scene box = test::cube(1);
    box.raster = {31, 23, false};
    test::look(box, Camera::Kind::perspective, {0.1, 0.2, -0.3}, {1, 0.7, 0.4}, 0.01, 9);
    for (const std::int32_t polygon : cast(box, false).polygon) CHECK(polygon != no_polygon);  // no gap at an edge
    for (const std::int32_t polygon : cast(box, true).polygon)
      CHECK(polygon == no_polygon);  // all are seen from behind
  }
}
