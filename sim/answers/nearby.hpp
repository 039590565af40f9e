// The little of a state that the words of a single step need, from the events just before it instead of a replay.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/answers/visits.hpp"
#include "traces/replay/state.hpp"

namespace zstep::answers {

/// For steps of one pixel, of one polygon before the raster, and along a ray; nullopt for others: those need a replay.
/// `visit`: what that step is part of, for a step of one pixel.
std::optional<State> state_nearby(const Trace& trace, std::int64_t step, std::int32_t polygon, const Visit* visit);

}  // namespace zstep::answers
