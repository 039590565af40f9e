// Which depths a check cannot judge.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep {

/// The kinds of event that record the depth of a pixel, but of which the trace nowhere has the operands of it: no span
/// and no plane that it follows from. Of a long trace its beginning shows that.
std::vector<std::uint8_t> depths_not_judged(const Trace& trace);

}  // namespace zstep
