#include "sim/answers/nearby.hpp"

namespace zstep::answers {
namespace {

/// The pixel at work, as the replay would have it.
template <class E>
void set_fragment(State& state, const Trace& trace, const E& event, const Visit& visit) {
  Fragment fragment;
  fragment.x = event.x, fragment.y = event.y, fragment.z = event.z;
  fragment.stored = visit.stored.value_or(trace.header().empty_depth());
  fragment.stored_polygon = visit.stored_polygon;
  state.machine.fragment = fragment;
}

/// The span on which a pixel is painted, and none where a method paints without spans.
void set_span(State& state, const Trace& trace, std::int64_t step, const PixelPaint& paint) {
  if (!records<SpanBegin>(trace)) return;
  const auto begin = previous_of<SpanBegin, PieceDraw, SpanWinner>(trace, step);
  const auto span = begin ? event_at<SpanBegin>(trace, *begin) : std::nullopt;
  if (span && span->y == paint.y && span->first <= paint.x && paint.x <= span->last) state.machine.span = span;
}

/// The ray and what it met so far.
void set_ray(State& state, const Trace& trace, std::int64_t step) {
  const auto begin = previous_of<RayBegin>(trace, step);
  if (!begin) return;
  const RayBegin ray = *event_at<RayBegin>(trace, *begin);
  state.machine.rays.tree.push_back({ray, std::nullopt});
  state.machine.rays.ray = ray.ray;
  for (std::int64_t k = *begin + 1; k <= step; ++k)
    if (const auto hit = event_at<RayHit>(trace, k)) state.machine.rays.hits.push_back(*hit);
}

}  // namespace

std::optional<State> state_nearby(const Trace& trace, std::int64_t step, std::int32_t polygon, const Visit* visit) {
  const RecordedEvent recorded = trace.event(step);
  State state;
  state.position = step;
  state.machine.polygon = polygon;
  if (const auto* compare = get_if<DepthCompare>(&recorded.event); compare && visit) {
    set_fragment(state, trace, *compare, *visit);
    state.machine.fragment->nearer = compare->nearer;
    return state;
  }
  if (const auto* paint = get_if<PixelPaint>(&recorded.event); paint && visit) {
    set_fragment(state, trace, *paint, *visit);
    set_span(state, trace, step, *paint);
    return state;
  }
  if (is_one_of<RayPlane, RayHit>(recorded)) {
    set_ray(state, trace, step);
    return state;
  }
  if (is_one_of<FacingTest, ClipTest, ClipVertex, PolygonReject, BoxTest, CellVisit, CoverageAdd>(recorded))
    return state;
  return std::nullopt;
}

}  // namespace zstep::answers
