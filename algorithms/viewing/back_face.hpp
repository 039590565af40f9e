// Which side of a facet the eye sees: the test of the notes in its four formulations.
//
// A facet's corners run counter-clockwise as seen from its front. The notes draw V, the vector between eye and polygon,
// now this way and now that way, and count in left-handed or right-handed coordinates, so their signs differ; here they
// agree: determinant and plane_at_eye are negative, view_dot_normal and projected_normal_z positive, when the
// facet faces away.
//
// The three in space are one number but for sign and rounding, and decide the same; the one after projection has the
// same sign. The verdict is view_dot_normal's.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/viewing/vertices.hpp"

namespace zstep::clipping {

using Corners = std::span<const std::int32_t>;

/// The vector area, twice: a normal for any polygon, concave and not quite planar ones included (M. E. Newell; in
/// Sutherland, Sproull and Schumacker, "A Characterization of Ten Hidden-Surface Algorithms", ACM Computing Surveys
/// 6(1), 1974). World, right-handed.
glm::dvec3 newell_normal(const Scene& scene, Corners corners);

/// 000: the determinant |V0 V1 V2| = V0 · (V1 × V2) of view coordinates, which are left-handed; negative faces away.
/// Three consecutive vertices of a concave polygon can turn the wrong way, so all pairs are summed: V0 · Σ(Vi × Vi+1).
/// Orthographic: every line of sight is (0, 0, 1), so that stands in for V0.
double determinant(const Scene& scene, Corners corners, const viewing::Vertices& vertices);

/// 001: the eye put into the polygon's plane equation, A·eye_x + B·eye_y + C·eye_z + D; negative faces away.
/// Orthographic: the eye is the point at infinity (eye, 0), so D drops out.
double plane_at_eye(const Scene& scene, Corners corners);

/// 002, 003: (p − e) · n; positive faces away. (004 takes V from the face to the viewer, e − p, and the other sign.)
/// Orthographic: p − e becomes the direction away from the eye.
double view_dot_normal(const Scene& scene, Corners corners);

/// 001: z of the normal after projection, z pointing into the picture; positive faces away. NaN with a corner before
/// the near plane, which has no projection: this formulation alone must come after clipping.
double projected_normal_z(const Scene& scene, Corners corners, const viewing::Vertices& vertices);

/// A facet that covers no area: fewer than three corners, zero area, or a corner that is not a finite number.
bool degenerate(const Scene& scene, Corners corners);

/// Makes the test and records it.
template <Recorder R>
Facing test_facing(const Scene& scene, Corners corners, const viewing::Vertices& vertices, R& record);

}  // namespace zstep::clipping
