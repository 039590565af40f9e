// How large a scene can be. Files from others are held to these before memory is asked for.
#pragma once

#include <cstddef>
#include <cstdint>

namespace zstep {

inline constexpr std::int32_t largest_side = 16384;   ///< of a raster
inline constexpr std::int64_t most_pixels = 1 << 25;  ///< of a raster: 7680 x 4320 fits

inline constexpr std::int64_t most_points = 2'000'000;
inline constexpr std::int64_t most_polygons = 2'500'000;
inline constexpr std::int64_t most_facets = 4'000'000;
inline constexpr std::int64_t most_corners = 6'000'000;
inline constexpr std::int64_t most_corners_of_polygon = 20'000;  ///< the active edge list is searched from the left
inline constexpr double least_refraction = 0.1, most_refraction = 10;  ///< diamond has 2.4
inline constexpr std::int64_t most_surface_samples = 250'000;          ///< columns times rows
inline constexpr std::size_t longest_formula = 200;                    ///< characters

}  // namespace zstep
