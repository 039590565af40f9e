// What must hold for every trace, tried on all golden ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/golden/golden.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

/// No ink at all is ink on no pixel.
bool same_ink(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  const auto blank = [](const std::vector<std::uint32_t>& ink) {
    return std::count(ink.begin(), ink.end(), no_ink) == std::ssize(ink);
  };
  return a == b || (blank(a) && blank(b));
}

/// Equal to the last bit, signs of zeros too.
bool same_bits(const Picture& a, const Picture& b) {
  return a.width == b.width && a.height == b.height && a.polygon == b.polygon && same_ink(a.ink, b.ink) &&
         a.depth.size() == b.depth.size() &&
         std::memcmp(a.depth.data(), b.depth.data(), a.depth.size() * sizeof(double)) == 0;
}

/// Marks so close together that a trace of a few hundred steps crosses undo windows, check-points and key frames.
constexpr ReplayTuning close_marks{40, 8, 24, 100};
/// No marks at all, so that nothing divides a run of pixels.
constexpr ReplayTuning whole_runs{0, 1 << 20, 0, 1 << 20};

/// The state at every position, reached by going forwards from the beginning.
std::vector<State> states_of(const Trace& trace) {
  std::vector<State> states;
  Replay replay(trace);
  for (std::int64_t position = 0; position <= trace.size(); ++position) {
    replay.go_to(position);
    REQUIRE(replay.position() == position);
    states.push_back(replay.state());
  }
  return states;
}

}  // namespace

TEST_CASE("law: at every step the state is the same, reached forwards, backwards or by seek") {
  for_each_golden([](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    const std::vector<State> forwards = states_of(trace);
    const auto at = [&](std::int64_t position) -> const State& { return forwards[static_cast<std::size_t>(position)]; };

    Replay backwards(trace, close_marks);
    backwards.go_to(trace.size());
    for (std::int64_t position = trace.size(); position >= 0; --position) {
      if (!(backwards.state() == at(position))) FAIL("backwards differs at step ", position);
      backwards.step_back();
    }

    // Every position once, from far away each time: a stride that has no divisor in common with their number.
    const std::int64_t count = trace.size() + 1;
    std::int64_t stride = count / 3 * 2 + 1;
    const auto gcd = [](std::int64_t a, std::int64_t b) {
      while (b != 0) std::swap(a %= b, b);
      return a;
    };
    while (gcd(stride, count) != 1) ++stride;
    Replay seeking(trace, close_marks);
    for (std::int64_t k = 0, position = 0; k < count; ++k, position = (position + stride) % count) {
      seeking.go_to(position);
      if (!(seeking.state() == at(position))) FAIL("seek differs at step ", position);
    }
    for (std::int64_t position = 0; position < count; position += 97) {
      Replay fresh(trace, close_marks);
      fresh.go_to(position);
      if (!(fresh.state() == at(position))) FAIL("a fresh seek differs at step ", position);
      Replay by_run(trace, whole_runs);
      by_run.go_to(position);
      if (!(by_run.state() == at(position))) FAIL("a seek by runs differs at step ", position);
    }
  });
}

TEST_CASE("law: a step forward and a step back lead to where one was") {
  for_each_golden([](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      const State before = replay.state();
      replay.step_forward();
      replay.step_back();
      if (!(replay.state() == before)) FAIL("there and back differs at step ", before.position);
      replay.step_forward();
    }
  });
}

TEST_CASE("law: a trace replayed to its end holds the picture that render gives, and recording changes no bit of it") {
  for_each_golden([](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    const Method& m = method(trace.header().algorithm);
    const Conventions& conventions = trace.header().conventions;
    NullRecorder nothing;
    CountRecorder counts;
    TraceRecorder recorder(trace.header(), trace.scene());
    const Picture plain = m.render(trace.scene(), conventions, nothing);
    const Picture counted = m.count(trace.scene(), conventions, counts);
    const Picture recorded = m.record(trace.scene(), conventions, recorder);
    CHECK(same_bits(plain, counted));
    CHECK(same_bits(plain, recorded));

    Replay replay(trace);
    replay.go_to(trace.size());
    CHECK(same_bits(plain, replay.state().picture));

    std::vector<std::int64_t> in_trace(step_limit, 0);
    for (std::int64_t position = 1; position <= trace.size(); ++position) ++in_trace[trace.event(position).step];
    CHECK(std::vector<std::int64_t>(counts.count.begin(), counts.count.end()) == in_trace);
  });
}

TEST_CASE("law: JSON Lines to a trace to JSON Lines loses nothing") {
  for_each_golden([](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    const std::string first = jsonl_of(trace);
    std::istringstream in(first);
    Scene kept;
    std::unique_ptr<TraceRecorder> recorder;
    read_jsonl(in, name, [&](const Header& header, Scene scene) -> TraceRecorder& {
      kept = std::move(scene);
      recorder = std::make_unique<TraceRecorder>(header, kept);
      return *recorder;
    });
    recorder->finish();
    const Trace again = Trace::from_bytes(recorder->take_bytes(), name);
    CHECK(again.header() == trace.header());
    CHECK(again.scene() == trace.scene());
    CHECK(jsonl_of(again) == first);
  });
}

TEST_CASE("law: next and previous by unit meet, and every position is between them") {
  for_each_golden([](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    for (const Unit unit : {Unit::event, Unit::pixel, Unit::span, Unit::scan_line, Unit::polygon}) {
      std::vector<std::int64_t> there{0}, back{trace.size()};
      while (there.back() < trace.size()) there.push_back(next_unit(trace, there.back(), unit));
      while (back.back() > 0) back.push_back(previous_unit(trace, back.back(), unit));
      for (std::size_t k = 1; k < there.size(); ++k) REQUIRE(there[k] > there[k - 1]);
      const std::vector<std::int64_t> reversed(back.rbegin(), back.rend());
      CHECK(there == reversed);
    }
  });
}

TEST_CASE("law: while pieces enter a list no polygon is at work, and what was of the last one is gone") {
  std::int64_t inserts = 0;
  for_each_golden([&](const std::string& name, const Trace& trace) {
    if (!trace.has(kind_of<ListInsert>)) return;
    CAPTURE(name);
    const std::vector<State> states = states_of(trace);
    for (std::int64_t position = 1; position <= trace.size(); ++position) {
      if (!holds<ListInsert>(trace.event(position).event)) continue;
      CAPTURE(position);
      ++inserts;
      const MethodState& machine = states[static_cast<std::size_t>(position)].machine;
      CHECK(machine.polygon == no_polygon);
      CHECK(machine.outline.empty());
    }
  });
  CHECK(inserts > 0);
}
