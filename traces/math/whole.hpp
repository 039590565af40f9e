// Whole numbers made of others: rounded to the nearest, up or down.
#pragma once

#include <cmath>
#include <cstdint>

namespace zstep {

/// The nearest one; of halves, the one farther from 0.
inline int nearest_int(double x) { return static_cast<int>(std::lround(x)); }
inline int floor_int(double x) { return static_cast<int>(std::floor(x)); }
inline int ceil_int(double x) { return static_cast<int>(std::ceil(x)); }
/// Of a channel of a colour.
inline std::uint8_t nearest_byte(double x) { return static_cast<std::uint8_t>(std::lround(x)); }

}  // namespace zstep
