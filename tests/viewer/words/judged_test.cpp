// What check and diff say of a cause: whole sentences, each once.
#include "sim/words/judged.hpp"

#include <limits>
#include <utility>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

TEST_CASE("check: what is wrong, what was expected and what was found, in one line") {
  Fault fault;
  fault.field = "z", fault.recorded = 0.55, fault.expected = 0.5;
  CHECK(what_is_wrong(fault, {"", "z_L + z_R = 0.2 + 0.3 = 0.5"}) ==
        "z = z_L + z_R = 0.2 + 0.3 = 0.5, but the trace has 0.55");
  CHECK(what_is_wrong(fault, {}) == "z = 0.5, but the trace has 0.55");
  fault.field = "nearer", fault.recorded = 1, fault.expected = 0;
  const FaultText compare{"", "z < zbuffer[x,y]:  5 < 5 is false", true};
  CHECK(what_is_wrong(fault, compare) == "z < zbuffer[x,y]:  5 < 5 is false, but the trace says nearer");
  fault.recorded = 0, fault.expected = 1;
  CHECK(what_is_wrong(fault, compare) == "z < zbuffer[x,y]:  5 < 5 is false, but the trace says not nearer");
  Fault rule;
  rule.rule = formulas::Rule::hides_of_line;
  CHECK(what_is_wrong(rule, {}) == "The hidden or visible part does not lie between the ends of the line.");
  // Words, and true and false, stand as such.
  Fault word;
  word.kind = kind_of<FacingTest>, word.field = "facing", word.recorded = 1, word.expected = 0;
  CHECK(what_is_wrong(word, {}) == "facing = front, but the trace has back");
  word.kind = kind_of<ClipVertex>, word.field = "inside";
  CHECK(what_is_wrong(word, {}) == "inside = false, but the trace has true");
  Fault impossible;
  impossible.impossible = "edge 7 is not in the edge table";
  CHECK(what_is_wrong(impossible, {}) == "this step is impossible: edge 7 is not in the edge table");
}

TEST_CASE(
    "check: a result has the digits that tell it from what the trace has, and from nothing that does not follow") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/pyramid-view.jsonl"));
  const auto at = right.next<DepthInterpolate>(0, [](const DepthInterpolate&) { return true; });
  REQUIRE(at);
  const auto field_line = [&](const Trace& trace) {
    Replay replay(trace);
    replay.go_to(*at - 1);
    const Event event = trace.event(*at).event;
    const FieldOfKind* z = field_of_kind(event.index(), "z");
    const auto number = static_cast<unsigned>(z - fields_of_kind(event.index()).data());
    return fields_in_words(event, formulas::situation_of(trace, replay.state()),
                           static_cast<std::uint16_t>(1u << number))
        .at(0);
  };
  CHECK(field_line(right).line().find("   from ") != std::string::npos);
  for (const double off : {1e-2, 3e-5, 1e-6, 3e-8}) {
    CAPTURE(off);
    const Trace wrong = test::changed(right, [&](std::int64_t step, Event& event) {
      if (auto* depth = get_if<DepthInterpolate>(&event); depth && step == *at) depth->z += off;
      return true;
    });
    const CheckedRun run = judge_run(wrong, nullptr, false);
    REQUIRE_FALSE(run.report.causes.empty());
    const Fault& fault = run.report.causes.front().first;
    const std::string text = what_is_wrong(fault, run.texts.front()), but = ", but the trace has ";
    CAPTURE(text);
    const std::size_t end = text.find(but), begin = text.rfind(" = ", end) + 3;
    REQUIRE(end != std::string::npos);
    const std::string ought = text.substr(begin, end - begin), is = text.substr(end + but.size());
    CHECK(ought != is);
    CHECK(shown_as(fault.expected, ought));
    CHECK(shown_as(fault.recorded, is));
    const FieldText field = field_line(wrong);
    CHECK_FALSE(field.follows);
    CHECK(field.line().find("   from ") == std::string::npos);
    CHECK(field.formula.substr(field.formula.rfind(" = ") + 3) == ought);
  }
}

TEST_CASE("check: what is no number is called so") {
  Fault fault;
  fault.field = "z", fault.recorded = std::numeric_limits<double>::quiet_NaN(), fault.expected = 0.5;
  CHECK(what_is_wrong(fault, {}) == "z = 0.5, but the trace has NaN");
  fault.expected = fault.recorded;
  CHECK(what_is_wrong(fault, {}) == "z is NaN, where a finite number must be");
  fault.recorded = std::numeric_limits<double>::infinity();
  CHECK(what_is_wrong(fault, {}) == "z is \u221e, where a finite number must be");
}

TEST_CASE("check: how often a fault comes again, and what follows from it") {
  CHECK(what_follows(Cause{}) == "");
  CHECK(what_follows(Cause{{}, 1, 0}) == "1 later step has the same fault");
  CHECK(what_follows(Cause{{}, 2, 1}) == "2 later steps have the same fault; 1 step follows from it");
  CHECK(what_follows(Cause{{}, 0, 30}) == "30 steps follow from it");
}

TEST_CASE("check and diff: a step about a plane is about no edge") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/plane.jsonl"));
  const Trace wrong = test::changed(right, [done = false](std::int64_t, Event& event) mutable {
    auto* slopes = get_if<PlaneSlopes>(&event);
    if (slopes && !std::exchange(done, true)) slopes->dz_dx += 9;
    return true;
  });
  const CheckedRun run = judge_run(wrong, nullptr, false);
  REQUIRE(!run.texts.empty());
  REQUIRE(run.report.causes[0].first.kind == kind_of<PlaneSlopes>);
  const auto slopes = get<PlaneSlopes>(wrong.event(run.report.causes[0].first.step).event);
  CHECK(run.texts[0].subject == "the plane of " + polygon_label(wrong.scene(), slopes.polygon));
}

TEST_CASE("diff: why a step is a cause, and what follows from it") {
  const auto why = [](std::int64_t a, std::int64_t b, diff::Part part, bool wrong_a, bool wrong_b) {
    diff::Cause cause;
    cause.first.a = a, cause.first.b = b, cause.part = part, cause.wrong_a = wrong_a, cause.wrong_b = wrong_b;
    return why_cause(cause);
  };
  using diff::Part;
  CHECK(why(7, 0, Part::different, false, false) == "A has this step, B does not");
  CHECK(why(0, 7, Part::different, false, true) == "B has this step, A does not");
  CHECK(why(7, 7, Part::rounding, false, false) == "only rounding: its operands are the same, or differ by rounding");
  CHECK(why(7, 7, Part::different, false, true) == "B computes it wrongly from its own operands");
  CHECK(why(7, 7, Part::different, true, false) == "A computes it wrongly from its own operands");
  CHECK(why(7, 7, Part::different, true, true) == "both compute it wrongly from their own operands");
  CHECK(why(7, 7, Part::different, false, false) ==
        "each run computes it rightly by its own header and operands: these differ, and no step that both record says "
        "why");

  diff::Cause moved;
  moved.first.a = 7, moved.elsewhere = 1234;
  CHECK(why_cause(moved) == "B has this step at another place, step 1\u00a0234");
  diff::Cause told;
  told.first.a = told.first.b = 7, told.unexplained = true;
  CHECK(why_cause(told) == "the results differ, and what they follow from is not recorded in both runs");
  told.part = Part::rounding;
  CHECK(why_cause(told) == "only rounding: the results are no farther apart than the number formats allow");
  told.part = Part::different, told.tie = true;
  CHECK(why_cause(told) ==
        "a tie: in both runs z is equal to what is stored, and only one of them takes the later polygon");

  diff::Cause turned;
  turned.first.a = turned.first.b = 7, turned.other_order = diff::OtherOrder{3, 9, true};
  CHECK(why_cause(turned) ==
        "the runs draw in another order: A has step 3 before this one, B has the same, step 9, after it");
  turned.other_order = diff::OtherOrder{9, 3, false};
  CHECK(why_cause(turned) ==
        "the runs draw in another order: A has step 9 after this one, B has the same, step 3, before it");
  turned.other_order.reset(), turned.unjudged = true;
  CHECK(why_cause(turned) == "the results differ, and nothing in the runs says which one is right");

  diff::Cause cause;
  CHECK(what_follows(cause) == "");
  cause.again = 1, cause.symptoms = 2, cause.pixels = 1;
  CHECK(what_follows(cause) ==
        "1 later step differs likewise; 2 differences follow from it; 1 differing step writes a pixel");
  cause.again = 2, cause.symptoms = 1, cause.pixels = 3;
  CHECK(what_follows(cause) ==
        "2 later steps differ likewise; 1 difference follows from it; 3 differing steps write pixels");
}

}  // namespace
