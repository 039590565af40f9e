// From the first step of a trace to the last, each with everything before it.
#pragma once

#include "traces/formulas/situation_of.hpp"
#include "traces/replay/apply.hpp"
#include "traces/replay/beginning.hpp"

namespace zstep::formulas {

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
          at.passed(e);
          state.position = position;
          return true;
        },
        recorded.event);
  });
  return state;
}

}  // namespace zstep::formulas
