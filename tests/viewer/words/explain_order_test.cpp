// What is said of pieces, of the five tests and of the drawing list.
#include <string>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

const Trace& five_tests() {
  static const Trace trace = test::record_run_by("depth-sort", test::in_checkout("lessons/scenes/five-tests.toml"));
  return trace;
}

/// What is told of the n-th event, from 1, that this step of the page recorded.
Explanation told_of(const Trace& trace, const std::string& step, int nth = 1) {
  const StepInfo* info = find_step(trace.header().page, step);
  REQUIRE(info != nullptr);
  std::int64_t position = 0;
  for (int i = 0; i < nth; ++i) {
    const auto found = trace.next(position, [&](const RecordedEvent& recorded) { return recorded.step == info->id; });
    REQUIRE(found.has_value());
    position = *found;
  }
  Replay replay(trace);
  replay.go_to(position);
  return explain(trace, replay.state(), *replay.current());
}

std::string formulas_of(const Explanation& told) {
  std::string all;
  for (const std::string& formula : told.formulas) all += formula + "\n";
  return all;
}

bool says(const std::string& text, const std::string& part) {
  CAPTURE(text);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("depth sort: every event has a sentence, and its formula gives the recorded number") {
  for (const std::string& scene : {std::string("cyclic"), std::string("intersecting"), std::string("pyramid"),
                                   test::in_checkout("lessons/scenes/five-tests.toml")}) {
    for (const char* by : {"painter", "depth-sort"}) {
      const Trace trace = test::record_run_by(by, scene);
      Replay replay(trace);
      while (replay.position() < trace.size()) {
        replay.step_forward();
        const Explanation told = explain(trace, replay.state(), *replay.current());
        const auto position = replay.position();
        CAPTURE(scene);
        CAPTURE(position);
        REQUIRE(told.sentence.ends_with('.'));
        REQUIRE_MESSAGE(!told.doubt, told.doubt.value_or(""));
      }
    }
  }
}

TEST_CASE("depth sort: extents that are apart, with their numbers") {
  const Explanation x = told_of(five_tests(), "test_1");
  CHECK(says(x.sentence, "The x extents of A and B do not overlap"));
  CHECK(says(formulas_of(x), "15.5 \u2264 18.5"));
  const Explanation y = told_of(five_tests(), "test_2");
  CHECK(says(y.sentence, "The y extents of A and C do not overlap"));
  CHECK(says(told_of(five_tests(), "z_extents").sentence, "cannot hide it"));
}

TEST_CASE("depth sort: sides of a plane, turned so that the eye's side is negative") {
  const Explanation both = told_of(five_tests(), "test_3");
  CHECK(says(both.sentence, "A lies on both sides of the plane of F. This test cannot decide."));
  CHECK(says(formulas_of(both), "f(x, y, z) = \u22120.4472\u00b7y + 0.8944\u00b7z + (\u22124.6957)"));
  CHECK(says(told_of(five_tests(), "test_3", 2).sentence,
             "All of A lies behind the plane of D. So A may be drawn first."));
  CHECK(says(told_of(five_tests(), "test_4", 2).sentence,
             "All of E lies on the eye's side of the plane of A. So A may be drawn first."));
  CHECK(says(told_of(five_tests(), "test_3_swapped").sentence,
             "All of G lies behind the plane of B. So G may be drawn first."));
  CHECK(says(told_of(five_tests(), "split").sentence, "C lies on both sides of the plane of H: it is cut there."));
}

TEST_CASE("depth sort: projections, with the depths at the point that both cover") {
  CHECK(says(told_of(five_tests(), "test_5").sentence, "A and F do not overlap"));
  const Explanation overlap = told_of(five_tests(), "test_5", 2);
  CHECK(says(overlap.sentence, "B and G overlap, for one at (27, 6.5)"));
  CHECK(says(formulas_of(overlap), "z of B = 4.5, of G = 9"));
}

TEST_CASE("depth sort: the list") {
  CHECK(says(told_of(five_tests(), "insert").sentence, "A goes to the first place of the list"));
  CHECK(says(formulas_of(told_of(five_tests(), "insert", 2)), "farthest z = 13"));
  CHECK(says(told_of(five_tests(), "move").sentence, "G becomes the first of the list"));
  CHECK(says(told_of(five_tests(), "mark").sentence, "G is marked"));
  CHECK(says(told_of(five_tests(), "take_out").sentence, "G leaves its place"));
  CHECK(says(told_of(five_tests(), "remove").sentence, "C leaves the list: its parts take over"));
  CHECK(says(told_of(five_tests(), "part").sentence, "One part of C becomes a piece of its own, C1: 4 corners"));
  CHECK(says(told_of(five_tests(), "insert_part").sentence, "C1 goes to the first place"));
  CHECK(says(told_of(five_tests(), "drawn").sentence, "A is drawn and leaves the list; 7 to go."));
}

TEST_CASE("depth sort: a corner of a part, and a pixel painted over another") {
  CHECK(says(told_of(five_tests(), "cutting.outline").sentence, "of the part"));
  CHECK(says(formulas_of(told_of(five_tests(), "cut")), "t = d_0/(d_0 \u2212 d_1) = 0.5667"));
  CHECK(says(told_of(five_tests(), "paint").sentence, "It showed background"));
}

TEST_CASE("depth sort: a number that is not what the plane gives is pointed out") {
  Trace trace = test::record_run_by("depth-sort", test::in_checkout("lessons/scenes/five-tests.toml"));
  const StepInfo* info = find_step(trace.header().page, "test_3");
  const auto found = trace.next(0, [&](const RecordedEvent& recorded) { return recorded.step == info->id; });
  Replay replay(trace);
  replay.go_to(*found);
  RecordedEvent wrong = *replay.current();
  get<SideTest>(wrong.event).least -= 1;
  CHECK(explain(trace, replay.state(), wrong).doubt.has_value());
}
