// The floating horizon on surfaces small enough to do on paper.
#include <doctest/doctest.h>

#include <limits>

#include "algorithms/floating_horizon/horizons.hpp"
#include "tests/unit/algorithms/floating_horizon/surfaces.hpp"

using namespace zstep;
using namespace zstep::test;
using floating_horizon::crossing;
using floating_horizon::held_against;
using floating_horizon::Passage;

namespace {

/// What the tests of the n-th curve said: a above, b below, h hidden.
std::string verdicts(const CollectRecorder& record, std::int32_t curve) {
  std::string said;
  std::int32_t at = -1;
  for (const CollectedEvent& collected : record.events) {
    if (const auto* begin = get_if<CurveBegin>(&collected.event)) at = begin->curve;
    if (const auto* test = get_if<HorizonTest>(&collected.event); test && at == curve)
      said += "abh"[static_cast<std::size_t>(test->verdict)];
  }
  return said;
}

}  // namespace

TEST_SUITE("floating horizon by hand") {
  TEST_CASE("above, below, between, on the horizon is visible, one horizon knows no below") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    CHECK(held_against(3, 4, 6, true) == Horizon::above);
    CHECK(held_against(4, 4, 6, true) == Horizon::above);
    CHECK(held_against(5, 4, 6, true) == Horizon::hidden);
    CHECK(held_against(6, 4, 6, true) == Horizon::below);
    CHECK(held_against(7, 4, 6, true) == Horizon::below);
    CHECK(held_against(7, 4, 6, false) == Horizon::hidden);
    CHECK(held_against(7, infinite, -infinite, true) == Horizon::above);
    CHECK(held_against(7, infinite, -infinite, false) == Horizon::above);
  }

  TEST_CASE("a crossing divides the way as the distances to the horizon") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    // The curve goes from row 3 to row 6, the horizon from row 4 to row 5: d_0 = -1, d_1 = 1.
    const Passage from{2, 3, 4, 9, Horizon::above}, to{3, 6, 5, 9, Horizon::hidden};
    CHECK(crossing(from, to, Horizon::above) == glm::dvec2(2.5, 4.5));
    CHECK_FALSE(crossing(from, to, Horizon::below));
    CHECK_FALSE(crossing({2, 3, infinite, 9, Horizon::above}, to, Horizon::above));
    CHECK_FALSE(crossing(from, {3, 6, infinite, 9, Horizon::hidden}, Horizon::above));
    CHECK_FALSE(crossing({2, 4, 4, 9, Horizon::above}, {3, 5, 5, 9, Horizon::above}, Horizon::above));
  }

  TEST_CASE("the first curve is visible throughout and becomes both horizons") {
    const HorizonRun run = run_horizon(surface_of({{0, 2, {4, 2, 4}}}));
    const auto tests = run.record.all<HorizonTest>();
    REQUIRE(tests.size() == 5);
    for (std::int32_t x = 0; x < 5; ++x) {
      CHECK(tests[static_cast<std::size_t>(x)].x == x);
      CHECK(tests[static_cast<std::size_t>(x)].y_curve == std::abs(x - 2) + 2);
      CHECK(tests[static_cast<std::size_t>(x)].verdict == Horizon::above);
    }
    const auto moves = run.record.all<HorizonMove>();
    REQUIRE(moves.size() == 16 + 10);  // first all columns are cleared
    CHECK(moves[0].y_curve == std::numeric_limits<double>::infinity());
    CHECK(moves[1].y_curve == -std::numeric_limits<double>::infinity());
    CHECK(moves[16 + 4].x == 2);
    CHECK(moves[16 + 4].upper);
    CHECK(moves[16 + 5].x == 2);
    CHECK_FALSE(moves[16 + 5].upper);
    CHECK(moves[16 + 5].y_curve == 2);
    CHECK(run.record.all<HorizonCross>().empty());
    CHECK(drawn(run.picture) == std::vector<std::string>{"........", "........", "..#.....", ".#.#....", "#...#...",
                                                         "........", "........", "........"});
    for (const std::int32_t polygon : run.picture.polygon) CHECK(polygon == no_polygon);
    for (const double depth : run.picture.depth) CHECK(depth == no_depth);
  }

  TEST_CASE("a peak hides, and the crossing is interpolated") {
    // Behind a level curve at row 7 a peak reaches row 1 on column 3; the curve behind it runs along row 3. The peak's
    // slope stands at row 5 - 4/3 x, so the curve goes behind it at x = 1.5.
    const HorizonRun run = run_horizon(surface_of({{0, 3, {7, 7, 7}}, {0, 3, {5, 1, 5}}, {0, 3, {3, 3, 3}}}));
    CHECK(verdicts(run.record, 2) == "aahhhaa");
    const auto crosses = run.record.all<HorizonCross>();
    REQUIRE(crosses.size() == 2);
    CHECK(crosses[0].upper);
    CHECK(crosses[0].x_at == doctest::Approx(1.5));
    CHECK(crosses[0].y_at == 3);
    CHECK(crosses[1].x_at == doctest::Approx(4.5));
    CHECK(drawn(run.picture)[3] == "###..##.");  // half-way points belong to the right
  }

  TEST_CASE("a valley: the lower horizon shows it, one horizon loses it") {
    const Scene scene = surface_of({{0, 3, {3, 3, 3}}, {0, 3, {3, 6, 3}}});
    const HorizonRun two = run_horizon(scene), one = run_horizon(scene, {{"horizons", "one"}});
    CHECK(verdicts(two.record, 1) == "abbbbba");
    CHECK(verdicts(one.record, 1) == "ahhhhha");
    CHECK(drawn(two.picture)[6] == "...o....");
    CHECK(drawn(one.picture)[6] == "........");
    for (const HorizonMove& move : one.record.all<HorizonMove>()) CHECK(move.upper);
  }

  TEST_CASE("a curve on a horizon is visible, and moves it nowhere") {
    const auto moves_of = [](const HorizonRun& run, std::int32_t curve) {
      std::size_t moves = 0;
      std::int32_t at = -1;
      for (const CollectedEvent& collected : run.record.events) {
        if (const auto* begin = get_if<CurveBegin>(&collected.event)) at = begin->curve;
        moves += holds<HorizonMove>(collected.event) && at == curve;
      }
      return moves;
    };
    // The second curve makes row 6 the lower horizon, the third runs along it, the fourth along the upper one.
    const HorizonRun run = run_horizon(
        surface_of({{0, 2, {3, 3, 3}}, {0, 2, {6, 6, 6}}, {0, 2, {6, 6, 6}}, {0, 2, {3, 3, 3}}}), {{"sides", "off"}});
    CHECK(verdicts(run.record, 1) == "bbbbb");
    CHECK(moves_of(run, 1) == 5);
    CHECK(verdicts(run.record, 2) == "bbbbb");
    CHECK(moves_of(run, 2) == 0);
    CHECK(verdicts(run.record, 3) == "aaaaa");
    CHECK(moves_of(run, 3) == 0);
  }

  TEST_CASE("through both horizons between two columns: two crossings") {
    // On column 1 between 3.5 (above the band from 4 to 5) and on column 2 at 6: out above at y = 4, in below at y = 5.
    const HorizonRun run =
        run_horizon(surface_of({{0, 1, {4, 4, 4, 4}}, {0, 1, {5, 5, 5, 5}}, {0, 1, {2, 3.5, 6, 6}}}));
    CHECK(verdicts(run.record, 2) == "aabb");
    const auto crosses = run.record.all<HorizonCross>();
    REQUIRE(crosses.size() == 2);
    CHECK(crosses[0].upper);
    CHECK(crosses[0].x_at == doctest::Approx(1 + 0.2));
    CHECK(crosses[0].y_at == doctest::Approx(4));
    CHECK_FALSE(crosses[1].upper);
    CHECK(crosses[1].x_at == doctest::Approx(1 + 0.6));
    CHECK(crosses[1].y_at == doctest::Approx(5));
  }

  TEST_CASE("the sides: what lies behind the edge of the surface is hidden") {
    // Curves shifted to the left by two columns each, as seen from the right. From (3, 5) to (1, 3) runs the left edge;
    // on column 2 the surface reaches from row 3 down to row 4, so the last curve, at row 3.5 there, lies behind it.
    const Scene scene = surface_of({{3, 4, {5, 5}}, {1, 4, {3, 3}}, {1, 4, {3.5, 3.5}}});
    const HorizonRun with = run_horizon(scene), without = run_horizon(scene, {{"sides", "off"}});
    CHECK(verdicts(with.record, 2) == "bhhhh");
    CHECK(verdicts(without.record, 2) == "bbhhh");
    std::size_t sides = 0;
    for (const CurveSegment& segment : with.record.all<CurveSegment>())
      sides += segment.vertex_1 - segment.vertex_0 == 2;
    CHECK(sides == 4);  // left and right, before the second and before the third curve
    CHECK(without.record.all<CurveSegment>().size() == 3);
  }

  TEST_CASE("across: curves of constant x between two curves, nearest first") {
    const Scene scene = surface_of({{1, 2, {5, 5, 5}}, {2, 2, {3, 3, 3}}});
    const auto curves = run_horizon(scene, {{"across", "on"}}).record.all<CurveBegin>();
    REQUIRE(curves.size() == 5);
    CHECK_FALSE(curves[0].across);
    for (std::size_t i = 1; i < 4; ++i) {
      CHECK(curves[i].across);
      CHECK(curves[i].row == static_cast<std::int32_t>(i - 1));
      CHECK(curves[i].curve == static_cast<std::int32_t>(i));
    }
    CHECK(curves[2].constant == scene.points[1].x);
    CHECK_FALSE(curves[4].across);
    CHECK(drawn(run_horizon(scene, {{"across", "on"}}).picture)[4] == "..#.#.#.");
    CHECK(drawn(run_horizon(scene).picture)[4] == "........");
  }

  TEST_CASE("lines are drawn column by column and row by row, and only on the raster") {
    const HorizonRun steep = run_horizon(surface_of({{2, 1, {-5, 20}}}));
    for (std::int32_t y = 0; y < 8; ++y) CHECK(drawn(steep.picture)[static_cast<std::size_t>(y)].find('#') == 2);
    const HorizonRun flat = run_horizon(surface_of({{-20, 100, {-5, 20}}}));  // row x/4
    CHECK(drawn(flat.picture)[0] == "##......");
    CHECK(drawn(flat.picture)[1] == "..####..");
    CHECK(drawn(flat.picture)[2] == "......##");
    const HorizonRun far = run_horizon(surface_of({{-4e8, 8e8, {3, 3}}}));
    CHECK(drawn(far.picture)[3] == "########");
    CHECK(far.record.all<HorizonTest>().size() == 8);
  }
}
