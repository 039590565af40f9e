// The same steps in another order, as right programs have it that print spans before their pixels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::test {

inline std::vector<RecordedEvent> steps_of(const Trace& trace) {
  std::vector<RecordedEvent> steps;
  for (std::int64_t step = 1; step <= trace.size(); ++step) steps.push_back(trace.event(step));
  return steps;
}
inline Trace with_steps(const Trace& trace, const std::vector<RecordedEvent>& steps) {
  TraceRecorder recorder(trace.header(), trace.scene());
  for (const RecordedEvent& step : steps) record_any(recorder, step.step, step.event);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "changed");
}

/// All pixels of each polygon, or scan line, come after all its spans; `change` may alter them.
template <class Of = PolygonBegin, class Change>
Trace pixels_last(const Trace& right, Change&& change) {
  std::vector<RecordedEvent> steps, pixels;
  const auto put = [&] { steps.insert(steps.end(), pixels.begin(), pixels.end()), pixels.clear(); };
  for (RecordedEvent step : steps_of(right)) {
    if (holds<Of>(step.event)) put();
    const bool is_of_pixel = visit_event(
        [&]<class E>(E& e) {
          if constexpr (requires { e.x, e.y; }) return change(e), true;
          return false;
        },
        step.event);
    (is_of_pixel ? pixels : steps).push_back(step);
  }
  put();
  return with_steps(right, steps);
}

/// All pixels come after all spans of all polygons, in the order of `before(one, other)` where it says one.
template <class Before>
Trace all_pixels_last(const Trace& right, Before&& before) {
  std::vector<RecordedEvent> steps;
  std::vector<std::pair<std::pair<std::int32_t, std::int32_t>, std::vector<RecordedEvent>>> pixels;
  for (const RecordedEvent& step : steps_of(right)) {
    const auto at = visit_event(
        [&]<class E>(const E& e) -> std::optional<std::pair<std::int32_t, std::int32_t>> {
          if constexpr (requires { e.x, e.y; }) return std::pair{e.y, e.x};
          return std::nullopt;
        },
        step.event);
    if (!at) {
      steps.push_back(step);
      continue;
    }
    if (holds<DepthInterpolate>(step.event)) pixels.push_back({*at, {}});
    pixels.back().second.push_back(step);
  }
  std::stable_sort(pixels.begin(), pixels.end(), before);
  for (const auto& [at, of_pixel] : pixels) steps.insert(steps.end(), of_pixel.begin(), of_pixel.end());
  return with_steps(right, steps);
}
inline constexpr auto as_they_are = [](const auto&, const auto&) { return false; };
inline constexpr auto by_picture = [](const auto& one, const auto& other) { return one.first < other.first; };

}  // namespace zstep::test
