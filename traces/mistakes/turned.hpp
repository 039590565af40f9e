// Mistakes that put every pixel elsewhere: found by moving all of them back, as nothing else in such a run is wrong.
#pragma once

#include <optional>

#include "traces/check/precision.hpp"
#include "traces/file/trace.hpp"
#include "traces/mistakes/mistake.hpp"

namespace zstep::mistakes {

/// y_upside_down or x_y_exchanged, where the run has the reference's steps at pixels, number by number, once y is
/// turned over or x and y are exchanged; and not both of them do.
std::optional<Mistake> turned_of(const Trace& reference, const Trace& run, const Precision& precision);

}  // namespace zstep::mistakes
