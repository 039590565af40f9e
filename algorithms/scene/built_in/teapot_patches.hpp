// The control points of Newell's teapot.
#pragma once

#include <array>
#include <cstdint>

namespace zstep::scene {

/// (x, y, z) in millionths.
extern const std::array<std::array<std::int32_t, 3>, 265> teapot_points;

/// Indices into teapot_points: control point (i, j) of a patch stands at 4 i + j. dP/di x dP/dj points outwards.
extern const std::array<std::array<std::int16_t, 16>, 28> teapot_patches;

}  // namespace zstep::scene
