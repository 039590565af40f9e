#include "sim/viewer/model/no_lines.hpp"

#include <algorithm>

#include "sim/words/explain.hpp"

namespace zstep::viewer {

std::string why_no_lines(const Trace& trace, const ScanLineMarks::Interval& interval, std::int64_t position) {
  if (!trace.has(kind_of<ScanLineBegin>)) return "this run records no scan lines";
  if (trace.polygon_at_work(position) == no_polygon) return "no polygon is at work here, and so no scan line";
  const std::string polygon = "polygon " + polygon_label(trace.scene(), interval.polygon);
  const auto later = [&](const PolygonMark& mark) {
    return mark.polygon == interval.polygon && mark.position > interval.first;
  };
  const auto rejected = [&](const RejectMark& mark) {
    return mark.polygon == interval.polygon && mark.position > interval.first && mark.position <= interval.last;
  };
  if (const auto all = trace.rejects(); std::any_of(all.begin(), all.end(), rejected))
    return polygon + " is not drawn here: no scan lines";
  if (const auto all = trace.polygons(); std::any_of(all.begin(), all.end(), later))
    return "no scan lines of " + polygon + " yet";
  return polygon + " has no scan line in this run";  // whether it meets any, the run need not say
}

}  // namespace zstep::viewer
