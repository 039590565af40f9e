// Draws a scene with Mesa's own rasteriser, off screen.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::test {

/// What OpenGL leaves in its buffers of a scene: polygon index by pixel, and its depths, 0 … 1 (+inf where nothing was
/// drawn). Row 0 at the bottom. Convex facets only. Throws std::runtime_error if Mesa fails.
/// `on_facet` is given them after each facet.
using OnFacet = std::function<void(std::int32_t facet, const Picture&)>;
Picture drawn_by_opengl(const Scene& scene, bool cull, const OnFacet& on_facet = nullptr);
/// The scene as OpenGL draws it through the same camera: polygon index by pixel, and z_v recovered from OpenGL's depth
/// (+inf where nothing was drawn). Row 0 on top. Convex facets only. Throws std::runtime_error if Mesa fails.
Picture draw_with_mesa(const Scene& scene, bool cull);

/// The colours of that picture where each vertex has its attribute "color", or, with a texture, of its "uv" in it, each
/// texel by itself or mixed with its neighbours. Black where nothing was drawn. Row 0 on top.
std::vector<Color> colors_by_opengl(const Scene& scene, bool cull, const Texture* texture = nullptr,
                                    bool mixed = false);

/// Which Mesa, and which of its drivers.
std::string mesa_version();

}  // namespace zstep::test
