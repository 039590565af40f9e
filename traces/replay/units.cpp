// Where the next pixel, span, scan line or polygon begins.
#include <algorithm>
#include <iterator>

#include "traces/replay/replay.hpp"

namespace zstep {

namespace {

bool records(const Trace& trace, std::uint8_t kind) {
  const Page& page = trace.header().page;
  return std::any_of(page.begin(), page.end(), [&](const StepInfo& step) { return step.kind == kind; });
}

/// The kind of event that begins a unit. A pixel begins with the first thing that is said of it in this trace.
std::uint8_t beginning(const Trace& trace, Unit unit) {
  switch (unit) {
    case Unit::span:
      return kind_of<SpanBegin>;
    case Unit::scan_line:
      return kind_of<ScanLineBegin>;
    case Unit::polygon:
      return kind_of<PolygonBegin>;
    default:
      break;
  }
  for (const std::uint8_t kind : {kind_of<DepthInterpolate>, kind_of<DepthCompare>}) {
    if (records(trace, kind)) return kind;
  }
  return kind_of<PixelWrite>;
}

}  // namespace

std::int64_t next_unit(const Trace& trace, std::int64_t from, Unit unit) {
  if (unit == Unit::event) return std::min(from + 1, trace.size());
  if (unit == Unit::polygon) {
    const auto marks = trace.polygons();
    const auto mark =
        std::upper_bound(marks.begin(), marks.end(), from,
                         [](std::int64_t position, const PolygonMark& m) { return position < m.position; });
    return mark == marks.end() ? trace.size() : mark->position;
  }
  const std::uint8_t kind = beginning(trace, unit);
  return trace.next(from, [&](const RecordedEvent& event) { return event.event.index() == kind; })
      .value_or(trace.size());
}

std::int64_t previous_unit(const Trace& trace, std::int64_t from, Unit unit) {
  if (unit == Unit::event) return std::max<std::int64_t>(from - 1, 0);
  if (unit == Unit::polygon) {
    const auto marks = trace.polygons();
    const auto mark =
        std::lower_bound(marks.begin(), marks.end(), from,
                         [](const PolygonMark& m, std::int64_t position) { return m.position < position; });
    return mark == marks.begin() ? 0 : std::prev(mark)->position;
  }
  const std::uint8_t kind = beginning(trace, unit);
  return trace.previous(from, [&](const RecordedEvent& event) { return event.event.index() == kind; }).value_or(0);
}

}  // namespace zstep
