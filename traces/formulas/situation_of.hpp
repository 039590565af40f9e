// What a trace's steps may look at.
#pragma once

#include "traces/file/trace.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::formulas {

/// Before the step that follows `before`, which is looked at, not copied.
inline Situation situation_of(const Trace& trace, const State& before) {
  Situation at{trace.header(), trace.scene(), before, nullptr, {}};
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    at.kinds_recorded[kind] = trace.has(static_cast<std::uint8_t>(kind));
  at.look();
  return at;
}

}  // namespace zstep::formulas
