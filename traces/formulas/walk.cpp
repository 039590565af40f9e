#include "traces/formulas/walk.hpp"

#include "traces/error.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::formulas {

void look_before(const Trace& trace, Replay& replay, std::int64_t step,
                 const std::function<void(const Situation&)>& look) {
  try {
    replay.go_to(step - 1);
  } catch (const InputError&) {
    walk(
        trace,
        [&](std::int64_t position, const auto&, const Situation& before) {
          if (position == step) look(before);
          return position < step;
        },
        [](std::int64_t, const Impossible&) {});
    return;
  }
  look(situation_of(trace, replay.state()));
}

}  // namespace zstep::formulas
