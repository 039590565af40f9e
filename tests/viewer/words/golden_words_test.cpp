// The law of words: each event of each method has a sentence, a formula, and no doubt about an honest run.
#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "traces/events/fields.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

TEST_CASE("law: every event of every golden trace is told, and its formula gives the recorded number") {
  std::set<std::size_t> kinds;
  std::size_t given = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Explanation told = explain(trace, replay.state(), *replay.current());
      const auto position = replay.position();
      CAPTURE(position);
      CAPTURE(told.sentence);
      REQUIRE_FALSE(told.sentence.empty());
      REQUIRE(told.sentence.back() == '.');
      REQUIRE_MESSAGE(!told.doubt, told.doubt.value_or(""), "; ", told.formulas.empty() ? "" : told.formulas.front());
      const auto fields = fields_of_kind(replay.current()->event.index());
      REQUIRE(told.given.size() == told.formulas.size());
      for (const std::string& field : told.given) {
        given += !field.empty();
        REQUIRE_MESSAGE((field.empty() || std::any_of(fields.begin(), fields.end(),
                                                      [&](const FieldOfKind& one) { return one.name == field; })),
                        field);
      }
      kinds.insert(replay.current()->event.index());
    }
  });
  CHECK(given > 1000);
  CHECK_MESSAGE(kinds.size() == kind_count, "some kind of event is recorded by no golden trace");
}
