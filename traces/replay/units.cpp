// Where the next pixel, span, scan line or polygon begins.
#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include "traces/events/fields.hpp"
#include "traces/file/records.hpp"
#include "traces/replay/replay.hpp"

namespace zstep {

namespace {

/// The kinds of event that begin a unit: of a method that has areas or edges in the stead of scan lines, these. A pixel
/// begins with the first thing that is said of it in this trace; methods that may do without depths paint it at once.
std::set<std::size_t> beginnings(const Trace& trace, Unit unit) {
  const Header& header = trace.header();
  const Begins* first = nullptr;
  std::set<std::size_t> kinds;
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const Begins& begins = description_of_kind(kind).begins;
    if (begins.unit != unit || !records(header, kind)) continue;
    if (first == nullptr) first = &begins;
    if (begins.word == first->word) kinds.insert(kind);
  }
  if (unit != Unit::pixel || !kinds.empty()) return kinds;
  kinds.insert(kind_of<PixelPaint>);
  for (const std::uint8_t kind : {kind_of<DepthInterpolate>, kind_of<DepthCompare>, kind_of<HorizonTest>}) {
    if (!records(header, kind)) continue;
    kinds.insert(kind);
    return kinds;
  }
  if (!records(header, kind_of<PixelPaint>))
    kinds.insert(records(header, kind_of<ColorWrite>) ? kind_of<ColorWrite> : kind_of<PixelWrite>);
  return kinds;
}

/// Work on polygons in turn, by the trace's marks.
bool by_marks(const Trace& trace, Unit unit) { return unit == Unit::polygon && !trace.polygons().empty(); }

}  // namespace

std::int64_t next_unit(const Trace& trace, std::int64_t from, Unit unit) {
  if (unit == Unit::event) return std::min(from + 1, trace.size());
  if (by_marks(trace, unit)) {
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
  if (by_marks(trace, unit)) {
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
