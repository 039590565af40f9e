// Half-planes: which edge leaves a pixel out, which tile was too far, and a depth followed back to the vertices; and a
// wrong number is found at its step.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "sim/answers/explain_value.hpp"
#include "sim/answers/why_not.hpp"
#include "tests/golden/golden.hpp"
#include "tests/golden/run_edits.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/check/check.hpp"
#include "traces/events/fields.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::answers;

namespace {

Trace half_space_run(const Scene& scene, const Conventions& conventions = {}) {
  return test::recorded_by("half-space", scene, conventions);
}

Scene by_hand() { return test::screen_scene(9, 8, {{{1, 1, 2}, {7, 2, 4}, {3, 6, 8}}}); }

const InsideTest* test_at(const Trace& trace, std::int64_t step) {
  return step < 1 ? nullptr : get_if<InsideTest>(&trace.event(step).event);
}

}  // namespace

TEST_SUITE("half_space/answers") {
  TEST_CASE("why-not names the edge on whose wrong side the centre lies, and the one that is not owned") {
    const Trace trace = half_space_run(by_hand());
    const answers::Verdict beyond = why_not(trace, 0, {6, 5});
    CHECK(beyond.kind == Why::not_covered);
    const InsideTest* test = test_at(trace, beyond.step);
    REQUIRE(test != nullptr);
    CHECK(test->x == 6);
    CHECK(test->y == 5);
    CHECK(beyond.sentence.find("e0: E_0(6, 5) = \u22128 < 0") != std::string::npos);
    CHECK(!beyond.formulas.empty());

    const answers::Verdict on = why_not(trace, 0, {5, 4});
    CHECK(on.kind == Why::not_covered);
    CHECK(test_at(trace, on.step) != nullptr);
    CHECK(on.sentence.find("E_0(5, 4) = 0") != std::string::npos);
  }

  TEST_CASE("why-not says of a polygon that only samples show that it is mixed in, with its share") {
    for (const char* samples : {"4", "a-buffer"}) {
      CAPTURE(samples);
      Conventions conventions;
      conventions.options["samples"] = samples;
      const Trace trace = half_space_run(by_hand(), conventions);
      Replay replay(trace);
      replay.go_to(trace.size());
      int mixed = 0;
      for (std::int64_t step = 1; step <= trace.size(); ++step) {
        const Event event = trace.event(step).event;
        const auto* share = get_if<CoverageAdd>(&event);
        if (!share || share->owner != 0) continue;
        const bool has_centre = replay.state().picture.polygon[replay.state().picture.at(share->x, share->y)] == 0;
        const answers::Verdict verdict = why_not(trace, 0, {share->x, share->y});
        CHECK(verdict.kind == (has_centre ? Why::seen : Why::mixed));
        if (has_centre) continue;
        ++mixed;
        CHECK(verdict.step == step);
      }
      CHECK(mixed > 3);
    }
  }

  TEST_CASE("why-not names the tile that was beyond an edge, and the one that was too far") {
    const Scene scene = test::screen_scene(
        24, 24, {{{0, 0, 2}, {24, 0, 2}, {24, 24, 2}, {0, 24, 2}}, {{0, 0, 5}, {23, 0, 5}, {0, 23, 5}}});
    Conventions conventions;
    conventions.options["tiles"] = "8";
    conventions.options["hierarchical-z"] = "on";
    const Trace trace = half_space_run(scene, conventions);
    const answers::Verdict beyond = why_not(trace, 1, {22, 22});
    CHECK(beyond.kind == Why::not_covered);
    REQUIRE(beyond.step > 0);
    CHECK(holds<TileTest>(trace.event(beyond.step).event));
    const answers::Verdict hidden = why_not(trace, 1, {3, 3});
    CHECK(hidden.kind == Why::lost);
    REQUIRE(hidden.step > 0);
    CHECK(holds<TileDepthTest>(trace.event(hidden.step).event));
    CHECK(hidden.other == 0);
  }

  TEST_CASE("a depth is followed back through the weights and the edge functions to the vertices") {
    const Trace trace = half_space_run(by_hand());
    Question question;
    question.at = trace.size();
    question.pixel = Trace::Pixel{3, 3};
    const Chain chain = explain_value(trace, question);
    std::set<std::string> kinds;
    int given = 0;
    for (const ChainLink& link : chain.links) {
      if (link.step > 0) kinds.insert(std::string(kind_names()[trace.event(link.step).event.index()]));
      given += link.given;
      for (const ChainValue& value : link.values) CHECK(answers::holds(value));
    }
    for (const char* kind :
         {"depth_interpolate", "barycentric_weights", "inside_test", "edge_function", "triangle_setup"}) {
      CAPTURE(kind);
      CHECK(kinds.contains(kind));
    }
    CHECK(given >= 3);
    REQUIRE(!chain.links.empty());
    CHECK(chain.links[0].values[0].value == doctest::Approx(32.0 / 7));
  }

  TEST_CASE("a wrong number of a triangle is found at its own step first") {
    const test::RunLines lines = test::lines_of_run("tests/golden/half-space.jsonl");
    REQUIRE(check(test::trace_of_lines(lines)).causes.empty());
    const struct {
      const char *edit, *field;
    } wrong[] = {{"set edge 2 edge_c=77.5", "edge_c"},
                 {"set edge 2 owns=true", "owns"},
                 {"set triangle 2 twice_area=3.5", "twice_area"},
                 {"set triangle 1 end_row=3", "end_row"},
                 {"set weights 3 w_1=0.75", "w_1"},
                 {"set interpolate_z 2 z=1.5", "z"},
                 {"set test 9 e_0=-0.125", "e_0"}};
    for (const auto& one : wrong) {
      CAPTURE(one.edit);
      const test::RunLines changed = test::with_edit(lines, one.edit);
      std::size_t at = 1;
      while (at < lines.size() && lines[at] == changed[at]) ++at;
      const CheckReport report = check(test::trace_of_lines(changed));
      REQUIRE(!report.causes.empty());
      CHECK(report.causes.front().first.step == static_cast<std::int64_t>(at));
      CHECK(report.causes.front().first.field == one.field);
    }
  }

  TEST_CASE("an inside that is false is found at its test, and what follows from it is no cause of its own") {
    const test::RunLines lines = test::lines_of_run("tests/golden/half-space.jsonl");
    const Trace golden = test::trace_of_lines(lines);
    int number = 0;
    std::int64_t step = 0;
    for (std::int64_t at = 1; at <= golden.size() && step == 0; ++at)
      if (const auto* test = get_if<InsideTest>(&golden.event(at).event)) {
        ++number;
        if (test->inside) step = at;
      }
    REQUIRE(step > 0);
    const CheckReport report =
        check(test::trace_of_lines(test::with_edit(lines, "set test " + std::to_string(number) + " inside=false")));
    REQUIRE(!report.causes.empty());
    CHECK(report.causes.front().first.step == step);
    CHECK(report.causes.front().first.field == "inside");
  }
}
