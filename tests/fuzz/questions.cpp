#include "tests/fuzz/questions.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "sim/answers/explain_value.hpp"
#include "sim/answers/pixel_history.hpp"
#include "sim/answers/why_not.hpp"
#include "sim/words/explain.hpp"
#include "tests/fuzz/trace_mutator.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::fuzz {

namespace {

// A pixel of a large raster, or a step among many, is no other than one of few; it takes longer.
constexpr std::int64_t most_pixels = 1 << 14, most_steps = 20'000;

/// Wherever a replay gets to, it is the same state by every way there.
void replay_all_ways(const Trace& trace, Random& random) {
  Replay forwards(trace, {64, 16, 32, 128}), sought(trace);
  answered([&] { forwards.go_to(trace.size()); });
  const auto end = static_cast<std::size_t>(forwards.position());
  for (int left = 2; left > 0; --left) {
    const auto there = static_cast<std::int64_t>(pick(random, end + 1));
    forwards.go_to(there);
    sought.go_to(there);
    check(forwards.state() == sought.state());
    for (int back = 5; back > 0; --back) forwards.step_back();
  }
}

/// What is written can be read again, and is then the same.
void write_and_read(const Trace& trace) {
  std::ostringstream first, second;
  if (!answered([&] { write_jsonl(trace, first); })) return;
  const std::string text = first.str();
  write_jsonl(trace_of_lines(text), second);
  check(text == second.str());
}

void explain_step(const Trace& trace, std::int64_t step) {
  answered([&] {
    Replay replay(trace);
    replay.go_to(step);
    explain(trace, replay.state(), *replay.current());
  });
  answered([&] {
    answers::Question question;
    question.at = step;
    for (const answers::ChainLink& link : answers::explain_value(trace, question).links)
      for (const answers::ChainValue& value : link.values) answers::line_text(value), answers::doubt_text(value);
  });
}

void tell_history(const Trace& trace, Trace::Pixel pixel) {
  answered([&] {
    std::vector<answers::Visit> history = answers::pixel_history(trace, pixel);
    Replay replay(trace);
    for (std::size_t k = 0; k < std::min<std::size_t>(history.size(), 10); ++k) {
      answers::tell(replay, history[k]);
      answers::outcome_text(trace, history, history[k]);
    }
  });
}

}  // namespace

void ask_everything(const Trace& trace, unsigned choice) {
  Random random(choice);
  answered([&] { trace.each(0, trace.size(), [](std::int64_t, const RecordedEvent&) { return true; }); });
  const Scene& scene = trace.scene();
  const Raster& raster = scene.raster;
  if (std::int64_t{raster.width} * raster.height > most_pixels || trace.size() > most_steps) return;
  replay_all_ways(trace, random);
  const auto among = [&](auto count) {
    return static_cast<std::int32_t>(pick(random, static_cast<std::size_t>(count)));
  };
  const Trace::Pixel pixel{among(raster.width), among(raster.height)};
  const std::size_t polygons = scene.polygons.size();
  switch (pick(random, 6)) {
    case 0:
      return write_and_read(trace);
    case 1:
      if (trace.size() > 0) explain_step(trace, 1 + among(trace.size()));
      return;
    case 2:
      return tell_history(trace, pixel);
    case 3:
      answered([&] { answers::explain_value(trace, answers::of_pixel(trace.size(), pixel)); });
      return;
    case 4:
      if (polygons > 0) answered([&] { answers::why_not(trace, among(polygons), pixel); });
      return;
    default:
      if (polygons > 0) answered([&] { answers::why_not(trace, among(polygons)); });
  }
}

}  // namespace zstep::fuzz
