// zstep check: reasons that a run gives, and which of two numbers is wrong.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/check.hpp"
#include "traces/file/jsonl.hpp"

using namespace zstep;

namespace {

bool breaks(const Trace& trace, formulas::Rule rule) {
  const CheckReport report = check(trace);
  return std::any_of(report.causes.begin(), report.causes.end(),
                     [&](const Cause& cause) { return cause.first.rule == rule; });
}
bool leaves_open(const Trace& trace, std::uint8_t kind) {
  const std::vector<NotJudged> left = not_judged(check(trace));
  return std::any_of(left.begin(), left.end(), [&](const NotJudged& one) { return one.kind == kind; });
}

/// A run that drops the scene's first polygon, and prints no test that would give the reason.
Trace dropping(const Scene& scene, const Conventions& conventions, std::string_view reason, bool cull_declared = true) {
  std::string head = test::head("z-buffer", scene, conventions);
  const std::string cull = std::string("\"cull\":") + (conventions.cull ? "true," : "false,");
  if (!cull_declared) head.erase(head.find(cull), cull.size());
  return test::trace_of(head +
                        R"({"step":"polygon","polygon":0,"facet":0})"
                        "\n"
                        R"({"step":"reject","polygon":0,"reason":")" +
                        std::string(reason) + "\"}\n");
}

Scene on_screen(std::vector<glm::dvec3> corners) {
  Scene scene;
  scene.camera.kind = Camera::Kind::screen, scene.raster = {16, 16, false};
  scene.points = std::move(corners);
  scene.corners = {0, 1, 2}, scene.polygons.resize(1), scene.facets = {{0, 0, 3}};
  return scene;
}

TEST_CASE("check: a polygon on the screen is dropped for a reason that its vertices give, or that they cannot give") {
  using formulas::Rule;
  const Scene drawn = on_screen({{1, 1, 0}, {12, 2, 0}, {4, 11, 1}}),
              thin = on_screen({{1, 1, 0}, {5, 5, 0}, {9, 9, 1}}),
              beside = on_screen({{20, 1, 0}, {32, 2, 0}, {24, 11, 1}}),
              around = on_screen({{-90, -90, 0}, {200, -90, 0}, {-90, 200, 1}});
  Conventions conventions;
  conventions.cull = false;
  for (const char* reason : {"edge_on", "outside", "degenerate", "back_facing"}) {
    CAPTURE(reason);
    CHECK(breaks(dropping(drawn, conventions, reason), Rule::reject_is_right));
    CHECK(breaks(dropping(around, conventions, reason), Rule::reject_is_right));
  }
  for (const char* reason : {"edge_on", "degenerate"})
    CHECK(verdict_of(check(dropping(thin, conventions, reason))) != Verdict::wrong);
  CHECK_FALSE(breaks(dropping(beside, conventions, "outside"), Rule::reject_is_right));
  CHECK_FALSE(leaves_open(dropping(beside, conventions, "outside"), kind_of<PolygonReject>));
  // Which way round back faces go is the program's own where there is no eye.
  const Trace open = dropping(drawn, conventions, "back_facing", false);
  CHECK_FALSE(breaks(open, Rule::reject_is_right));
  CHECK(leaves_open(open, kind_of<PolygonReject>));
}

TEST_CASE("check: a polygon before a camera is dropped for a reason that its vertices give") {
  using formulas::Rule;
  int front = 0, back = 0, inside = 0;
  test::for_each_golden([&](const std::string& name, const Trace& right) {
    if (right.scene().camera.kind == Camera::Kind::screen || right.header().algorithm != "z-buffer") return;
    CAPTURE(name);
    std::int32_t polygon = 0;
    for (std::int64_t step = 1; step <= right.size(); ++step) {
      const Event event = right.event(step).event;
      if (const auto* begin = get_if<PolygonBegin>(&event)) polygon = begin->polygon;
      const auto* test = get_if<FacingTest>(&event);
      if (!test || test->facing == Facing::edge_on) continue;
      const bool is_back = test->facing == Facing::back;
      ++(is_back ? back : front);
      // Without its tests, in a run that drops back faces.
      const auto dropped = [&](Reject reason) {
        Conventions conventions = right.header().conventions;
        conventions.cull = true;
        return test::trace_of(zstep::test::head("z-buffer", right.scene(), conventions) +
                              R"({"step":"polygon","polygon":)" + std::to_string(polygon) + R"(,"facet":)" +
                              std::to_string(polygon) + "}\n" + R"({"step":"reject","polygon":)" +
                              std::to_string(polygon) + R"(,"reason":")" + std::string(word_of(reason)) + "\"}\n");
      };
      if (right.scene().facets.size() != right.scene().polygons.size()) continue;
      CHECK(breaks(dropped(Reject::back_facing), Rule::reject_is_right) == !is_back);
      CHECK(breaks(dropped(Reject::edge_on), Rule::reject_is_right));
      const auto clip = right.next<ClipTest>(step, [](const ClipTest&) { return true; });
      const auto next = right.next<PolygonBegin>(step, [](const PolygonBegin&) { return true; });
      const bool all_inside =
          clip && (!next || *clip < *next) && get<ClipTest>(right.event(*clip).event).outside_some == 0;
      inside += all_inside;
      if (all_inside) CHECK(breaks(dropped(Reject::outside), Rule::reject_is_right));
    }
  });
  CHECK(front > 2);
  CHECK(back > 1);
  CHECK(inside > 1);
}

TEST_CASE("check: why an edge is left out follows from its ends") {
  int changed = 0;
  test::for_each_golden([&](const std::string& name, const Trace& right) {
    for (auto step = right.next<EdgeTableSkip>(0, [](const EdgeTableSkip&) { return true; }); step && changed < 40;
         step = right.next<EdgeTableSkip>(
             *step, [](const EdgeTableSkip&) { return true; })) {
      CAPTURE(name);
      CAPTURE(*step);
      ++changed;
      const Trace wrong = test::changed(right, [&](std::int64_t number, Event& event) {
        if (number == *step) {
          EdgeSkip& why = get_if<EdgeTableSkip>(&event)->why;
          why = why == EdgeSkip::horizontal ? EdgeSkip::between_rows : EdgeSkip::horizontal;
        }
        return true;
      });
      const CheckReport report = check(wrong);
      REQUIRE(report.causes.size() == 1);
      CHECK(report.causes[0].first.step == *step);
      CHECK(report.causes[0].first.field == "why");
    }
  });
  CHECK(changed > 10);
}

TEST_CASE("check: an edge above or below the raster may be called outside, as hand-outs have it") {
  const Scene scene = on_screen({{1, -9, 0}, {12, -2, 0}, {4, 11, 1}});
  std::string impossible;
  const Trace run = test::trace_of(test::head("z-buffer", scene, {}) +
                                       R"({"step":"polygon","polygon":0,"facet":0})"
                                       "\n"
                                       R"({"step":"skip_edge","vertex_0":0,"vertex_1":1,"why":"outside"})"
                                       "\n",
                                   &impossible);
  CHECK(run.size() == 2);
  CHECK(check(run).causes.empty());
}

TEST_CASE(
    "check: with inclusive coverage an edge goes on through its last scan line only at its polygon's lowest point") {
  Conventions conventions;
  conventions.coverage = Conventions::Coverage::inclusive;
  // Its lowest point is a corner, or a horizontal edge.
  for (const std::vector<glm::dvec3>& corners :
       {std::vector<glm::dvec3>{{1, 1, 0}, {12, 2, 0}, {4, 11, 1}}, {{1, 1, 0}, {10, 10, 0}, {3, 10, 1}}}) {
    const Trace right = test::recorded_by("z-buffer", on_screen(corners), conventions);
    REQUIRE(check(right).causes.empty());
    int changed = 0;
    for (auto step = right.next<EdgeTableInsert>(0, [](const EdgeTableInsert&) { return true; }); step;
         step = right.next<EdgeTableInsert>(*step, [](const EdgeTableInsert&) { return true; })) {
      const double end =
          right.scene().points[static_cast<std::size_t>(get<EdgeTableInsert>(right.event(*step).event).vertex_1)].y;
      const Trace wrong = test::changed(right, [&](std::int64_t number, Event& event) {
        if (number != *step) return true;
        std::int32_t& row = get_if<EdgeTableInsert>(&event)->end_row;
        row = row > end ? static_cast<std::int32_t>(end) : static_cast<std::int32_t>(end) + 1;
        return true;
      });
      const CheckReport report = check(wrong);
      REQUIRE(!report.causes.empty());
      CHECK(report.causes[0].first.step == *step);
      CHECK(report.causes[0].first.field == "end_row");
      ++changed;
    }
    CHECK(changed > 1);
  }
}

TEST_CASE("check: of numerator and denominator of a ray and a plane the one that is wrong is named") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/ray-casting.jsonl"));
  const auto named = [&](double RayPlane::*field) {
    return check(test::changed(right, [&](std::int64_t, Event& event) {
      if (auto* e = get_if<RayPlane>(&event)) e->*field *= 2.25, e->t = e->numerator / e->denominator;
      return true;
    }));
  };
  for (const auto& [field, name] :
       {std::pair(&RayPlane::numerator, "numerator"), std::pair(&RayPlane::denominator, "denominator")}) {
    const CheckReport report = named(field);
    REQUIRE(!report.causes.empty());
    for (const Cause& cause : report.causes)
      if (cause.first.kind == kind_of<RayPlane>) CHECK(cause.first.field == name);
  }
}

TEST_CASE("check: depths that are the two ends of the range say nothing of fixed point") {
  for (const double other : {0.499999999999, 0.25, -3.0}) {
    CAPTURE(other);
    Scene scene = on_screen({{0, 0, 0.5}, {7, 0, 0.5}, {0, 7, 0.5}, {0, 0, other}, {7, 0, other}, {0, 7, other}});
    scene.corners = {0, 1, 2, 3, 4, 5}, scene.polygons.resize(2), scene.facets = {{0, 0, 3}, {1, 3, 3}};
    Trace run = test::recorded_by("z-buffer", scene, {});
    std::string text = test::jsonl_of(run);
    const std::string declared = R"("number_format":"float64",)";
    REQUIRE(text.find(declared) != text.npos);
    text.erase(text.find(declared), declared.size());
    CHECK(check(test::trace_of(text)).precision.format == NumberFormat::float64);
  }
}

}  // namespace
