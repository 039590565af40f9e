// Draws a scene with Mesa's own rasteriser, off screen.
#pragma once

#include <cstdint>
#include <string>

#include "traces/scene.hpp"

namespace zstep::test {

/// The scene as OpenGL draws it through the same camera: polygon index by pixel, and z_v recovered from OpenGL's depth
/// (+inf where nothing was drawn). Row 0 on top. Convex facets only. Throws std::runtime_error if Mesa fails.
Picture draw_with_mesa(const Scene& scene, bool cull);

/// Which Mesa, and which of its drivers.
std::string mesa_version();

}  // namespace zstep::test
