// Warnock: the four bins, the four cases and the pixel, on areas that can be checked by hand.
#include <doctest/doctest.h>

#include <limits>

#include "algorithms/scene/load.hpp"
#include "algorithms/warnock/warnock.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using warnock::Area;
using warnock::Shape;

namespace {

struct Run {
  Picture picture;
  CollectRecorder record;

  std::vector<AreaCase> cases() const {
    std::vector<AreaCase> found;
    for (const AreaDecide& decided : record.all<AreaDecide>()) found.push_back(decided.what);
    return found;
  }
  std::int64_t tests() const {
    std::int64_t count = 0;
    for (const CollectedEvent& e : record.events) {
      count += holds<AreaBin>(e.event) && e.step != warnock::step::still_surrounding.id;
    }
    return count;
  }
};

Run settle(const Scene& scene, bool boxes = false) {
  Run run;
  Conventions conventions;
  conventions.cull = false;
  if (boxes) conventions.options["boxes"] = "on";
  run.picture = warnock::run(scene, conventions, run.record);
  return run;
}

Picture z_buffered(const Scene& scene) {
  NullRecorder nothing;
  Conventions conventions;
  conventions.cull = false;
  return z_buffer::run(scene, conventions, nothing);
}

std::vector<glm::dvec3> rectangle(double left, double top, double right, double bottom, double z) {
  return {{left, top, z}, {right, top, z}, {right, bottom, z}, {left, bottom, z}};
}

std::vector<glm::dvec3> whole(double size, double z) { return rectangle(-1, -1, size + 1, size + 1, z); }

using Cases = std::vector<AreaCase>;

}  // namespace

TEST_SUITE("warnock/area") {
  TEST_CASE("quarters halve both sides, and what cannot be halved stays") {
    CHECK(warnock::quarters({0, 0, 8, 8}).size() == 4);
    const std::vector<Area> odd = warnock::quarters({0, 0, 5, 3});
    REQUIRE(odd.size() == 4);
    CHECK(odd[0].end_column == 2);
    CHECK(odd[0].end_row == 1);
    CHECK(odd[3].first_column == 2);
    CHECK(odd[3].end_column == 5);
    CHECK(odd[3].first_row == 1);
    CHECK(odd[3].end_row == 3);
    CHECK(warnock::quarters({4, 7, 6, 8}).size() == 2);
    CHECK(warnock::quarters({4, 7, 5, 9}).size() == 2);
  }

  TEST_CASE("the four bins, with edges that meet the area and corners inside counted") {
    const Area area{2, 2, 6, 6};  // 1.5 to 5.5 both ways
    const auto judged = [&](const std::vector<glm::dvec3>& corners, bool boxes = false) {
      return Shape(corners).judge(area, boxes);
    };
    const Shape::Judgement away = judged(rectangle(6, 2, 9, 5, 0));
    CHECK(away.bin == Bin::disjoint);
    CHECK(away.crossings == 0);
    CHECK(away.corners_inside == 0);
    const Shape::Judgement around = judged(rectangle(0, 0, 8, 8, 0));
    CHECK(around.bin == Bin::surrounding);
    CHECK(around.corners_inside == 4);
    const Shape::Judgement within = judged(rectangle(2, 2, 5, 5, 0));
    CHECK(within.bin == Bin::contained);
    CHECK(within.crossings == 4);
    const Shape::Judgement across = judged(rectangle(3, 3, 8, 8, 0));
    CHECK(across.bin == Bin::intersecting);
    CHECK(across.crossings == 2);
    CHECK(across.corners_inside == 1);
    // A triangle cuts through the middle and has no corner inside.
    CHECK(judged({{-20, 3, 0}, {20, 3, 0}, {20, 4, 0}}).bin == Bin::intersecting);
    // Its box meets the area, and it does not.
    const std::vector<glm::dvec3> beside{{0, 8, 0}, {8, 0, 0}, {8, 8, 0}};
    CHECK(Shape({{9, 1, 0}, {9, 9, 0}, {1, 9, 0}}).judge({0, 0, 5, 5}, true).bin == Bin::disjoint);
    CHECK_FALSE(Shape({{9, 1, 0}, {9, 9, 0}, {1, 9, 0}}).judge({0, 0, 5, 5}, true).by_box);
    CHECK(judged(beside).bin == Bin::intersecting);
    // The notch of a concave polygon: the area lies in it.
    CHECK(judged({{0, 0, 0}, {1, 0, 0}, {1, 7, 0}, {7, 7, 0}, {7, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}).bin ==
          Bin::disjoint);
    // An edge along the area's own border meets it.
    CHECK(judged(rectangle(5.5, 0, 9, 9, 0)).bin == Bin::intersecting);
  }

  TEST_CASE("a box tells only the disjoint and the contained") {
    const Area area{2, 2, 6, 6};
    CHECK(Shape(rectangle(6, 2, 9, 5, 0)).judge(area, true).by_box);
    CHECK(Shape(rectangle(2, 2, 5, 5, 0)).judge(area, true).by_box);
    CHECK(Shape(rectangle(2, 2, 5, 5, 0)).judge(area, true).bin == Bin::contained);
    CHECK_FALSE(Shape(rectangle(0, 0, 8, 8, 0)).judge(area, true).by_box);
    CHECK_FALSE(Shape(rectangle(3, 3, 8, 8, 0)).judge(area, true).by_box);
  }
}

TEST_SUITE("warnock") {
  TEST_CASE("each case by itself, without a subdivision") {
    CHECK(settle(test::screen_scene(8, 8, {})).cases() == Cases{AreaCase::background});
    CHECK(settle(test::screen_scene(8, 8, {rectangle(20, 0, 30, 9, 0)})).cases() == Cases{AreaCase::background});
    CHECK(settle(test::screen_scene(8, 8, {rectangle(2, 2, 5, 5, 0)})).cases() == Cases{AreaCase::one_polygon});
    CHECK(settle(test::screen_scene(8, 8, {rectangle(2, 2, 50, 5, 0)})).cases() == Cases{AreaCase::one_polygon});
    CHECK(settle(test::screen_scene(8, 8, {whole(8, 0)})).cases() == Cases{AreaCase::surrounded});
    const Run front = settle(test::screen_scene(8, 8, {rectangle(2, 2, 5, 5, 3), whole(8, 1), whole(8, 2)}));
    CHECK(front.cases() == Cases{AreaCase::front_surrounder});
    CHECK(front.record.all<AreaDecide>()[0].piece == 1);
    CHECK(front.record.all<PlaneDepth>().size() == 12);
    CHECK(front.picture.polygon[0] == 1);
    CHECK(settle(test::screen_scene(1, 1, {rectangle(-1, -1, 1, 1, 3), rectangle(-1, -1, 1, 0, 1)})).cases() ==
          Cases{AreaCase::pixel});
  }

  TEST_CASE("what surrounds or misses an area is not tested in its quarters") {
    // One surrounds the left half, one lies in a corner of it.
    const Run run = settle(test::screen_scene(8, 8, {rectangle(-1, -1, 3.7, 9, 2), rectangle(0.6, 0.7, 1.2, 1.3, 1)}));
    std::int64_t spared = 0;
    for (const Saved& saved : run.record.all<Saved>()) {
      CHECK(saved.coherence == Coherence::area);
      spared += saved.tests;
    }
    const auto areas = static_cast<std::int64_t>(run.record.all<AreaBegin>().size());
    CHECK(spared > 0);
    CHECK(run.tests() + spared == 2 * areas);
  }

  TEST_CASE("a pixel is decided at its centre, not at the polygon's") {
    // Both cover the centre (0, 0). The second is nearer there, though the middle of the first is the nearer one.
    const std::vector<glm::dvec3> slope{{-0.4, -0.4, 5.2}, {9.6, -0.4, -4.8}, {9.6, 0.4, -4.8}, {-0.4, 0.4, 5.2}};
    const Run run = settle(test::screen_scene(1, 1, {slope, rectangle(-0.4, -0.4, 0.4, 0.4, 4)}));
    REQUIRE(run.cases() == Cases{AreaCase::pixel});
    CHECK(run.picture.polygon[0] == 1);
    CHECK(run.picture.depth[0] == 4);
    const std::vector<PlaneDepth> depths = run.record.all<PlaneDepth>();
    REQUIRE(depths.size() == 2);
    CHECK(depths[0].x_at == 0);
    CHECK(depths[0].z == doctest::Approx(4.8));
    // What does not cover the centre is not seen, however much of the pixel it covers.
    const Run beside =
        settle(test::screen_scene(1, 1, {rectangle(-0.5, -0.5, 0, 0.5, 1), rectangle(-0.4, 0, 0, 0.4, 2)}));
    CHECK(beside.picture.polygon[0] == no_polygon);
  }

  TEST_CASE("boxes spare tests of edges and change nothing else") {
    const Scene scene = look_at_scene(load_scene("cyclic").scene, {});
    const Run plain = settle(scene), boxed = settle(scene, true);
    CHECK(plain.picture == boxed.picture);
    CHECK(plain.cases() == boxed.cases());
    int by_box = 0;
    for (const AreaBin& bin : boxed.record.all<AreaBin>()) by_box += bin.by_box;
    CHECK(by_box > 0);
    for (const AreaBin& bin : plain.record.all<AreaBin>()) CHECK_FALSE(bin.by_box);
  }

  TEST_CASE("the Z-buffer's picture to the pixel: concave stars in rasters of any size") {
    test::Numbers random(1969);
    for (int run = 0; run < 40; ++run) {
      const std::int32_t width = 1 + run % 37, height = 1 + (run * 7) % 29;
      std::vector<std::vector<glm::dvec3>> stars;
      for (int i = 0; i < 12; ++i) {
        const glm::dvec3 centre(random.between(0, width), random.between(0, height), random.between(0, 20));
        stars.push_back(test::random_star(random, centre, 15, 3 + i % 6));
      }
      const Scene scene = test::screen_scene(width, height, stars);
      CHECK(settle(scene).picture.polygon == z_buffered(scene).polygon);
    }
  }
}

TEST_SUITE("warnock/degenerate") {
  const auto nothing_seen = [](const Run& run) {
    for (const std::int32_t polygon : run.picture.polygon) {
      if (polygon != no_polygon) return false;
    }
    return true;
  };

  TEST_CASE("duplicates and coplanar polygons: the first stays") {
    const Run twice = settle(test::screen_scene(8, 8, {whole(8, 1), whole(8, 1)}));
    CHECK(twice.cases() == Cases{AreaCase::front_surrounder});
    CHECK(twice.picture.polygon[9] == 0);
    const Scene overlap = test::screen_scene(9, 9, {rectangle(1, 1, 6, 6, 3), rectangle(3, 3, 8, 8, 3)});
    CHECK(settle(overlap).picture.polygon == z_buffered(overlap).polygon);
    const std::vector<glm::dvec3> front = whole(8, 1), back(front.rbegin(), front.rend());
    CHECK(settle(test::screen_scene(8, 8, {back, front})).picture.polygon[9] == 0);
  }

  TEST_CASE("cyclic and intersecting: decided pixel by pixel where no area is simple") {
    for (const char* name : {"cyclic", "intersecting"}) {
      const Scene scene = look_at_scene(load_scene(name).scene, {});
      CHECK(settle(scene).picture.polygon == z_buffered(scene).polygon);
    }
  }

  TEST_CASE("edge-on, without area, not a number: not there") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(nothing_seen(settle(test::screen_scene(8, 8, {{{1, 1, 0}, {5, 5, 1}, {5, 5, 9}}}))));
    CHECK(nothing_seen(settle(test::screen_scene(8, 8, {{{1, 1, 0}, {5, 5, 0}, {3, 3, 0}}}))));
    CHECK(nothing_seen(settle(test::screen_scene(8, 8, {{{1, 1, 0}, {nan, 5, 0}, {3, 3, 0}}}))));
    CHECK(nothing_seen(settle(test::screen_scene(8, 8, {{{1, 1, 0}, {5, 5, 0}}}))));
    CHECK(settle(test::screen_scene(0, 0, {whole(8, 1)})).picture.polygon.empty());
  }

  TEST_CASE("a polygon as large as numbers go covers the picture") {
    const Run run = settle(test::screen_scene(8, 8, {rectangle(-1e8, -1e8, 1e8, 1e8, 0)}));
    CHECK(run.cases() == Cases{AreaCase::surrounded});
  }

  TEST_CASE("a polygon that crosses itself is covered by the even-odd rule") {
    const Scene scene = test::screen_scene(
        24, 24, {{{12, 1, 0}, {18, 22, 0}, {1, 8, 0}, {23, 8, 0}, {6, 22, 0}}, rectangle(5, 5, 15, 15, 3)});
    CHECK(settle(scene).picture.polygon == z_buffered(scene).polygon);
    CHECK(settle(scene).picture.polygon[static_cast<std::size_t>(12 * 24 + 12)] == 1);
  }
}
