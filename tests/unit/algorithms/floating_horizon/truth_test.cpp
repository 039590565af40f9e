// The floating horizon against the Z-buffer: what it calls visible must not lie behind the surface, what it calls
// hidden must lie behind something. And surfaces, eyes and rasters of the degenerate kinds.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "algorithms/floating_horizon/horizons.hpp"
#include "algorithms/viewing/vertices.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/floating_horizon/surfaces.hpp"

using namespace zstep;
using namespace zstep::test;
using floating_horizon::Order;
using floating_horizon::rows_front_to_back;

namespace {

struct Judgement {
  int tested = 0, hidden = 0;  ///< points of curves on the raster
  int wrong = 0;               ///< visible but behind all that is drawn there, or hidden but before all of it
  double worst = 0;            ///< how many rows a wrong one lies from the horizon that it was held against
};

/// Each tested point's pseudodepth, interpolated along its interval of curve, against those of the nine pixels around
/// it in the Z-buffer's picture of the same surface: visible ought to be no farther than the farthest, hidden no nearer
/// than the nearest.
Judgement judge(const Scene& scene, const std::map<std::string, std::string>& options = {}) {
  NullRecorder none;
  Conventions both_sides;
  both_sides.cull = false;
  const Picture truth = z_buffer::run(scene, both_sides, none);
  const HorizonRun run = run_horizon(scene, options);
  const viewing::Lens lens(scene.camera, scene.raster, Conventions::Depth::pseudodepth);
  const viewing::Vertices vertices = viewing::view_vertices(scene, lens, none);
  std::vector<double> upper(static_cast<std::size_t>(scene.raster.width)), lower = upper;
  Judgement judgement;
  CurveSegment segment{};
  for (const CollectedEvent& collected : run.record.events) {
    if (const auto* next = get_if<CurveSegment>(&collected.event)) segment = *next;
    if (const auto* move = get_if<HorizonMove>(&collected.event))
      (move->upper ? upper : lower)[static_cast<std::size_t>(move->x)] = move->y_curve;
    const auto* test = get_if<HorizonTest>(&collected.event);
    if (test == nullptr) continue;
    const double row = std::floor(test->y_curve + 0.5);
    if (!(row >= 0 && row < scene.raster.height)) continue;
    const glm::dvec3 a = vertices[static_cast<std::size_t>(segment.vertex_0)].raster,
                     b = vertices[static_cast<std::size_t>(segment.vertex_1)].raster;
    if (a.x == b.x) continue;
    const double z = a.z + (b.z - a.z) * (test->x - a.x) / (b.x - a.x);
    double nearest = no_depth, farthest = -no_depth;
    for (std::int32_t y = static_cast<std::int32_t>(row) - 1; y <= static_cast<std::int32_t>(row) + 1; ++y)
      for (std::int32_t x = test->x - 1; x <= test->x + 1; ++x) {
        if (x < 0 || y < 0 || x >= scene.raster.width || y >= scene.raster.height) continue;
        nearest = std::min(nearest, truth.depth[truth.at(x, y)]);
        farthest = std::max(farthest, truth.depth[truth.at(x, y)]);
      }
    ++judgement.tested;
    const bool hidden = test->verdict == Horizon::hidden;
    judgement.hidden += hidden;
    if (hidden ? z >= nearest : z <= farthest) continue;
    ++judgement.wrong;
    const auto column = static_cast<std::size_t>(test->x);
    const double below_upper = test->y_curve - upper[column], above_lower = lower[column] - test->y_curve;
    const double inside = std::min(below_upper, above_lower);  // rows inside the band, negative outside of it
    judgement.worst = std::max(judgement.worst, std::abs(inside));
  }
  return judgement;
}

/// A scene without a surface.
Scene screen_only() {
  Scene scene;
  scene.raster = {8, 8, false};
  return scene;
}

bool any_ink(const Picture& picture) {
  return std::any_of(picture.ink.begin(), picture.ink.end(), [](std::uint32_t ink) { return ink != no_ink; });
}

constexpr const char* heights[] = {"sin(x)*cos(z)", "2*exp(-x^2-z^2)", "cos(2*sqrt(x^2+z^2))*exp(-sqrt(x^2+z^2)/5)",
                                   "x*z/4"};

}  // namespace

TEST_SUITE("floating horizon against the Z-buffer") {
  TEST_CASE("whatever the side, above or below: what is judged wrong is little, and near a horizon") {
    for (const bool parallel : {true, false}) {
      Judgement all;
      for (const char* formula : heights)
        for (const double theta : {-90.0, -60.0, 20.0, 95.0, 230.0})
          for (const double phi : {80.0, 60.0, 30.0, 130.0}) {
            const Judgement one = judge(looked_at(formula, theta, phi, 120, 90, parallel));
            CAPTURE(std::string(formula));
            CAPTURE(theta);
            CAPTURE(phi);
            CAPTURE(parallel);
            CHECK(one.tested > 400);
            CHECK(one.worst <= 4);
            CHECK(50 * one.wrong <= one.tested);
            all.tested += one.tested;
            all.hidden += one.hidden;
            all.wrong += one.wrong;
            all.worst = std::max(all.worst, one.worst);
          }
      MESSAGE(std::string(parallel ? "parallel: " : "perspective: "), all.tested, " points tested, ", all.hidden,
              " hidden, ", all.wrong, " judged wrong, at most ", all.worst, " rows from the horizon");
      CHECK(500 * all.wrong <= all.tested);
      CHECK(all.hidden > 10'000);
    }
  }

  TEST_CASE("one horizon, or none at the sides, is found to be wrong") {
    const Scene scene = looked_at("sin(x)*cos(z)", -20, 85, 120, 90, true);
    CHECK(judge(scene).wrong == 0);
    CHECK(judge(looked_at("sin(x)*cos(z)", -60, 75, 120, 90), {{"horizons", "one"}}).worst > 3);
    CHECK(judge(scene, {{"sides", "off"}}).wrong > 5);
  }

  TEST_CASE("curves of constant x are judged as well as those of constant z") {
    for (const char* formula : heights) {
      CAPTURE(std::string(formula));
      const Judgement judgement = judge(looked_at(formula, -60, 60, 120, 90), {{"across", "on"}});
      CHECK(judgement.tested > 2000);
      CHECK(judgement.worst <= 4);
      CHECK(200 * judgement.wrong <= judgement.tested);
    }
  }
}

TEST_SUITE("floating horizon, degenerate") {
  TEST_CASE("front to back follows the eye") {
    const auto firsts = [](double theta, bool parallel) {
      const Order order = rows_front_to_back(looked_at("sin(x)*cos(z)", theta, 60, 40, 30, parallel));
      REQUIRE(order.size() == 1);
      REQUIRE(order[0].size() == 30);
      return std::pair(order[0].front(), order[0].back());
    };
    for (const bool parallel : {true, false}) {
      CHECK(firsts(-90, parallel) == std::pair(0, 29));
      CHECK(firsts(90, parallel) == std::pair(29, 0));
    }
  }

  TEST_CASE("an eye between two rows sees two surfaces, each with horizons of its own") {
    const Scene scene = looked_at("sin(x)*cos(z)", 0, 60, 40, 30);
    const Order order = rows_front_to_back(scene);
    REQUIRE(order.size() == 2);
    CHECK(order[0].front() == 15);
    CHECK(order[0].back() == 29);
    CHECK(order[1].front() == 14);
    CHECK(order[1].back() == 0);
    // Both begin with what lies between the two rows, which is nearest and drawn by neither.
    std::size_t between = 0;
    for (const CurveSegment& segment : run_horizon(scene, {{"sides", "off"}}).record.all<CurveSegment>())
      between += std::abs(segment.vertex_1 - segment.vertex_0) == 40;
    CHECK(between == 2 * 40);
    CHECK(judge(looked_at("sin(x)*cos(z)", 10, 60, 120, 90)).worst <= 1);
  }

  TEST_CASE("from the other side, a surface that is the same from there looks the same") {
    const auto ink = [](double theta) {
      return run_horizon(looked_at("cos(x)*cos(z)", theta, 60, 41, 31)).picture.ink;
    };
    const auto front = ink(-90), back = ink(90);
    const auto count = [](const auto& all) { return std::count(all.begin(), all.end(), no_ink); };
    CHECK(std::abs(count(front) - count(back)) <= 4);  // the pixels' centres are not mirrored to the bit
  }

  TEST_CASE("from below the lower side shows") {
    const auto below = [](double phi) {
      const Picture picture = run_horizon(looked_at("sin(x)*cos(z)", -60, phi, 80, 60)).picture;
      return std::count(picture.ink.begin(), picture.ink.end(), ink_of({213, 94, 0}));
    };
    CHECK(below(130) > 10 * (below(50) + 1));
  }

  TEST_CASE("a flat surface: all of it is seen, from above, and edge-on as one line") {
    const HorizonRun above = run_horizon(looked_at("0", -60, 60, 60, 45));
    for (const HorizonTest& test : above.record.all<HorizonTest>()) CHECK(test.verdict == Horizon::above);
    const HorizonRun level = run_horizon(looked_at("0", -90, 90, 60, 45, true));
    std::int32_t row = -1;
    for (const ColorWrite& write : level.record.all<ColorWrite>()) {
      if (row < 0) row = write.y;
      CHECK(write.y == row);
    }
    CHECK(row >= 0);
    // All curves lie on both horizons that the first one made.
    for (const HorizonTest& test : level.record.all<HorizonTest>()) CHECK(test.verdict == Horizon::above);
    std::map<std::pair<std::int32_t, bool>, int> moves;
    for (const HorizonMove& move : level.record.all<HorizonMove>())
      moves[{move.x, move.upper}] += std::isfinite(move.y_curve);
    for (const auto& [horizon, count] : moves) CHECK(count <= 1);
  }

  TEST_CASE("one row is one curve, one column and one sample are none") {
    CHECK(any_ink(run_horizon(surface_of({{0, 2, {3, 4, 3}}})).picture));
    CHECK_FALSE(any_ink(run_horizon(surface_of({{3, 1, {3}}, {3, 1, {2}}})).picture));
    CHECK_FALSE(any_ink(run_horizon(surface_of({{3, 1, {3}}})).picture));
    CHECK(any_ink(run_horizon(surface_of({{3, 1, {3}}, {3, 1, {2}}}), {{"across", "on"}}).picture));
  }

  TEST_CASE("curves seen edge-on stand on the nearest column") {
    const HorizonRun run = run_horizon(surface_of({{3.4, 0, {5, 1, 3}}}));
    for (const ColorWrite& write : run.record.all<ColorWrite>()) CHECK(write.x == 3);
    CHECK(drawn(run.picture)[0] == "........");
    for (std::size_t y = 1; y <= 5; ++y) CHECK(drawn(run.picture)[y] == "...#....");
  }

  TEST_CASE("out of view, behind the eye, around the eye") {
    Scene scene = looked_at("sin(x)*cos(z)", -60, 60, 40, 30);
    for (glm::dvec3& point : scene.points) point.x += 1000;
    CHECK_FALSE(any_ink(run_horizon(scene).picture));
    ViewOptions close;
    close.rho = 1;
    close.theta = -60;
    close.width = 40;
    close.height = 30;
    const Scene around = look_at_scene(load_scene("y = sin(x)*cos(z) - 1").scene, close);
    CHECK(any_ink(run_horizon(around).picture));
    for (glm::dvec3& point : scene.points) point *= 1e25;
    run_horizon(scene);
    CHECK_FALSE(any_ink(run_horizon(screen_only()).picture));
  }

  TEST_CASE("light ink on dark paper") {
    Scene scene = surface_of({{0, 2, {3, 4, 3}}});
    scene.background = {20, 20, 60};
    const Picture picture = run_horizon(scene).picture;
    CHECK(picture.ink[picture.at(0, 3)] == ink_of({255, 255, 255}));
  }
}
