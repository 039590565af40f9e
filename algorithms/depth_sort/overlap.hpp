// Do the projections of two polygons overlap?
#pragma once

#include <optional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace zstep::depth_sort {

/// What is no wider or no higher than this is no overlap but a touch, in px. Pixel centres within 1.5/256 px of an edge
/// may go either way, so nothing that counts is lost.
inline constexpr double touch = 1e-6;

/// A point inside both outlines by the even-odd rule, z left out of account; none if they do not overlap or only touch.
/// Outlines may be concave and cross themselves.
std::optional<glm::dvec2> common_point(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q);

}  // namespace zstep::depth_sort
