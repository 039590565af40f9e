// Defaults and limits of cameras and rasters.
#pragma once

#include <cstdint>

namespace zstep::scene {

inline constexpr std::int32_t largest_side = 16384;   ///< of a raster
inline constexpr std::int64_t most_pixels = 1 << 25;  ///< of a raster: 7680 x 4320 fits
inline constexpr double default_d = 2;                ///< a field of view of 53 degrees with the default window of 1

}  // namespace zstep::scene
