#include "sim/answers/origin/find.hpp"

#include <algorithm>

namespace zstep::answers {

std::optional<std::int64_t> next_within(const Trace& trace, std::int64_t from, std::int64_t end,
                                        const Trace::Predicate& predicate) {
  return trace.next(from, predicate, Trace::Among({}, {}, end - 1));
}

std::optional<std::int64_t> previous_within(const Trace& trace, std::int64_t from, std::int64_t end,
                                            const Trace::Predicate& predicate) {
  return trace.previous(from, predicate, Trace::Among({}, {}, end + 1));
}

std::int32_t polygon_of_facet(const Scene& scene, std::int32_t facet) {
  const auto at = static_cast<std::size_t>(facet);
  return facet >= 0 && at < scene.facets.size() ? scene.facets[at].polygon : no_polygon;
}

std::int64_t begin_of_eye_pass(const Trace& trace) {
  if (!records<PassBegin>(trace)) return 0;
  // The light's pass has a mark for every facet, and the eye's begins when the last of them is done.
  const auto marks = trace.polygons();
  const std::size_t facets = trace.scene().facets.size();
  const std::int64_t from = facets > 0 && marks.size() >= facets ? marks[facets - 1].position : 0;
  const auto step = trace.next(from, [](const RecordedEvent& recorded) {
    const auto* pass = get_if<PassBegin>(&recorded.event);
    return pass && pass->pass == Pass::eye;
  });
  return step.value_or(trace.size() + 1);
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
  return std::upper_bound(marks.begin(), marks.end(), step,
                          [](std::int64_t at, const PolygonMark& mark) { return at < mark.position; });
}

}  // namespace

std::int64_t next_mark(const Trace& trace, std::int64_t step) {
  const auto beyond = mark_beyond(trace, step);
  return beyond == trace.polygons().end() ? trace.size() + 1 : beyond->position;
}

std::int64_t last_mark(const Trace& trace) { return trace.polygons().empty() ? 0 : trace.polygons().back().position; }

}  // namespace zstep::answers
