// Where the next pixel, span, scan line or polygon begins.
#include <algorithm>
#include <iterator>
#include <set>

#include "traces/replay/replay.hpp"

namespace zstep {

namespace {

bool records(const Trace& trace, std::uint8_t kind) {
  const Page& page = trace.header().page;
  return std::any_of(page.begin(), page.end(), [&](const StepInfo& step) { return step.kind == kind; });
}

/// The kinds of event that begin a unit. A pixel begins with the first thing that is said of it in this trace; methods
/// that may do without depths paint it at once.
std::set<std::size_t> beginnings(const Trace& trace, Unit unit) {
  if (unit == Unit::span) return {kind_of<SpanBegin>, kind_of<SpanFlags>};
  if (unit == Unit::scan_line) {  // where there are none, the areas or edges that a method works on in their stead
    for (const std::uint8_t kind : {kind_of<ScanLineBegin>, kind_of<AreaBegin>, kind_of<LineBegin>}) {
      if (records(trace, kind)) return {kind};
    }
    return {kind_of<ScanLineBegin>};
  }
  if (unit == Unit::polygon) return {kind_of<CurveBegin>};  // of a method that works on curves in turn
  if (records(trace, kind_of<RayBegin>)) return {kind_of<RayBegin>};
  std::set<std::size_t> kinds{kind_of<PixelPaint>};
  for (const std::uint8_t kind :
       {kind_of<DepthInterpolate>, kind_of<DepthCompare>, kind_of<HorizonTest>}) {
    if (!records(trace, kind)) continue;
    kinds.insert(kind);
    return kinds;
  }
  if (!records(trace, kind_of<PixelPaint>))
    kinds.insert(records(trace, kind_of<ColorWrite>) ? kind_of<ColorWrite> : kind_of<PixelWrite>);
  return kinds;
}

}  // namespace

std::int64_t next_unit(const Trace& trace, std::int64_t from, Unit unit) {
  if (unit == Unit::event) return std::min(from + 1, trace.size());
  if (unit == Unit::polygon && !records(trace, kind_of<CurveBegin>)) {
    const auto marks = trace.polygons();
    const auto mark =
        std::upper_bound(marks.begin(), marks.end(), from,
                         [](std::int64_t position, const PolygonMark& m) { return position < m.position; });
    return mark == marks.end() ? trace.size() : mark->position;
  }
  const std::set<std::size_t> kinds = beginnings(trace, unit);
  return trace.next(from, [&](const RecordedEvent& event) { return kinds.contains(event.event.index()); })
      .value_or(trace.size());
}

std::int64_t previous_unit(const Trace& trace, std::int64_t from, Unit unit) {
  if (unit == Unit::event) return std::max<std::int64_t>(from - 1, 0);
  if (unit == Unit::polygon && !records(trace, kind_of<CurveBegin>)) {
    const auto marks = trace.polygons();
    const auto mark =
        std::lower_bound(marks.begin(), marks.end(), from,
                         [](const PolygonMark& m, std::int64_t position) { return m.position < position; });
    return mark == marks.begin() ? 0 : std::prev(mark)->position;
  }
  const std::set<std::size_t> kinds = beginnings(trace, unit);
  return trace.previous(from, [&](const RecordedEvent& event) { return kinds.contains(event.event.index()); })
      .value_or(0);
}

}  // namespace zstep
