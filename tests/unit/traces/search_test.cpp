// Trace::scan, next and previous pass over blocks that cannot hold a pixel, and over no others.
#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "tests/unit/traces/some_trace.hpp"
#include "traces/file/visit.hpp"

using namespace zstep;

TEST_CASE("search: a pixel is found in whichever block it was touched") {
  std::mt19937 random(5);
  std::vector<RecordedEvent> events;
  for (std::uint32_t i = 0; i < 3 * block_events; ++i) {
    const auto x = static_cast<std::int32_t>(random() % 16), y = static_cast<std::int32_t>(random() % 12);
    if (random() % 40 == 0) events.push_back({step_of(kind_of<PolygonBegin>), PolygonBegin{0, 0}});
    // Mostly one corner of the raster, so that boxes are small and few blocks hold the others.
    else if (random() % 2000 != 0) events.push_back({step_of(kind_of<PixelWrite>), PixelWrite{x % 3, y % 2, 1}});
    else events.push_back({step_of(kind_of<PixelWrite>), PixelWrite{x, y, 1}});
  }
  const Trace trace = record_events(events);
  REQUIRE(trace.impl().blocks.size() > 2);
  int passed_over = 0;
  for (std::int32_t y = 0; y < 12; ++y) {
    for (std::int32_t x = 0; x < 16; ++x) {
      std::vector<std::int64_t> wanted, found, backwards;
      for (std::size_t i = 0; i < events.size(); ++i) {
        const auto* write = get_if<PixelWrite>(&events[i].event);
        if (write != nullptr && write->x == x && write->y == y) wanted.push_back(static_cast<std::int64_t>(i) + 1);
      }
      trace.scan(Trace::Pixel{x, y},
                 [&](std::int64_t position, const RecordedEvent&) { return found.push_back(position), true; });
      REQUIRE(found == wanted);
      for (std::size_t block = 0; block < trace.impl().blocks.size(); ++block)
        passed_over += trace.impl().last_touch(block, {x, y}) == 0;
      if (x % 3 != 2) continue;
      const auto any = [](const RecordedEvent&) { return true; };
      for (auto at = trace.previous(trace.size() + 1, any, Trace::Pixel{x, y}); at;
           at = trace.previous(*at, any, Trace::Pixel{x, y}))
        backwards.insert(backwards.begin(), *at);
      REQUIRE(backwards == wanted);
    }
  }
  CHECK(passed_over > 0);
}

TEST_CASE("search: where a polygon is said to have no part in a pixel, nothing there is its own") {
  for (const bool keeps : {true, false}) {
    CAPTURE(keeps);
    std::mt19937 random(7);
    std::vector<RecordedEvent> events;
    std::int32_t at_work = 0;
    bool part[12][16][2] = {};
    for (std::uint32_t i = 0; i < 3 * block_events; ++i) {
      const auto x = static_cast<std::int32_t>(random() % 16), y = static_cast<std::int32_t>(random() % 12);
      if (random() % 20000 == 0) {
        at_work = 1 - at_work;
        events.push_back({step_of(kind_of<PolygonBegin>), PolygonBegin{at_work, at_work}});
        continue;
      }
      // The one is at work on the left, the other on the right; seldom it is the other that is named.
      const std::int32_t column = at_work == 0 ? x % 6 : 10 + x % 6;
      const std::int32_t named = !keeps && random() % 5000 == 0 ? 1 - at_work : at_work;
      events.push_back({step_of(kind_of<PixelWrite>), PixelWrite{column, y, named}});
      part[y][column][at_work] = part[y][column][named] = true;
    }
    const Trace trace = record_events(events);
    REQUIRE(trace.impl().blocks.size() > 2);
    int without = 0;
    for (std::int32_t y = 0; y < 12; ++y)
      for (std::int32_t x = 0; x < 16; ++x)
        for (const std::int32_t polygon : {0, 1}) {
          const bool may = trace.may_be_of(polygon, {x, y});
          if (part[y][x][polygon]) REQUIRE(may);
          without += !may;
        }
    CHECK((without > 192 / 2) == keeps);
  }
}
