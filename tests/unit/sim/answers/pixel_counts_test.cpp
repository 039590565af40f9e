// What is counted for each pixel, against looking at every event, and against the pixels' histories.
#include <doctest/doctest.h>

#include <map>
#include <set>
#include <vector>

#include "sim/answers/pixel_counts.hpp"
#include "sim/answers/pixel_history.hpp"
#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using answers::Count, answers::PixelCounts;

namespace {

using Table = std::vector<std::int32_t>;

/// The same in the plainest way: the replay says which polygon is at work, and sets which were there.
std::map<Count, Table> by_hand(const Trace& trace, std::int64_t position) {
  const Raster& raster = trace.scene().raster;
  const std::size_t pixels = static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height);
  std::map<Count, Table> all;
  for (const Count count : {Count::writes, Count::failed, Count::work, Count::covers}) all[count].assign(pixels, 0);
  all[Count::first].assign(pixels, no_polygon), all[Count::last].assign(pixels, no_polygon);
  std::vector<std::set<std::int32_t>> there(pixels);
  Replay replay(trace);
  std::optional<std::size_t> ray;
  for (std::int64_t step = 1; step <= position; ++step) {
    replay.go_to(step);
    const MethodState& machine = replay.state().machine;
    if (machine.pass == Pass::light) continue;
    const Event& event = trace.event(step).event;
    const auto at = pixel_of(event);
    if (const auto* hit = get_if<RayHit>(&event); hit && ray && hit->inside)
      there[*ray].insert(trace.scene().facets[static_cast<std::size_t>(hit->facet)].polygon);
    if (!at) continue;
    const std::size_t pixel =
        static_cast<std::size_t>(at->y) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(at->x);
    ++all[Count::work][pixel];
    if (const auto* begin = get_if<RayBegin>(&event))
      ray = begin->role == RayRole::eye ? std::optional(pixel) : std::nullopt;
    std::optional<std::int32_t> colour;
    if (const auto* compare = get_if<DepthCompare>(&event)) {
      all[Count::failed][pixel] += !compare->nearer;
      there[pixel].insert(machine.span ? machine.edge_table[static_cast<std::size_t>(machine.span->left_edge)].polygon
                                       : machine.polygon);
    }
    if (const auto* write = get_if<PixelWrite>(&event)) colour = write->polygon;
    if (const auto* paint = get_if<PixelPaint>(&event)) colour = paint->polygon;
    if (const auto* blend = get_if<ColorBlend>(&event)) colour = blend->polygon;
    all[Count::writes][pixel] += colour.has_value() || holds<ColorWrite>(event);
    if (!colour || *colour == no_polygon) continue;
    if (!trace.header().algorithm.starts_with("ray-")) there[pixel].insert(*colour);
    all[Count::last][pixel] = *colour;
    if (all[Count::first][pixel] == no_polygon) all[Count::first][pixel] = *colour;
  }
  for (std::size_t i = 0; i < pixels; ++i)
    there[i].erase(no_polygon), all[Count::covers][i] = static_cast<std::int32_t>(there[i].size());
  return all;
}

void check_same(const PixelCounts& counts, const std::map<Count, Table>& expected) {
  for (const auto& entry : expected)
    CHECK_MESSAGE(counts.of(entry.first) == entry.second, answers::count_names[static_cast<std::size_t>(entry.first)]);
}

}  // namespace

TEST_SUITE("pixel counts") {
  TEST_CASE("of every golden trace: what looking at every event counts, forwards and back again") {
    std::array<std::int64_t, answers::count_kinds> most{};
    test::for_each_golden([&](const std::string& name, const Trace& trace) {
      CAPTURE(name);
      PixelCounts counts(trace);
      const auto half = by_hand(trace, trace.size() / 2), whole = by_hand(trace, trace.size());
      counts.count_to(trace.size() / 2);
      check_same(counts, half);
      counts.count_to(trace.size() + 7);
      CHECK(counts.position() == trace.size());
      check_same(counts, whole);
      counts.count_to(trace.size() / 2);
      check_same(counts, half);
      for (const auto& [count, table] : whole)
        for (const std::int32_t value : table)
          most[static_cast<std::size_t>(count)] = std::max<std::int64_t>(most[static_cast<std::size_t>(count)], value);
    });
    for (const std::int64_t value : most) CHECK(value > 1);
  }

  TEST_CASE("at the end they are what the pixels' histories tell") {
    const Trace trace = open_jsonl(test::in_checkout("tests/golden/pyramid-behind.jsonl"));
    PixelCounts counts(trace);
    counts.count_to(trace.size());
    Replay replay(trace);
    replay.go_to(trace.size());
    const Picture& picture = replay.state().picture;
    CHECK(counts.of(Count::last) == picture.polygon);
    for (std::int32_t y = 0; y < picture.height; ++y)
      for (std::int32_t x = 0; x < picture.width; ++x) {
        std::int32_t writes = 0, failed = 0, first = no_polygon;
        std::set<std::int32_t> there;
        for (const answers::Visit& visit : answers::pixel_history(trace, {x, y})) {
          if (visit.outcome == answers::Outcome::rejected) continue;
          there.insert(visit.polygon);
          writes += visit.takes, failed += !visit.takes;
          if (visit.takes && first == no_polygon) first = visit.polygon;
        }
        const std::size_t at = picture.at(x, y);
        CHECK(counts.of(Count::writes)[at] == writes);
        CHECK(counts.of(Count::failed)[at] == failed);
        CHECK(counts.of(Count::first)[at] == first);
        CHECK(counts.of(Count::covers)[at] == static_cast<std::int32_t>(there.size()));
      }
  }
}
