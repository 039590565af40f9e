// Defaults of cameras; the limits of scenes are in traces/limits.hpp.
#pragma once

#include "traces/limits.hpp"

namespace zstep::scene {

inline constexpr double default_d = 2;  ///< a field of view of 53 degrees with the default window of 1

}  // namespace zstep::scene
