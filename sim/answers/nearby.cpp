#include "sim/answers/nearby.hpp"

namespace zstep::answers {
namespace {

/// The pixel at work, as the replay would have it.
template <class E>
void set_fragment(State& state, const E& event, const Touch& touch) {
  Fragment fragment;
  fragment.x = event.x, fragment.y = event.y, fragment.z = event.z;
  fragment.stored = touch.stored;
  fragment.stored_polygon = touch.stored_polygon;
  state.machine.fragment = fragment;
}

/// The span on which a pixel is painted, and none where a method paints without spans.
void set_span(State& state, const Trace& trace, std::int64_t step, const PixelPaint& paint) {
  if (!records<SpanBegin>(trace)) return;
  const auto begin = previous_of<SpanBegin, PieceDraw, AreaBegin, RayBegin, SpanWinner>(trace, step);
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

std::optional<State> state_nearby(const Trace& trace, std::int64_t step, std::int32_t polygon, const Touch* touch) {
  const RecordedEvent recorded = trace.event(step);
  State state;
  state.position = step;
  state.machine.polygon = polygon;
  if (const auto* compare = get_if<DepthCompare>(&recorded.event); compare && touch) {
    set_fragment(state, *compare, *touch);
    state.machine.fragment->nearer = compare->nearer;
    return state;
  }
  if (const auto* paint = get_if<PixelPaint>(&recorded.event); paint && touch) {
    set_fragment(state, *paint, *touch);
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
