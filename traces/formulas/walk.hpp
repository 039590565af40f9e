// From the first step of a trace to the last, each with everything before it and with what its formulas may look at.
#pragma once

#include <cstdint>
#include <functional>

#include "traces/file/trace.hpp"
#include "traces/formulas/edge_functions.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/replay/apply.hpp"
#include "traces/replay/key_frames.hpp"
#include "traces/scene.hpp"

namespace zstep {
class Replay;
}

namespace zstep::formulas {

// What a trace's steps may look at.

namespace detail {

/// The spans that the pixels at a position may belong to, where these are several.
inline void recall_spans(const Trace& trace, Situation& at) {
  const std::int64_t position = at.before.position;
  if (position == 0 || !trace.has(kind_of<SpanBegin>) || (!at.ahead.of_all && !at.method().span)) return;
  std::int64_t from = 0;
  if (!at.ahead.of_all) {
    int spans = 0;  // that no pixel came between, up to the one at work
    trace.each_back(position, [&](std::int64_t step, const RecordedEvent& recorded) {
      const Event& event = recorded.event;
      if (holds<SpanBegin>(event)) ++spans;
      const bool ends =
          has(at_pixel_of(event), AtPixel::depth) || holds<PolygonBegin>(event) || holds<PieceDraw>(event);
      if (spans > 0 && ends) from = step;
      return from == 0;
    });
    if (spans < 2) return;
    at.ahead.begin(at.method().polygon);
  }
  trace.each(from, position, [&](std::int64_t step, const RecordedEvent& recorded) {
    visit_event([&](const auto& e) { at.passed(step, e); }, recorded.event);
    return true;
  });
}

}  // namespace detail

/// Before the step that follows `before`, under the conventions of `header`. Both are looked at, not copied.
inline Situation situation_of(const Trace& trace, const State& before, const Header& header) {
  Situation at{header, trace.scene(), before};
  if (trace.scene().light) at.lamp = camera_of(*trace.scene().light);
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    at.kinds_recorded[kind] = trace.has(static_cast<std::uint8_t>(kind));
  for (const StepInfo& step : header.page)
    if (step.kind < kind_count) at.kinds_on_page[step.kind] = 1;
  at.ahead = spans_ahead_of(trace, header.conventions);
  at.steps_edges = steps_edges(header.conventions);
  detail::recall_spans(trace, at);
  at.look();
  return at;
}

inline Situation situation_of(const Trace& trace, const State& before) {
  return situation_of(trace, before, trace.header());
}

/// After the step that led to `after`, for who looks at that step: its pixel is at work.
inline Situation situation_after(const Trace& trace, const State& after) {
  Situation at = situation_of(trace, after);
  at.has_passed = true;
  return at;
}

/// visit(position, const E& event, const Situation& before) for every step, until it returns false;
/// impossible(position, why) where a step does not go with what was before it, which is left out then. Returns the
/// state at the end. (`zstep check` goes through traces by Trace::visit, which is faster and takes longer to compile.)
template <class Visit, class OnImpossible>
State walk(const Trace& trace, Visit&& visit, OnImpossible&& impossible) {
  const Beginning beginning(trace);
  State state = beginning.state();
  Situation at = situation_of(trace, state);
  NoLog log;
  trace.each(0, trace.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
    return visit_event(
        [&](const auto& e) -> bool {
          at.look();
          if (!visit(position, e, static_cast<const Situation&>(at))) return false;
          try {
            apply_stores(e, state, trace.scene().points.size(), log);
            apply_method_state(e, state.machine, position);
          } catch (const Impossible& why) {
            impossible(position, why);
          }
          at.passed(position, e);
          state.position = position;
          return true;
        },
        recorded.event);
  });
  return state;
}

/// look(before) with what comes before a step, for who looks at some steps of a run alone: the replay is moved there.
/// Steps that do not go with what was before them are passed over, as `zstep check` does.
void look_before(const Trace& trace, Replay& replay, std::int64_t step,
                 const std::function<void(const Situation&)>& look);

/// The state after the last step, likewise.
State end_of(const Trace& trace);

}  // namespace zstep::formulas
