// Every kind of event survives the block codec and JSONL to the bit, whatever numbers it holds.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "tests/unit/traces/some_trace.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/visit.hpp"

using namespace zstep;

namespace {

struct ByRun {
  std::int64_t events = 0, in_runs = 0;
  template <class E>
  bool operator()(std::int64_t, std::uint8_t, const E&) {
    return ++events, true;
  }
  bool operator()(std::int64_t before, const codec::Row& row) { return take(before, row.events()); }
  bool operator()(std::int64_t before, const codec::FragmentRun& run) { return take(before, run.events()); }
  bool operator()(std::int64_t before, const codec::PaintRun& run) { return take(before, run.events()); }
  bool take(std::int64_t before, std::uint32_t count) {
    CHECK(before == events);
    events += count, in_runs += count;
    return true;
  }
};

}  // namespace

TEST_CASE("codec: random events of every kind come back to the bit") {
  const auto events = random_events(200000, 7);
  const Trace trace = record_events(events);
  REQUIRE(trace.size() == static_cast<std::int64_t>(events.size()));
  std::size_t i = 0;
  bool same = true;
  trace.each(0, trace.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
    same = same && position == static_cast<std::int64_t>(i + 1) && recorded.step == events[i].step &&
           same_bits(recorded.event, events[i].event);
    ++i;
    return same;
  });
  CHECK(same);
  CHECK(i == events.size());
}

TEST_CASE("codec: one event at a time equals a visit, in any order") {
  const auto events = random_events(150000, 11);
  const Trace trace = record_events(events);
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const auto position = static_cast<std::int64_t>(random() % events.size()) + 1;
    const RecordedEvent& event = trace.event(position);
    REQUIRE(same_bits(event.event, events[static_cast<std::size_t>(position - 1)].event));
  }
}

TEST_CASE("codec: next and previous find what a plain loop finds, with and without the pixel index") {
  const auto events = random_events(140000, 5);
  const Trace trace = record_events(events);
  const auto failed = [](const RecordedEvent& e) {
    return holds<DepthCompare>(e.event) && !get<DepthCompare>(e.event).nearer;
  };
  const auto touches = [](const RecordedEvent& e) {
    const auto pixel = pixel_of(e.event);
    return pixel && pixel->x == 5 && pixel->y == 6;
  };
  std::mt19937 random(4);
  for (int i = 0; i < 50; ++i) {
    const auto from = static_cast<std::int64_t>(random() % (events.size() + 1));
    const auto expect = [&](const auto& predicate, int direction) -> std::optional<std::int64_t> {
      for (std::int64_t p = from + direction; p >= 1 && p <= trace.size(); p += direction) {
        if (predicate(events[static_cast<std::size_t>(p - 1)])) return p;
      }
      return std::nullopt;
    };
    CHECK(trace.next(from, failed) == expect(failed, 1));
    CHECK(trace.previous(from, failed) == expect(failed, -1));
    CHECK(trace.next(from, touches, Trace::Pixel{5, 6}) == expect(touches, 1));
    CHECK(trace.previous(from, touches, Trace::Pixel{5, 6}) == expect(touches, -1));
  }
}

TEST_CASE("codec: a span's pixels cost less than half a byte each") {
  std::vector<RecordedEvent> events;
  const std::uint8_t span = step_of(kind_of<SpanBegin>), interpolate = step_of(kind_of<DepthInterpolate>),
                     compare = step_of(kind_of<DepthCompare>);
  for (int y = 0; y < 64; ++y) {
    const double x_left = 0.25 * y, x_right = 63 - 0.125 * y, z_left = 1 + y * 0.01, z_right = 2 - y * 0.003;
    const SpanBegin s{0,
                      1,
                      y,
                      static_cast<std::int32_t>(std::ceil(x_left)),
                      static_cast<std::int32_t>(std::ceil(x_right)) - 1,
                      x_left,
                      z_left,
                      x_right,
                      z_right,
                      (z_right - z_left) / (x_right - x_left)};
    events.push_back({span, s});
    for (int x = s.first; x <= s.last; ++x) {
      const double z = z_left + (z_right - z_left) * (x - x_left) / (x_right - x_left);
      events.push_back({interpolate, DepthInterpolate{x, y, z}});
      events.push_back({compare, DepthCompare{x, y, z, true}});
    }
  }
  const auto bytes = recorded_bytes(events);
  const Trace empty = record_events({});
  const double per_event =
      static_cast<double>(bytes.size() - recorded_bytes({}).size()) / static_cast<double>(events.size());
  CHECK(per_event < 0.5);
}

TEST_CASE("codec: runs of pixels come back to the bit, whatever breaks them") {
  // Spans as scan conversion makes them, with some events left out, told twice, or with another number in them.
  for (const bool increments : {false, true}) {
    std::mt19937 random(increments ? 8 : 9);
    Header header = some_header();
    if (increments) header.conventions.interpolation = Conventions::Interpolation::increments;
    const Scene scene = some_scene();
    std::vector<RecordedEvent> events;
    const auto add = [&]<class E>(const E& event) { events.push_back({step_of(kind_of<E>), event}); };
    while (events.size() < 150000) {
      const auto y = static_cast<std::int32_t>(random() % 12), first = static_cast<std::int32_t>(random() % 8);
      const std::int32_t last = first + static_cast<std::int32_t>(random() % 8);
      const auto polygon = static_cast<std::int32_t>(random() % 2);
      const SpanBegin span{
          0, 1, y, first, last, first - 0.25, 1.5, last + 0.5, 1.5 + static_cast<double>(random() % 100) / 7, 0.125};
      const int odd = static_cast<int>(random() % 6);  // what is odd about this span
      if (random() % 3 == 0) add(PolygonBegin{polygon, polygon});
      add(span);
      double z = 0;
      for (std::int32_t x = first; x <= last; ++x) {
        z = codec::depth_along(span, increments, x, z);
        if (odd == 0 && random() % 4 == 0) z = random() % 2 == 0 ? -0.0 : std::nextafter(z, 9.0);
        if (odd == 1 && random() % 4 == 0) z = std::numeric_limits<double>::quiet_NaN();
        const bool nearer = random() % 3 == 0, leave_out = odd == 2 && random() % 5 == 0;
        if (odd == 5) {
          add(PixelPaint{x, y, z, random() % 9 == 0 ? 1 - polygon : polygon});
          continue;
        }
        add(DepthInterpolate{x, y, z});
        if (!leave_out) add(DepthCompare{x, odd == 3 && random() % 5 == 0 ? (y + 1) % 12 : y, z, nearer});
        if (!nearer) continue;
        add(DepthWrite{x, y, odd == 4 && random() % 5 == 0 ? 0.0 : z});
        if (!leave_out) add(PixelWrite{x, y, odd == 4 && random() % 5 == 0 ? 1 - polygon : polygon});
      }
    }
    TraceRecorder recorder(header, scene);
    for (const RecordedEvent& event : events) record_any(recorder, event.step, event.event);
    recorder.finish();
    const Trace trace = Trace::from_bytes(recorder.take_bytes(), "runs");
    REQUIRE(trace.size() == static_cast<std::int64_t>(events.size()));
    std::size_t i = 0, different = 0;
    trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
      different += recorded.step != events[i].step || !same_bits(recorded.event, events[i].event) ? 1u : 0u;
      ++i;
      return true;
    });
    CHECK(different == 0);

    // Seen by the run it is the same, and most pixels are in runs.
    ByRun by_run;
    trace.visit(0, trace.size(), by_run);
    CHECK(by_run.events == trace.size());
    CHECK(by_run.in_runs > trace.size() / 3);
  }
}

TEST_CASE("a block is gone through to its end while more others are asked for than are kept at hand") {
  const auto events = random_events(200'000, 29);
  const Trace trace = record_events(events);
  REQUIRE(trace.impl().blocks.size() > 12);
  std::size_t different = 0;
  trace.visit(0, trace.size(), [&](std::int64_t position, std::uint8_t step, const auto& event) {
    const RecordedEvent& expected = events[static_cast<std::size_t>(position - 1)];
    different += step != expected.step || !same_bits(Event(event), expected.event) ? 1u : 0u;
    if (position % 5000 == 0)
      for (const auto& block : trace.impl().blocks) trace.event(block.info.first_position + 1);
    return true;
  });
  CHECK(different == 0);
}

TEST_CASE("jsonl: out and in again loses nothing") {
  const auto events = random_events(3000, 23);
  const Trace trace = record_events(events);
  std::stringstream text;
  write_jsonl(trace, text);
  Scene kept;
  std::unique_ptr<TraceRecorder> recorder;
  read_jsonl(text, "text", [&](const Header& header, Scene scene) -> TraceRecorder& {
    CHECK(header == trace.header());
    CHECK(scene == trace.scene());
    kept = std::move(scene);
    recorder = std::make_unique<TraceRecorder>(header, kept);
    return *recorder;
  });
  recorder->finish();
  CHECK(recorder->take_bytes() == recorded_bytes(events));
}
