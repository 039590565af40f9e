// Who is in front on an interval, and where that changes.
#include <doctest/doctest.h>

#include <tuple>

#include "algorithms/scan_line/scan_line.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using test::screen_scene;

namespace {

struct Run {
  CollectRecorder record;
  Picture picture;
};

Run run(const Scene& scene, std::map<std::string, std::string> options = {}) {
  Run result;
  Conventions conventions;
  conventions.cull = false;
  conventions.options = std::move(options);
  result.picture = scan_line::run(scene, conventions, result.record);
  return result;
}

// A rectangle in columns 0 … 7 and rows 0 … 1, with depth z_left in column 0 and z_right in column 8.
std::vector<glm::dvec3> strip(double z_left, double z_right) {
  return {{0, 0, z_left}, {8, 0, z_right}, {8, 2, z_right}, {0, 2, z_left}};
}

std::vector<std::int32_t> row(const Picture& picture, std::int32_t y) {
  const auto from = picture.polygon.begin() + static_cast<std::ptrdiff_t>(picture.at(0, y));
  return {from, from + picture.width};
}

using Row = std::vector<std::int32_t>;

}  // namespace

TEST_SUITE("scan_line/front") {
  TEST_CASE("one polygon: no depth is asked for") {
    const Run one = run(screen_scene(8, 2, {strip(1, 1)}));
    CHECK(one.record.all<PlaneDepth>().empty());
    CHECK(row(one.picture, 0) == Row{0, 0, 0, 0, 0, 0, 0, 0});
    REQUIRE(one.record.all<SpanWinner>().size() == 2);
    CHECK(one.record.all<SpanFlags>()[0].flags == 1);
  }

  TEST_CASE("two, one behind the other: both depths at both ends, and the nearer all along") {
    const Run two = run(screen_scene(8, 2, {strip(3, 3), strip(1, 2)}));
    CHECK(row(two.picture, 0) == Row{1, 1, 1, 1, 1, 1, 1, 1});
    CHECK(two.record.all<ImpliedEdge>().empty());
    const auto depths = two.record.all<PlaneDepth>();
    REQUIRE(depths.size() == 8);
    CHECK(depths[0].z == doctest::Approx(3));
    CHECK(depths[2].z == doctest::Approx(1));
    CHECK(depths[2].x_at == 0);
    CHECK(depths[3].z == doctest::Approx(1.9375));  // the picture ends at 7.5
    CHECK(depths[3].x_at == 7.5);
    CHECK(two.picture.depth[4] == doctest::Approx(1.5));
  }

  TEST_CASE("two that penetrate each other: the implied edge, and a tie on a pixel's centre stays with the first") {
    // z = x/2 and z = 4 - x/2 meet in column 4.
    const Run rising = run(screen_scene(10, 2, {strip(0, 4), strip(4, 0)}));
    REQUIRE(rising.record.all<ImpliedEdge>().size() == 2);
    const ImpliedEdge edge = rising.record.all<ImpliedEdge>()[0];
    CHECK(edge.piece == 0);
    CHECK(edge.other == 1);
    CHECK(edge.x_at == doctest::Approx(4).epsilon(1e-12));
    CHECK(edge.z == doctest::Approx(2));
    CHECK(row(rising.picture, 0) == Row{0, 0, 0, 0, 0, 1, 1, 1, -1, -1});
    CHECK(row(run(screen_scene(10, 2, {strip(4, 0), strip(0, 4)})).picture, 0) == Row{1, 1, 1, 1, 0, 0, 0, 0, -1, -1});
  }

  TEST_CASE("three that take turns: two implied edges, left to right") {
    // z = x, z = 1.9 + x/4 and z = 7.9 - x: 0 until 2.53, then 1 until 4.8, then 2.
    const Run three = run(screen_scene(8, 2, {strip(0, 8), strip(1.9, 3.9), strip(7.9, -0.1)}));
    const auto edges = three.record.all<ImpliedEdge>();
    REQUIRE(edges.size() == 4);
    CHECK(edges[0].x_at == doctest::Approx(1.9 / 0.75));
    CHECK(edges[1].x_at == doctest::Approx(4.8));
    CHECK(std::tuple(edges[0].piece, edges[0].other, edges[1].piece, edges[1].other) == std::tuple(0, 1, 1, 2));
    CHECK(row(three.picture, 0) == Row{0, 0, 0, 1, 1, 2, 2, 2});
  }

  TEST_CASE("one that is in front only between the ends of none is never seen") {
    // The lower envelope of z = x and z = 8 - x has its peak at (4, 4); z = 4.1 is behind it, z = 3.9 cuts it off.
    CHECK(run(screen_scene(9, 2, {strip(0, 8), strip(8, 0), strip(4.1, 4.1)})).record.all<ImpliedEdge>().size() == 2);
    const Run cut = run(screen_scene(9, 2, {strip(0, 8), strip(8, 0), strip(3.9, 3.9)}));
    CHECK(cut.record.all<ImpliedEdge>().size() == 4);
    CHECK(row(cut.picture, 0) == Row{0, 0, 0, 0, 2, 1, 1, 1, -1});
  }

  TEST_CASE("coplanar: the polygon drawn first, whole, however its plane was computed") {
    test::Numbers random(7);
    for (int round = 0; round < 50; ++round) {
      const double a = random.between(-3, 3), b = random.between(-3, 3), c = random.between(-9, 9);
      std::vector<std::vector<glm::dvec3>> polygons;
      for (int k = 0; k < 3; ++k) {
        std::vector<glm::dvec3> corners;
        for (int i = 0; i < 3 + k; ++i) {
          const double angle = 6.28318530717958647692 * i / (3 + k) + 0.3 * k;
          const glm::dvec3 p(8 + 7.9 * std::cos(angle), 8 + 7.9 * std::sin(angle), 0);
          corners.push_back({p.x, p.y, a * p.x + b * p.y + c});
        }
        polygons.push_back(corners);
      }
      const Run all = run(screen_scene(16, 16, polygons));
      CHECK(all.record.all<ImpliedEdge>().empty());
      const Picture first = run(screen_scene(16, 16, {polygons[0]})).picture;
      for (std::size_t i = 0; i < first.polygon.size(); ++i) {
        if (first.polygon[i] == 0) CHECK(all.picture.polygon[i] == 0);
      }
    }
  }

  TEST_CASE("two that meet in an edge which both begin at: the nearer beyond it is seen, and nothing is split") {
    const std::vector<glm::dvec3> back{{2, 0, 1}, {8, 0, 4}, {8, 4, 4}, {2, 4, 1}},
        front{{2, 0, 1}, {6, 0, 2}, {6, 4, 2}, {2, 4, 1}};
    const Run fold = run(screen_scene(9, 4, {back, front}));
    CHECK(fold.record.all<ImpliedEdge>().empty());
    CHECK(row(fold.picture, 1) == Row{-1, -1, 1, 1, 1, 1, 0, 0, -1});
  }
}
