// What is said of runs that record no writes, or write before they compare.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "sim/answers/pixel_history.hpp"
#include "sim/answers/why_not.hpp"
#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using answers::Outcome, answers::Verdict, answers::Visit, answers::Why;

namespace {

/// A run without steps of these kinds.
template <class... E>
Trace without(const Trace& trace) {
  return test::changed(trace, [](std::int64_t, const Event& event) { return !(holds<E>(event) || ...); });
}
Trace delhi() {
  Conventions conventions;
  conventions.coverage = Conventions::Coverage::inclusive;
  return test::recorded_by("z-buffer", load_scene("delhi").scene, conventions);
}

Verdict why_not(const Trace& trace, const std::string& polygon, std::int32_t x, std::int32_t y) {
  return answers::why_not(trace, *answers::polygon_called(trace.scene(), polygon), {x, y});
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
constexpr const char* unrecorded = "The run does not record what is written to pixels; this follows from its compares.";

/// A step at pixel (1, 1) of a polygon that finds it nearer.
std::int64_t compare_at(const Trace& trace, std::int32_t x, std::int32_t y, int nth) {
  std::int64_t found = 0;
  trace.each(0, trace.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
    const auto* compare = get_if<DepthCompare>(&recorded.event);
    if (compare && compare->x == x && compare->y == y && nth-- == 0) found = step;
    return found == 0;
  });
  REQUIRE(found > 0);
  return found;
}
std::string said_of(const Trace& trace, std::int64_t step) {
  Replay replay(trace);
  replay.go_to(step);
  return explain(trace, replay.state(), *replay.current()).sentence;
}

TEST_CASE("unrecorded: where a run records no writes, compares say whose a pixel is, and that is said") {
  const Trace compares = without<DepthWrite, PixelWrite>(delhi()), depths = without<PixelWrite>(delhi());
  for (const Trace* trace : {&compares, &depths}) {
    const Verdict seen = why_not(*trace, "B", 1, 2), gone = why_not(*trace, "A", 1, 2),
                  lost = why_not(*trace, "B", 1, 4);
    CHECK(seen.kind == Why::seen);
    CHECK(gone.kind == Why::overwritten);
    CHECK(lost.kind == Why::lost);
    for (const Verdict* one : {&seen, &gone, &lost}) {
      CAPTURE(one->sentence);
      CHECK(has(one->sentence, unrecorded));
      CHECK(!has(one->sentence, "never written"));
      CHECK(!has(one->sentence, "not say that it was written"));
      for (const std::string& formula : one->formulas) CHECK(!has(formula, "nothing is written"));
    }
    for (const auto& visit : answers::pixel_history(*trace, {1, 2})) CHECK(visit.remark == "");
    const std::string said = said_of(*trace, compare_at(*trace, 1, 2, 0));
    CAPTURE(said);
    CHECK(has(said, "so pixel (1, 2) becomes A."));
  }
  CHECK(!has(why_not(delhi(), "A", 1, 2).sentence, "does not record"));
}

TEST_CASE("unrecorded: a compare whose depth alone is written is not one of which nothing is") {
  const Trace run = delhi();
  const std::int64_t compare = compare_at(run, 2, 3, 0);
  const Trace trace = test::changed(run, [&](std::int64_t step, const Event&) { return step != compare + 2; });
  REQUIRE(holds<PixelWrite>(run.event(compare + 2).event));
  CAPTURE(said_of(trace, compare));
  CAPTURE(why_not(trace, "A", 2, 3).sentence);
  CHECK(has(said_of(trace, compare), "so pixel (2, 3) should become A, but its depth alone is written"));
  CHECK(has(why_not(trace, "A", 2, 3).sentence,
            "it was found to be nearer, but its depth alone was written, at step " + std::to_string(compare + 1)));
}

TEST_CASE("unrecorded: of a compare with a depth that the run does not record there are no numbers") {
  // Neither is the buffer cleared, nor does the header say what it holds; the second compare is against the first.
  const Trace trace = without<BuffersClear, DepthWrite>(delhi());
  const Verdict gone = why_not(trace, "A", 1, 2), seen = why_not(trace, "B", 1, 2);
  for (const Verdict* one : {&gone, &seen})
    for (const std::string& formula : one->formulas) {
      CAPTURE(formula);
      CHECK(!has(formula, "\u221e"));
      CHECK(has(formula, "5"));
    }
  CHECK(!gone.formulas.empty());
  const Trace first = without<BuffersClear, DepthWrite, PixelWrite>(delhi());
  const Verdict alone = why_not(first, "A", 2, 6);
  CHECK(alone.kind == Why::seen);
  CHECK(alone.formulas.empty());
  CHECK(has(alone.chain.back().text, "nearer than a depth that the trace does not record"));
}

TEST_CASE("unrecorded: who writes first and compares then takes the pixel where it writes") {
  const Trace trace = open_jsonl(test::in_checkout("tests/data/foreign/writefirst.jsonl"));
  const Verdict gone = why_not(trace, "A", 1, 1);
  CHECK(gone.sentence ==
        "A is not seen at pixel (1, 1): it was there from step 55 on, until step 203 wrote B; only then, at step 204, "
        "B was compared, and found to be nearer.");
  CHECK(gone.step == 203);
  const auto history = answers::pixel_history(trace, {1, 1});
  REQUIRE(history.size() == 2);
  CHECK(answers::outcome_text(trace, history, history[0]) == "nearer; B comes over it at step 203");
}

TEST_CASE("unrecorded: a depth that was interpolated, and of which no compare is recorded, is told of") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  int lost = 0;
  for (std::int64_t step = 1; step <= right.size(); ++step) {
    const auto* lost_compare = get_if<DepthCompare>(&right.event(step).event);
    if (!lost_compare || lost_compare->nearer) continue;
    ++lost;
    const DepthCompare at = *lost_compare;
    const Trace::Pixel pixel{at.x, at.y};
    const std::int64_t interpolated = step - 1;
    REQUIRE(holds<DepthInterpolate>(right.event(interpolated).event));
    const std::vector<Visit> before = answers::pixel_history(right, pixel);
    const auto whose = [&] {
      for (const Visit& visit : before)
        if (visit.step == step) return visit.polygon;
      return no_polygon;
    }();
    REQUIRE(whose != no_polygon);
    // One compare is left out.
    const Trace run = test::changed(right, [&](std::int64_t number, const Event&) { return number != step; });
    const Verdict verdict = answers::why_not(run, whose, pixel);
    CHECK(verdict.kind == Why::not_recorded);
    CHECK(verdict.step == interpolated);
    CHECK(verdict.sentence.find(fmt::format("it was interpolated there at step {}", interpolated)) !=
          std::string::npos);
    REQUIRE(verdict.chain.size() == 1);
    CHECK(verdict.chain[0].step == interpolated);
    const std::vector<Visit> history = answers::pixel_history(run, pixel);
    REQUIRE(history.size() == before.size());
    int told = 0;
    for (const Visit& visit : history) {
      if (visit.outcome != Outcome::interpolated) continue;
      ++told;
      CHECK(visit.step == interpolated);
      CHECK(visit.polygon == whose);
      CHECK(visit.z == at.z);
      CHECK(answers::outcome_text(run, history, visit) == "interpolated; no compare of it is recorded");
    }
    CHECK(told == 1);
  }
  CHECK(lost > 3);
  // A run without compares: what was written is told as before.
  const Trace run = test::changed(right, [](std::int64_t, const Event& event) { return !holds<DepthCompare>(event); });
  int written = 0, interpolated = 0;
  const Raster& raster = right.scene().raster;
  for (std::int32_t y = 0; y < raster.height; ++y)
    for (std::int32_t x = 0; x < raster.width; ++x)
      for (const Visit& visit : answers::pixel_history(run, {x, y}))
        (visit.outcome == Outcome::interpolated ? interpolated : written) += visit.outcome != Outcome::rejected;
  CHECK(interpolated == lost);
  CHECK(written > lost);
}

TEST_CASE("unrecorded: a sentence that contradicts the trace is told once") {
  const Trace right = open_jsonl(test::in_checkout("tests/golden/delhi.jsonl"));
  // The first colour is left out: its compare was won.
  const auto write = right.next<PixelWrite>(0, [](const PixelWrite&) { return true; });
  REQUIRE(write);
  const PixelWrite first = get<PixelWrite>(right.event(*write).event);
  const Trace run = test::changed(right, [&](std::int64_t step, const Event&) { return step != *write; });
  Replay replay(run);
  int contradicted = 0;
  for (Visit& visit : answers::pixel_history(run, {first.x, first.y})) {
    replay.go_to(visit.step);
    contradicted += explain(run, replay.state(), *replay.current()).doubt.has_value();
    answers::tell(replay, visit);
    for (const std::string& formula : visit.formulas) CHECK(formula != visit.sentence);
  }
  CHECK(contradicted == 1);
  // Nor does what the numbers of a verdict contradict stand there twice.
  const auto compare = right.next<DepthCompare>(0, [](const DepthCompare& e) { return e.nearer; });
  const Trace wrong = test::changed(right, [&](std::int64_t step, Event& event) {
    if (step == *compare) get_if<DepthCompare>(&event)->nearer = false;
    return true;
  });
  const DepthCompare at = get<DepthCompare>(wrong.event(*compare).event);
  std::vector<Visit> history = answers::pixel_history(wrong, {at.x, at.y});
  REQUIRE(!history.empty());
  Replay of_wrong(wrong);
  of_wrong.go_to(*compare);
  const Explanation said = explain(wrong, of_wrong.state(), *of_wrong.current());
  REQUIRE(said.doubt);
  CHECK(*said.doubt == said.sentence);
  CHECK(said.besides.empty());
  answers::tell(of_wrong, history.front());
  CHECK(history.front().sentence == said.sentence);
  CHECK(history.front().formulas == said.formulas);
}

}  // namespace
