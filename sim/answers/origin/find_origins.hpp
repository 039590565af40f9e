// Where in a trace the steps stand that a chain passes through. A search begins where its step must be near: at the
// polygon at work, at the line, at the beginning of the run; none goes through a whole trace where there is another
// way.
#pragma once

#include <cstdint>
#include <optional>

#include "traces/file/trace.hpp"
#include "traces/replay/state.hpp"

namespace zstep::answers {

using Step = std::optional<std::int64_t>;

/// The last step at or before `at`, or the first at or after it, whose event is an E for which `wanted(event)` holds.
/// With `stop` nothing is looked at beyond an event for which `stop(event)` holds; `least` is the first step that is
/// looked at.
template <class E, class Wanted, class Stop>
Step find_last(const Trace& trace, std::int64_t at, Wanted&& wanted, Stop&& stop, std::int64_t least = 1) {
  const auto is_wanted = [&](const Event& event) {
    const auto* known = get_if<E>(&event);
    return known && wanted(*known);
  };
  const auto found = trace.previous(
      at + 1, [&](const RecordedEvent& recorded) { return is_wanted(recorded.event) || stop(recorded.event); },
      Trace::Among({}, {}, least));
  return found && is_wanted(trace.event(*found).event) ? found : std::nullopt;
}
template <class E, class Wanted>
Step find_last(const Trace& trace, std::int64_t at, Wanted&& wanted) {
  return trace.previous<E>(at + 1, wanted);
}
template <class E, class Wanted>
Step find_first(const Trace& trace, std::int64_t at, Wanted&& wanted) {
  return trace.next<E>(at - 1, wanted);
}

/// The steps of one vertex, as far as the trace has them.
struct VertexSteps {
  Step made;  ///< by clipping or cutting; the scene's own points have none
  Step viewed, projected, on_raster;
};

/// As it stood at step `at`, in the pass that was at work then.
VertexSteps steps_of_vertex(const Trace& trace, const MethodState& machine, std::int64_t at, std::int32_t vertex);

/// Where the edge entered the edge table that is in use at `at`.
Step step_of_edge(const Trace& trace, const MethodState& machine, std::int64_t at, std::int32_t edge);
/// The step that gave the active edge the x it has at `at`: its edge_step, or its entry into the table.
Step step_of_active_edge(const Trace& trace, const MethodState& machine, std::int64_t at, std::int32_t edge);

/// Where the plane of a piece was found.
Step step_of_plane(const MethodState& machine, std::int32_t piece);

/// The last step at or before `at` that gave a pixel of the buffer in use then its depth. `light`: of the light's
/// picture.
Step step_of_depth(const Trace& trace, std::int64_t at, Trace::Pixel pixel, bool light);

/// The last step at or before `at` that shaded a pixel by its polygon's attribute.
Step step_of_shade(const Trace& trace, std::int64_t at, Trace::Pixel pixel);

/// Where work on the polygon or the piece at `at` began; 1 if nothing says so.
std::int64_t begin_of_work(const Trace& trace, const MethodState& machine, std::int64_t at);

}  // namespace zstep::answers
