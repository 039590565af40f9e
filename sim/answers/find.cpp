#include "sim/answers/find.hpp"

#include <algorithm>

namespace zstep::answers {

std::optional<std::int64_t> next_within(const Trace& trace, std::int64_t from, std::int64_t end, const Trace::Predicate& predicate) {
  return trace.next(from, predicate, Trace::Among({}, {}, end - 1));
}

std::optional<std::int64_t> previous_within(const Trace& trace, std::int64_t from, std::int64_t end, const Trace::Predicate& predicate) {
  return trace.previous(from, predicate, Trace::Among({}, {}, end + 1));
}

std::int64_t begin_of_eye_pass(const Trace& trace) {
  if (!records<PassBegin>(trace)) return 0;
  // The light's pass has a mark for every facet, and the eye's begins when the last of them is done.
  const auto marks = trace.polygons();
  const std::size_t facets = trace.scene().facets.size();
  const std::int64_t from = facets > 0 && marks.size() >= facets ? marks[facets - 1].position : 0;
  const auto step = trace.next(from, [](const RecordedEvent& recorded) {
    const auto* pass = std::get_if<PassBegin>(&recorded.event);
    return pass && pass->pass == Pass::eye;
  });
  return step.value_or(trace.size());
}

std::int64_t begin_of_picture(const Trace& trace) {
  const std::int64_t eye = begin_of_eye_pass(trace);
  return trace.clears().empty() ? eye : std::max(eye, trace.clears().back());
}

std::vector<std::int64_t> marks_of(const Trace& trace, std::int32_t polygon) {
  const std::int64_t begin = begin_of_picture(trace);
  std::vector<std::int64_t> steps;
  for (const PolygonMark& mark : trace.polygons())
    if (mark.polygon == polygon && mark.position > begin) steps.push_back(mark.position);
  return steps;
}

namespace {

auto mark_beyond(const Trace& trace, std::int64_t step) {
  const auto marks = trace.polygons();
  return std::upper_bound(marks.begin(), marks.end(), step, [](std::int64_t at, const PolygonMark& mark) { return at < mark.position; });
}

/// Whose work a step without a name is.
std::int32_t owner_of(const Trace& trace, std::int64_t step) {
  if (records<FlagFlip>(trace)) {  // a line buffer: the polygon of the span's edge, in the one edge table
    const auto span = previous_of<SpanBegin>(trace, step);
    if (!span) return no_polygon;
    const std::int32_t edge = event_at<SpanBegin>(trace, *span)->left_edge;
    const auto entry = numbered(trace, last_mark(trace), *span, &EdgeTableInsert::edge, edge);
    return entry ? event_at<EdgeTableInsert>(trace, *entry)->polygon : no_polygon;
  }
  const auto beyond = mark_beyond(trace, step);
  const std::int64_t mark = beyond == trace.polygons().begin() ? 0 : std::prev(beyond)->position;
  if (records<PieceDraw>(trace))
    if (const auto draw = previous_of<PieceDraw>(trace, step, mark)) return event_at<PieceDraw>(trace, *draw)->polygon;
  return mark == 0 ? no_polygon : std::prev(beyond)->polygon;
}

}  // namespace

std::int64_t next_mark(const Trace& trace, std::int64_t step) {
  const auto beyond = mark_beyond(trace, step);
  return beyond == trace.polygons().end() ? trace.size() + 1 : beyond->position;
}

std::int64_t last_mark(const Trace& trace) { return trace.polygons().empty() ? 0 : trace.polygons().back().position; }

std::vector<Touch> touches_of(const Trace& trace, Trace::Pixel pixel) { return touches_of(trace, pixel, begin_of_picture(trace)); }

std::vector<Touch> touches_of(const Trace& trace, Trace::Pixel pixel, std::int64_t after) {
  std::vector<std::pair<std::int64_t, Event>> here;
  trace.scan(pixel, [&](std::int64_t step, const RecordedEvent& recorded) {
    if (step > after && is_one_of<DepthCompare, PixelWrite, PixelPaint, ColorBlend>(recorded)) here.emplace_back(step, recorded.event);
    return true;
  });
  std::vector<Touch> all;
  for (const auto& [step, event] : here) {
    Touch touch;
    touch.step = step;
    const bool compared = !all.empty() && all.back().how == Touch::How::compared && all.back().nearer && !all.back().takes;
    if (const auto* compare = std::get_if<DepthCompare>(&event)) {
      touch.z = compare->z, touch.nearer = compare->nearer;
      touch.polygon = owner_of(trace, step);
      all.push_back(touch);
    } else if (const auto* blend = std::get_if<ColorBlend>(&event)) {
      if (!compared) all.push_back(touch);
      Touch& last = all.back();
      last.how = Touch::How::blended, last.polygon = blend->polygon, last.opacity = blend->opacity;
      last.written = step;
    } else if (const auto* write = std::get_if<PixelWrite>(&event)) {
      const bool goes_on = compared || (!all.empty() && all.back().how == Touch::How::blended && all.back().polygon == write->polygon);
      if (!goes_on) all.push_back(touch);
      all.back().polygon = write->polygon;
      if (all.back().how != Touch::How::blended) all.back().written = step;  // a blend has coloured it already
      all.back().takes = true;
    } else if (const auto* paint = std::get_if<PixelPaint>(&event)) {
      touch.how = Touch::How::painted, touch.polygon = paint->polygon, touch.z = paint->z, touch.written = step, touch.takes = true;
      all.push_back(touch);
    }
  }
  return all;
}

const Touch* holder(const std::vector<Touch>& touches, std::int64_t before) {
  const Touch* last = nullptr;
  for (const Touch& touch : touches)
    if (touch.step < before && touch.takes) last = &touch;
  return last;
}

}  // namespace zstep::answers
