// What check counts: what follows from a fault and what does not, what could be judged, and what is said of the whole.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/golden/golden.hpp"
#include "tests/golden/run_edits.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "traces/check/check.hpp"

using namespace zstep;

namespace {

/// Steps of a program that prints no more than what happens at pixels; `conventions`: what its header declares. Its
/// polygons have no area, so that the scene says nothing of them.
Trace run_of(const std::vector<std::string>& steps, const std::string& conventions) {
  test::RunLines lines{
      R"({"ztrace":1,"writer":"my program","algorithm":"z-buffer","conventions":{)" + conventions +
      R"(},"steps":[{"id":1,"name":"clear","event":"buffers_clear"},{"id":2,"name":"polygon","event":"polygon_begin"},)"
      R"({"id":3,"name":"compare","event":"depth_compare"},{"id":4,"name":"store","event":"depth_write"}],)"
      R"("scene":{"raster":{"width":4,"height":4},"camera":{"kind":"screen"},"points":[[0,0,5],[1,1,5],[2,2,5]],)"
      R"("polygons":[{"name":"A"},{"name":"B"}],)"
      R"("facets":[{"polygon":0,"points":[0,1,2]},{"polygon":1,"points":[0,1,2]}]}})"};
  lines.insert(lines.end(), steps.begin(), steps.end());
  return test::trace_of_lines(lines);
}
const std::string first_stays = R"("depth":"view","nearer":"smaller","ties":"first")";

std::string compare(const std::string& z, bool nearer) {
  return R"({"step":"compare","x":1,"y":1,"z":)" + z + R"(,"nearer":)" + (nearer ? "true}" : "false}");
}
std::string store(const std::string& z) { return R"({"step":"store","x":1,"y":1,"z":)" + z + "}"; }
const std::string clear = R"({"step":"clear","z":"inf"})", begin_a = R"({"step":"polygon","polygon":0,"facet":0})",
                  begin_b = R"({"step":"polygon","polygon":1,"facet":1})";

}  // namespace

TEST_CASE("check: what is compared with a wrong depth follows from it, until the buffers are cleared") {
  const Trace trace = run_of({clear, begin_a, compare("5", true), store("6"), begin_b, compare("5.5", true),
                              store("5.5"), clear, begin_a, compare("4", true), store("4")},
                             first_stays);
  CheckMarks marks;
  const CheckReport report = check(trace, nullptr, nullptr, &marks);
  REQUIRE(report.causes.size() == 1);
  CHECK(report.causes[0].first.step == 4);
  std::vector<std::int64_t> touched;
  for (const CheckMarks::Step& step : marks.steps) touched.push_back(step.step);
  CHECK(touched.front() == 4);
  CHECK(std::find(touched.begin(), touched.end(), 6) != touched.end());
  CHECK(touched.back() < 8);
  CHECK(report.inherited == static_cast<std::int64_t>(touched.size()) - 1);
}

TEST_CASE("check: a polygon of the scene without a step of it is missing") {
  CHECK(check(run_of({clear, begin_a, compare("5", true), store("5")}, first_stays)).polygons_missing ==
        std::vector<std::int32_t>{1});
  CHECK(check(run_of({clear, begin_a, compare("5", true), store("5"), begin_b, compare("5", false)}, first_stays))
            .polygons_missing.empty());
}

TEST_CASE(
    "check: who wins of equal depths is judged where the header says, and of others where it says which is nearer") {
  const std::vector<std::string> last_stays{
      clear, begin_a, compare("5", true), store("5"), begin_b, compare("5", true), store("5")};
  const std::vector<std::string> farther_wins{
      clear, begin_a, compare("5", true), store("5"), begin_b, compare("7", true), store("7")};
  const auto wrong = [](const std::vector<std::string>& steps, const std::string& conventions) {
    return check(run_of(steps, conventions)).wrong_steps;
  };
  CHECK(wrong(last_stays, first_stays) == 1);
  CHECK(wrong(last_stays, R"("depth":"view","nearer":"smaller")") == 0);
  CHECK(wrong(last_stays, R"("depth":"view","nearer":"smaller","ties":"last")") == 0);
  CHECK(wrong(farther_wins, R"("depth":"view","nearer":"smaller")") == 1);
  CHECK(wrong(farther_wins, R"("depth":"view","ties":"first")") == 0);
}

TEST_CASE("check: a fault that is made again is counted by steps, the first one apart") {
  const Trace trace =
      run_of({clear, begin_a, compare("5", true), store("6"), begin_b, compare("4", true), store("3")}, first_stays);
  const CheckReport report = check(trace);
  REQUIRE(report.causes.size() == 1);
  CHECK(report.causes[0].again == 1);
  CHECK(report.wrong_steps == 2);
}

TEST_CASE("check: a step in which one rule is broken twice is one wrong step, and none that comes again") {
  // On the last line neither edge moves, and the span there has both.
  Conventions increments;
  increments.interpolation = Conventions::Interpolation::increments;
  const Trace right = test::recorded_by(
      "z-buffer", test::screen_scene(12, 12, {{{2.25, 1.5, 1}, {9.5, 3.25, 2}, {4.75, 9.5, 4}}}), increments);
  const auto last = right.previous(right.size() + 1, [](const RecordedEvent& e) { return holds<SpanBegin>(e.event); });
  REQUIRE(last);
  const auto line = right.previous(*last, [](const RecordedEvent& e) { return holds<ScanLineBegin>(e.event); });
  REQUIRE(line);
  const CheckReport report = check(test::changed(
      right, [&](std::int64_t step, const Event& event) { return step < *line || !holds<EdgeStep>(event); }));
  const auto rule = std::find_if(report.causes.begin(), report.causes.end(), [](const Cause& cause) {
    return cause.first.rule == formulas::Rule::edge_moves_once;
  });
  REQUIRE(rule != report.causes.end());
  CHECK(rule->again == 0);
}

TEST_CASE("check: nothing is wrong only of a run of which all is judged") {
  CheckReport report;
  CHECK(verdict_of(report) == Verdict::not_judged);
  report.judged = report.steps = 1;
  CHECK(verdict_of(report) == Verdict::right_where_judged);
  report.coverage = true;
  CHECK(verdict_of(report) == Verdict::right);
  report.polygons_missing = {0};
  CHECK(verdict_of(report) == Verdict::right_where_judged);
  report.causes.emplace_back();
  CHECK(verdict_of(report) == Verdict::wrong);
}

TEST_CASE("check: an edge that enters with a wrong row of the edge table follows from that row") {
  const Trace trace = test::trace_of_lines(
      test::with_edit(test::lines_of_run("tests/golden/pyramid.jsonl"), "set insert_edge 1 dx_dy=9"));
  CheckMarks marks;
  check(trace, nullptr, nullptr, &marks);
  CHECK(std::any_of(marks.steps.begin(), marks.steps.end(),
                    [&](const CheckMarks::Step& step) { return holds<EdgeEnter>(trace.event(step.step).event); }));
}

TEST_CASE("check: the largest rounding is counted in last digits, whichever step it is in") {
  // Four last digits of 5, and then one of 4.
  const CheckReport report = check(run_of({clear, begin_a, compare("5", true), store("5.0000000000000036"), begin_b,
                                           compare("4", true), store("4.0000000000000009")},
                                          first_stays));
  CHECK(report.causes.empty());
  CHECK(report.rounded == 2);
  CHECK(report.largest_rounding == doctest::Approx(4));
}

TEST_CASE("check: a box that is right beside a wrong plane does not make right what follows from the plane") {
  const Trace trace = test::trace_of_lines(
      test::with_edit(test::lines_of_run("tests/golden/depth-sort.jsonl"), "set plane 7 plane_d=-9.5"));
  const CheckReport report = check(trace);
  const auto plane = std::find_if(report.causes.begin(), report.causes.end(), [](const Cause& cause) {
    return cause.first.kind == kind_of<PlaneEquation> && cause.first.field == "plane_d";
  });
  REQUIRE(plane != report.causes.end());
  CHECK(plane->inherited > 0);
}

TEST_CASE("check: numbers are float32 where nine in ten long ones are") {
  const auto is_float32 = [](int narrow) {
    std::vector<std::string> steps{clear, begin_a};
    for (int i = 0; i < 10; ++i) {
      const double z = std::sqrt(3.0) * (20 - i);
      const double written = i < narrow ? static_cast<double>(static_cast<float>(z)) : z;
      steps.push_back(compare(fmt::format("{:.17g}", written), true));
    }
    return precision_of(run_of(steps, first_stays)).format == NumberFormat::float32;
  };
  CHECK(is_float32(10));
  CHECK(is_float32(9));
  CHECK_FALSE(is_float32(8));
  CHECK_FALSE(is_float32(6));
}
