// What check and diff say of a cause: whole sentences, each once.
#include "sim/words/judged.hpp"

#include <doctest/doctest.h>

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
  Fault impossible;
  impossible.impossible = "edge 7 is not in the edge table";
  CHECK(what_is_wrong(impossible, {}) == "this step is impossible: edge 7 is not in the edge table");
}

TEST_CASE("check: how often a fault comes again, and what follows from it") {
  CHECK(what_follows(Cause{}) == "");
  CHECK(what_follows(Cause{{}, 1, 0}) == "1 later step has the same fault");
  CHECK(what_follows(Cause{{}, 2, 1}) == "2 later steps have the same fault; 1 step follows from it");
  CHECK(what_follows(Cause{{}, 0, 30}) == "30 steps follow from it");
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
  CHECK(why(7, 7, Part::different, false, false) == "its operands are the same in both runs, its result is not");

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
