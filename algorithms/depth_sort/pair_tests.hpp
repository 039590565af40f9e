// The tests of depth sort between two pieces, as the events that they are recorded as.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "algorithms/pieces/pieces.hpp"
#include "traces/events/vocabulary.hpp"

namespace zstep::depth_sort {

// Do the projections of two polygons overlap?

/// What is no wider or no higher than this is no overlap but a touch, in px. Pixel centres within 1.5/256 px of an edge
/// may go either way, so nothing that counts is lost.
inline constexpr double touch = 1e-6;

/// A point inside both outlines by the even-odd rule, z left out of account; none if they do not overlap or only touch.
/// Outlines may be concave and cross themselves.
std::optional<glm::dvec2> common_point(std::span<const glm::dvec3> p, std::span<const glm::dvec3> q);

/// Tests 1 and 2: do the extents along an axis overlap? Extents that touch do not.
ExtentTest extent_test(const pieces::Pieces& all, std::int32_t p, std::int32_t q, Axis axis);

/// Tests 3 and 4: where does a piece lie, seen from another's plane? The plane is turned so that its C > 0: the eye, at
/// z = -infinity, is on its negative side, and `before` the plane is where its values are negative. Values within the
/// tolerance, and what the piece is bent by, are on the plane: so parts of one facet are on each other's.
SideTest side_test(const pieces::Pieces& all, std::int32_t piece, std::int32_t plane_of, double tolerance);

/// Test 5: do the projections on (x, y) overlap?
OverlapTest overlap_test(const pieces::Pieces& all, std::int32_t p, std::int32_t q);

/// The tolerance of side tests for these pieces: 1e-12 of the largest coordinate, about 1e-9 where a picture is
/// 1,000 px wide. Some hundred times what rounding does to a corner, so a part never crosses the plane it was cut by;
/// far below the 1e-5 at which depths count as equal.
double tolerance_for(const pieces::Pieces& all);

}  // namespace zstep::depth_sort
