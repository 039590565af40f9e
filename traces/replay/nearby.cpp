#include "traces/replay/nearby.hpp"

#include "traces/file/records.hpp"

namespace zstep {
namespace {

template <class... E>
bool is_one_of(const Event& event) {
  return (holds<E>(event) || ...);
}

/// The pixel at work, as the replay would have it.
template <class E>
void set_fragment(State& state, const E& event, const HeldBefore& before) {
  Fragment fragment;
  fragment.x = event.x, fragment.y = event.y, fragment.z = event.z;
  fragment.stored = before.depth;
  fragment.stored_polygon = before.polygon;
  state.machine.fragment = fragment;
}

/// The span on which a pixel is painted, and none where a method paints without spans.
void set_span(State& state, const Trace& trace, std::int64_t step, const PixelPaint& paint) {
  if (!records<SpanBegin>(trace.header())) return;
  const auto begin = trace.previous(
      step, [](const RecordedEvent& recorded) { return is_one_of<SpanBegin, PieceDraw, SpanWinner>(recorded.event); });
  if (!begin) return;
  const Event event = trace.event(*begin).event;
  if (const auto* span = get_if<SpanBegin>(&event))
    if (span->y == paint.y && span->first <= paint.x && paint.x <= span->last) state.machine.span = *span;
}

/// The ray and what it met so far.
void set_ray(State& state, const Trace& trace, std::int64_t step) {
  const auto begin = trace.previous(
      step, [](const RecordedEvent& recorded) { return holds<RayBegin>(recorded.event); },
      Trace::Among({}, kind_of<RayBegin>));
  if (!begin) return;
  const RayBegin ray = get<RayBegin>(trace.event(*begin).event);
  state.machine.rays.tree.push_back({ray, std::nullopt});
  state.machine.rays.ray = ray.ray;
  for (std::int64_t k = *begin + 1; k <= step; ++k) {
    const Event event = trace.event(k).event;
    if (const auto* hit = get_if<RayHit>(&event)) state.machine.rays.hits.push_back(*hit);
  }
}

}  // namespace

std::optional<State> state_nearby(const Trace& trace, std::int64_t step, std::int32_t polygon,
                                  std::optional<HeldBefore> before) {
  const Event event = trace.event(step).event;
  State state;
  state.position = step;
  state.machine.polygon = polygon;
  if (const auto* compare = get_if<DepthCompare>(&event); compare && before) {
    set_fragment(state, *compare, *before);
    state.machine.fragment->nearer = compare->nearer;
    return state;
  }
  if (const auto* paint = get_if<PixelPaint>(&event); paint && before) {
    set_fragment(state, *paint, *before);
    set_span(state, trace, step, *paint);
    return state;
  }
  if (is_one_of<RayPlane, RayHit>(event)) {
    set_ray(state, trace, step);
    return state;
  }
  if (is_one_of<ClipTest, PolygonReject, BoxTest, CellVisit, CoverageAdd>(event)) return state;
  return std::nullopt;
}

}  // namespace zstep
