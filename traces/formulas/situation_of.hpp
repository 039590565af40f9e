// What a trace's steps may look at.
#pragma once

#include "traces/file/trace.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/lamp.hpp"

namespace zstep::formulas {

/// Before the step that follows `before`, under the conventions of `header`. Both are looked at, not copied.
inline Situation situation_of(const Trace& trace, const State& before, const Header& header) {
  Situation at{header, trace.scene(), before};
  if (trace.scene().light) at.lamp = camera_of(*trace.scene().light);
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    at.kinds_recorded[kind] = trace.has(static_cast<std::uint8_t>(kind));
  at.look();
  return at;
}

inline Situation situation_of(const Trace& trace, const State& before) {
  return situation_of(trace, before, trace.header());
}

}  // namespace zstep::formulas
