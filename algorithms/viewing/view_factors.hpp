// The viewing transformation taken apart: T_v = T_4 T_3 T_2 T_1, as 000 composes it.
#pragma once

#include <array>
#include <optional>

#include <glm/mat4x4.hpp>

#include "traces/scene.hpp"

namespace zstep::viewing {

/// T_1 … T_4 of a camera, with (theta, phi) the direction from which its eye looks:
///     T_1  moves the origin to the eye,
///     T_2  turns about z by 90° - theta, so that x lies level across the line of sight,
///     T_3  turns about x by phi - 180°, so that z lies along the line of sight,
///     T_4  changes the sign of x: view coordinates are left-handed.
/// None where the eye is no point (orthographic, screen scenes), or where the camera is tilted about its line of sight,
/// which takes a fifth.
std::optional<std::array<glm::dmat4, 4>> view_factors(const Camera& camera);

}  // namespace zstep::viewing
