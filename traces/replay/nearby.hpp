// The state at a step without a replay, where the events around it tell all that the words for it need.
#pragma once

#include <optional>

#include "traces/replay/replay.hpp"

namespace zstep {

/// What a pixel held before a step.
struct HeldBefore {
  double depth = no_depth;
  std::int32_t polygon = no_polygon;
};

/// nullopt where only a replay knows it. `before`: of its pixel, for a step of one pixel.
std::optional<State> state_nearby(const Trace& trace, std::int64_t step, std::int32_t polygon,
                                  std::optional<HeldBefore> before);

}  // namespace zstep
