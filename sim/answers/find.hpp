// Searches in a trace that look at no more of it than they must.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::answers {

/// The first step in (from, end) that satisfies the predicate; the last one in (end, from) for the way back.
std::optional<std::int64_t> next_within(const Trace& trace, std::int64_t from, std::int64_t end, const Trace::Predicate& predicate);
std::optional<std::int64_t> previous_within(const Trace& trace, std::int64_t from, std::int64_t end, const Trace::Predicate& predicate);

template <class... E>
bool is_one_of(const RecordedEvent& recorded) {
  return (std::holds_alternative<E>(recorded.event) || ...);
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
template <class... E>
std::optional<std::int64_t> previous_of(const Trace& trace, std::int64_t from, std::int64_t end = 0) {
  return trace.previous(from, is_one_of<E...>, Trace::Among({}, only_kind<E...>(), end + 1));
}

/// The event at a step, if it is of this kind. A copy: the trace's own goes away when others are read.
template <class E>
std::optional<E> event_at(const Trace& trace, std::int64_t step) {
  if (step < 1 || step > trace.size()) return std::nullopt;
  const auto* event = std::get_if<E>(&trace.event(step).event);
  return event ? std::optional<E>(*event) : std::nullopt;
}

/// Can the run have recorded events of this kind?
template <class E>
bool records(const Trace& trace) {
  for (const StepInfo& step : trace.header().page)
    if (step.kind == kind_of<E>) return true;
  return false;
}

/// The step in (from, end) whose event E has this number, where the numbers of all E in there go up. By halving, so that few
/// blocks are read.
template <class E>
std::optional<std::int64_t> numbered(const Trace& trace, std::int64_t from, std::int64_t end, std::int32_t E::*number, std::int32_t wanted) {
  std::int64_t low = from, high = end;  // what is wanted lies in (low, high]
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    const auto found = next_of<E>(trace, middle, std::min(end, high + 1));
    const std::optional<E> event = found ? event_at<E>(trace, *found) : std::nullopt;
    if (!event || (*event).*number > wanted) high = middle;
    else if ((*event).*number == wanted) return found;
    else low = *found;
  }
  return std::nullopt;
}

/// The step after which the buffers are the eye's: 0, unless the run draws what its light sees first.
std::int64_t begin_of_eye_pass(const Trace& trace);

/// Where work on a polygon begins in the eye's picture: its marks.
std::vector<std::int64_t> marks_of(const Trace& trace, std::int32_t polygon);
/// The mark after a step, of whatever polygon; the end of the trace if there is none.
std::int64_t next_mark(const Trace& trace, std::int64_t step);
/// Of the last mark, 0 if there is none.
std::int64_t last_mark(const Trace& trace);

/// Something that a polygon did to a pixel of the eye's picture.
struct Touch {
  enum class How : std::uint8_t { compared, painted, blended } how = How::compared;
  std::int64_t step = 0;
  std::int32_t polygon = no_polygon;  ///< of whom; none where the trace does not say
  double z = 0;                       ///< its depth
  bool nearer = true;                 ///< of a compare, its outcome
  std::int64_t written = 0;           ///< the step that changed the pixel, 0 if none did
  bool takes = false;                 ///< the pixel is this polygon's from then on: glass that is mixed in only colours it
  double opacity = 1;                 ///< of what is blended
};
/// All that happened to a pixel of the eye's picture, in order. A blend that follows a compare is one with it.
std::vector<Touch> touches_of(const Trace& trace, Trace::Pixel pixel);

/// The last that took the pixel before a step; nullptr while it shows the background.
const Touch* holder(const std::vector<Touch>& touches, std::int64_t before);

}  // namespace zstep::answers
