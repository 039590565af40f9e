// Searches in a trace that look at no more of it than they must.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "traces/file/header.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/event_log.hpp"
#include "traces/replay/state.hpp"

namespace zstep::answers {

template <class... E>
bool is_one_of(const RecordedEvent& recorded) {
  return (holds<E>(recorded.event) || ...);
}
/// The kind, if one alone is wanted: then only blocks that hold it are read.
template <class E, class... More>
constexpr std::optional<std::uint8_t> only_kind() {
  return sizeof...(More) == 0 ? std::optional<std::uint8_t>(kind_of<E>) : std::nullopt;
}
template <class... E>
std::optional<std::int64_t> next_of(const Trace& trace, std::int64_t from, std::int64_t end) {
  return trace.next(from, is_one_of<E...>, Trace::Among({}, only_kind<E...>(), end - 1));
}

/// The event at a step, if it is of this kind. A copy: the trace's own goes away when others are read.
template <class E>
std::optional<E> event_at(const Trace& trace, std::int64_t step) {
  if (step < 1 || step > trace.size()) return std::nullopt;
  const auto* event = get_if<E>(&trace.event(step).event);
  return event ? std::optional<E>(*event) : std::nullopt;
}

/// Can the run have recorded events of this kind?
template <class E>
bool records(const Trace& trace) {
  return zstep::records<E>(trace.header());
}

/// The entry of this number; nullptr where there is none.
template <class All>
auto entry(const All& all, std::int32_t number) -> decltype(&all[0]) {
  const std::size_t at = number;
  return number >= 0 && at < all.size() ? &all[at] : nullptr;
}
/// The polygon that a facet is of; none where there is no such facet.
std::int32_t polygon_of_facet(const Scene& scene, std::int32_t facet);

/// A step and its event.
template <class E>
struct Found {
  std::int64_t step = 0;
  E event{};
};
/// The first step in (from, end) whose event E is meant.
template <class E, class Meant>
std::optional<Found<E>> next_that(const Trace& trace, std::int64_t from, std::int64_t end, const Meant& is_meant) {
  Found<E> found;
  const auto step = trace.next(
      from,
      [&](const RecordedEvent& recorded) {
        const E& event = get<E>(recorded.event);
        if (!is_meant(event)) return false;
        found.event = event;
        return true;
      },
      Trace::Among({}, kind_of<E>, end - 1));
  if (!step) return std::nullopt;
  found.step = *step;
  return found;
}
template <class E>
std::optional<Found<E>> next_event(const Trace& trace, std::int64_t from, std::int64_t end) {
  return next_that<E>(trace, from, end, [](const E&) { return true; });
}
/// All of them.
template <class E, class Meant>
std::vector<Found<E>> all_that(const Trace& trace, std::int64_t from, std::int64_t end, const Meant& is_meant) {
  std::vector<Found<E>> all;
  while (const auto found = next_that<E>(trace, all.empty() ? from : all.back().step, end, is_meant))
    all.push_back(*found);
  return all;
}
/// The first, unless a step of one of the other kinds comes before it.
template <class E, class... Stop, class Meant>
std::optional<Found<E>> next_before(const Trace& trace, std::int64_t from, std::int64_t end, const Meant& is_meant) {
  const auto step = trace.next(
      from,
      [&](const RecordedEvent& recorded) {
        const auto* event = get_if<E>(&recorded.event);
        return (event && is_meant(*event)) || is_one_of<Stop...>(recorded);
      },
      Trace::Among({}, {}, end - 1));
  const auto event = step ? event_at<E>(trace, *step) : std::nullopt;
  return event && is_meant(*event) ? std::optional(Found<E>{*step, *event}) : std::nullopt;
}

/// The last step in (end, from), the way back, whose event E is meant.
template <class E, class Meant>
std::optional<Found<E>> last_that(const Trace& trace, std::int64_t from, std::int64_t end, const Meant& is_meant) {
  const auto step = trace.previous(
      from, [&](const RecordedEvent& recorded) { return is_meant(get<E>(recorded.event)); },
      Trace::Among({}, kind_of<E>, end + 1));
  return step ? std::optional(Found<E>{*step, *event_at<E>(trace, *step)}) : std::nullopt;
}
template <class E>
std::optional<Found<E>> last_event(const Trace& trace, std::int64_t from, std::int64_t end = 0) {
  return last_that<E>(trace, from, end, [](const E&) { return true; });
}

/// The first step in (from, end) whose event E satisfies `beyond`, where all E that follow do so, too. By leaps and
/// then by halving, so that few blocks are read; what is near is found soonest.
template <class E, class Beyond>
std::optional<Found<E>> first_beyond(const Trace& trace, std::int64_t from, std::int64_t end, const Beyond& beyond) {
  constexpr std::int64_t block = block_events;  // what is not larger is read from its beginning to its end
  std::int64_t low = from, high = end,
               leap = block;  // no E up to `low` is beyond; one after it, or the first after `high`, is
  while (high - low > block) {
    const std::int64_t near_middle = low + std::min(leap, (high - low) / 2), begin = trace.begin_of_block(near_middle);
    const std::int64_t middle = begin > low ? begin : near_middle;
    const auto found = next_event<E>(trace, middle, end);
    if (!found || beyond(found->event)) high = middle, leap = end;
    else low = found->step, leap = std::min(4 * leap, end);
  }
  return next_that<E>(trace, low, end, beyond);
}

/// The step in (from, end) whose event E has this number, where the numbers of all E in there go up.
template <class E>
std::optional<std::int64_t> numbered(const Trace& trace, std::int64_t from, std::int64_t end, std::int32_t E::*number,
                                     std::int32_t wanted) {
  const auto found = first_beyond<E>(trace, from, end, [&](const E& event) { return event.*number >= wanted; });
  return found && found->event.*number == wanted ? std::optional(found->step) : std::nullopt;
}

/// The step after which the buffers are the eye's: 0, unless the run draws what its light sees first; beyond the end
/// where it comes no further.
std::int64_t begin_of_eye_pass(const Trace& trace);
/// The step after which the picture grew that is there in the end: that of the last clear, not before the eye's turn.
std::int64_t begin_of_picture(const Trace& trace);

/// Where work on a polygon begins in the eye's picture: its marks.
std::vector<std::int64_t> marks_of(const Trace& trace, std::int32_t polygon);
/// The mark after a step, of whatever polygon; the end of the trace if there is none.
std::int64_t next_mark(const Trace& trace, std::int64_t step);
/// Of the last mark, 0 if there is none.
std::int64_t last_mark(const Trace& trace);

// Where in a trace the steps stand that a chain passes through. A search begins where its step must be near: at the
// polygon at work, at the line, at the beginning of the run; none goes through a whole trace where there is another
// way.

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
