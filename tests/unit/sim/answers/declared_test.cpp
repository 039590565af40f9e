// Sentences are made by the comparison that a header declares, and state nothing as a fact that it leaves undeclared.
#include <doctest/doctest.h>

#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "sim/answers/pixel_history.hpp"
#include "sim/answers/why_not.hpp"
#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/where.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// A Z-buffer with A at z = 5 and B at z = 1 + x + y, where the greater depth wins, under these conventions.
Trace with_conventions(const std::string& conventions) {
  std::stringstream text;
  text << std::ifstream(test::in_checkout("tests/data/foreign/greater.jsonl")).rdbuf();
  std::string all = text.str();
  const std::string declared = R"({"nearer": "greater"})";
  const std::size_t at = all.find(declared);
  REQUIRE(at != std::string::npos);
  std::istringstream in(all.replace(at, declared.size(), conventions));
  Scene kept;
  std::optional<TraceRecorder> recorder;
  read_jsonl(in, "greater.jsonl", [&](const Header& header, Scene scene) -> TraceRecorder& {
    kept = std::move(scene);
    return recorder.emplace(header, kept);
  });
  recorder->finish();
  return Trace::from_bytes(recorder->take_bytes(), "greater.jsonl");
}

/// What is said of each compare at a pixel.
std::vector<Explanation> compares(const Trace& trace, std::int32_t x, std::int32_t y) {
  std::vector<Explanation> all;
  Replay replay(trace);
  trace.each(0, trace.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
    const auto* compare = get_if<DepthCompare>(&recorded.event);
    if (!compare || compare->x != x || compare->y != y) return true;
    const RecordedEvent event = recorded;
    replay.go_to(step);
    all.push_back(explain(trace, replay.state(), event));
    return true;
  });
  REQUIRE(all.size() == 2);
  return all;
}

answers::Verdict why_not(const Trace& trace, const char* polygon, std::int32_t x, std::int32_t y) {
  return answers::why_not(trace, *answers::polygon_called(trace.scene(), polygon), {x, y});
}

/// The same steps under another header.
template <class Change>
Trace under(const Trace& trace, Change&& change) {
  Header header = trace.header();
  change(header);
  TraceRecorder recorder(header, trace.scene());
  for (std::int64_t step = 1; step <= trace.size(); ++step)
    record_any(recorder, trace.event(step).step, trace.event(step).event);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "under");
}
void leaves_open(Header& header, Convention which) {
  header.undeclared = static_cast<std::uint8_t>(header.undeclared | 1u << static_cast<unsigned>(which));
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("declared: where the greater depth wins, every sentence goes by that") {
  const Trace trace = with_conventions(R"({"nearer": "greater"})");
  const std::vector<Explanation> lost = compares(trace, 1, 1), won = compares(trace, 3, 2);
  CHECK(has(lost[0].sentence,
            "5 > 0: the depth buffer was cleared to that, and nothing was drawn here yet, so pixel (1, 1) becomes A."));
  CHECK(has(lost[1].sentence, "3 < 5: B is hidden behind A at pixel (1, 1), nothing is written."));
  CHECK(has(won[1].sentence, "6 > 5: nearer than A, so pixel (3, 2) becomes B."));
  CHECK(lost[1].formulas.front() == "z > zbuffer[x,y]:  3 > 5  is false");
  for (const auto& all : {lost, won})
    for (const Explanation& each : all) CHECK(!each.doubt);

  const auto history = answers::pixel_history(trace, {1, 1});
  REQUIRE(history.size() == 2);
  CHECK(answers::outcome_text(trace, history, history[0]) == "nearer");
  CHECK(answers::outcome_text(trace, history, history[1]) == "behind by 2");

  const answers::Verdict behind = why_not(trace, "B", 1, 1), gone = why_not(trace, "A", 3, 2);
  CHECK(has(behind.sentence, "it lost the compare to A by \u0394z = 2"));
  CHECK(behind.gap == 2);
  CHECK(has(gone.sentence, "until B was found to be nearer at step"));
  CHECK(!has(gone.sentence, "the trace says"));
  CHECK(gone.gap == 1);
  CHECK(gone.formulas.back() == "\u0394z = z of B \u2212 z of A = 6 \u2212 5 = 1");
}

TEST_CASE("declared: what a header leaves open is no fact that its compares break") {
  const Trace trace = with_conventions("{}");
  const Explanation first = compares(trace, 1, 1)[0];
  CHECK(first.sentence ==
        "The trace says nearer at pixel (1, 1), although 5 < 0 is false; its header does not declare which depth is "
        "nearer.");
  CHECK(first.doubt == first.sentence);
  const auto history = answers::pixel_history(trace, {1, 1});
  CHECK(has(answers::outcome_text(trace, history, history[0]),
            "the trace says nearer, but 5 < 0 is false (its header does not declare which depth is nearer)"));
  // By what it declares they do.
  const Explanation broken = compares(with_conventions(R"({"nearer": "smaller"})"), 1, 1)[0];
  CHECK(has(broken.sentence, "although 5 < 0 is false: A should not win over"));
}

TEST_CASE("declared: of equal depths the last wins where it says so") {
  // B is at z = 5 where x + y = 4, and is drawn last, so it should win there; the trace lets A stay.
  const Explanation tie = compares(with_conventions(R"({"nearer": "greater", "ties": "last"})"), 2, 2)[1];
  CHECK(has(tie.sentence,
            "The trace says not nearer at pixel (2, 2), although 5 \u2265 5 is true: B should win over A."));
  const Explanation stays = compares(with_conventions(R"({"nearer": "greater", "ties": "first"})"), 2, 2)[1];
  CHECK(stays.sentence == "5 = 5: a tie, and A was first, so pixel (2, 2) stays.");
  CHECK(!stays.doubt);
}

TEST_CASE("declared: a number of float32 is held to the digits of float32") {
  const Trace trace = open_jsonl(test::in_checkout("tests/data/foreign/f32.jsonl"));
  Replay replay(trace);
  int doubts = 0;
  trace.each(0, trace.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
    const RecordedEvent event = recorded;
    replay.go_to(step);
    const Explanation said = explain(trace, replay.state(), event);
    CAPTURE(said.sentence);
    CHECK(said.doubt.value_or("") == "");
    doubts += said.doubt ? 1 : 0;
    return doubts < 3;
  });
}

TEST_CASE("declared: the half-open rule is cited only where the header declares it") {
  // An edge from y = 3.5 to y = 4 meets no scan line but the one on which it ends.
  const Scene scene = test::screen_scene(8, 8, {{{1, 3.5, 2}, {6, 1, 2}, {6, 7, 2}, {2, 4, 2}}});
  const Trace trace = test::recorded_by("z-buffer", scene);
  const auto skipped = trace.next<EdgeTableSkip>(0, [](const EdgeTableSkip&) { return true; });
  REQUIRE(skipped);
  const auto told = [&](const Trace& of) {
    Replay replay(of);
    replay.go_to(*skipped);
    return explain(of, replay.state(), *replay.current()).sentence;
  };
  CHECK(has(told(trace), "ends on scan line 4, where by the half-open rule it is no longer met"));
  CHECK(has(told(under(trace, [](Header& header) { leaves_open(header, Convention::coverage); })),
            "ends on scan line 4, where it is no longer met"));
  CHECK(has(told(under(trace, [](Header& h) { h.conventions.coverage = Conventions::Coverage::inclusive; })),
            "ends on scan line 4, where it is no longer met"));
  // And of a pixel on the last edge of a polygon.
  const Trace square =
      test::recorded_by("z-buffer", test::screen_scene(6, 6, {{{1, -1, 2}, {4, -1, 2}, {4, 7, 2}, {1, 7, 2}}}));
  CHECK(has(answers::why_not(square, 0, {4, 3}).sentence, "by the half-open rule such a centre is outside"));
  const Trace open = under(square, [](Header& header) { leaves_open(header, Convention::coverage); });
  CHECK(has(answers::why_not(open, 0, {4, 3}).sentence, "the header does not declare which such centres are covered"));
}

TEST_CASE("declared: of two that are equally near the first in the file is named only where ties go so") {
  const std::vector<glm::dvec3> square{{1, 1, 3}, {5, 1, 3}, {5, 5, 3}, {1, 5, 3}};
  // As near as the square in column 2 alone.
  const std::vector<glm::dvec3> slanting{{1, 1, 2}, {5, 1, 6}, {5, 5, 6}, {1, 5, 2}};
  for (const std::string by : {"scan-line", "warnock"}) {
    CAPTURE(by);
    const Trace trace = test::recorded_by(by, test::screen_scene(8, 8, {square, by == "warnock" ? slanting : square}));
    CHECK(has(answers::why_not(trace, 1, {2, 2}).sentence, "comes first in the file"));
    const Trace last = under(trace, [](Header&header) { header.comparison.ties = Comparison::Ties::last; }),
                open = under(trace, [](Header&header) { leaves_open(header, Convention::ties); });
    for (const Trace* other : {&last, &open}) {
      const std::string told = answers::why_not(*other, 1, {2, 2}).sentence;
      CAPTURE(told);
      CHECK(!has(told, "in the file"));
      CHECK(has(told, "is painted"));
    }
  }
}
