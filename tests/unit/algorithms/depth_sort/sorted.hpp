// A run of depth sort with its record, held against the Z-buffer.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "algorithms/depth_sort/depth_sort.hpp"
#include "tests/unit/algorithms/depth_sort/scenes.hpp"
#include "traces/record/recorder.hpp"

namespace zstep::test {

struct Sorted {
  CollectRecorder record;
  Picture picture;
  int wrong = 0;

  int count(std::uint8_t id) const {
    return static_cast<int>(std::count_if(record.events.begin(), record.events.end(),
                                          [&](const CollectedEvent& event) { return event.step == id; }));
  }
  template <class E>
  E only(Step<E> of) const {
    REQUIRE(count(of.id) == 1);
    const auto found = std::find_if(record.events.begin(), record.events.end(),
                                    [&](const CollectedEvent& event) { return event.step == of.id; });
    return get<E>(found->event);
  }
  std::vector<std::int32_t> order() const {
    std::vector<std::int32_t> polygons;
    for (const PieceDraw& draw : record.all<PieceDraw>()) polygons.push_back(draw.polygon);
    return polygons;
  }
};

inline Sorted sort(const Scene& scene, bool cull = false) {
  Sorted sorted;
  Conventions conventions;
  conventions.cull = cull;
  sorted.picture = depth_sort::run(scene, conventions, sorted.record);
  sorted.wrong = wrong_pixels(scene, conventions, sorted.picture);
  return sorted;
}

inline Sorted sort_pair(const Ring& a, const Ring& b) { return sort(screen_scene(16, 16, {a, b})); }

using Order = std::vector<std::int32_t>;

}  // namespace zstep::test
