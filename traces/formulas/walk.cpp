#include "traces/formulas/walk.hpp"

#include "traces/error.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::formulas {

namespace {

/// Goes to a step, or to the end, and passes over what cannot be.
State pass_over(const Trace& trace, std::int64_t step, const std::function<void(const Situation&)>& look) {
  return walk(
      trace,
      [&](std::int64_t position, const auto&, const Situation& before) {
        if (position == step) look(before);
        return position < step;
      },
      [](std::int64_t, const Impossible&) {});
}

}  // namespace

void look_before(const Trace& trace, Replay& replay, std::int64_t step,
                 const std::function<void(const Situation&)>& look) {
  try {
    replay.go_to(step - 1);
  } catch (const InputError&) {
    pass_over(trace, step, look);
    return;
  }
  look(situation_of(trace, replay.state()));
}

State end_of(const Trace& trace) {
  Replay replay(trace);
  try {
    replay.go_to(trace.size());
  } catch (const InputError&) {
    return pass_over(trace, trace.size() + 1, nullptr);
  }
  return replay.state();
}

}  // namespace zstep::formulas
