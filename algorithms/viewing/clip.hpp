// What is left of a facet to draw: back faces dropped, the rest clipped against the view volume.
//
// I. E. Sutherland and G. W. Hodgman, "Reentrant Polygon Clipping", Communications of the ACM 17(1), 1974; before the
// perspective division, so that polygons around and behind the eye are cut right: J. F. Blinn and M. E. Newell,
// "Clipping Using Homogeneous Coordinates", SIGGRAPH 1978.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/viewing/back_face.hpp"
#include "algorithms/viewing/vertices.hpp"

namespace zstep::clipping {

/// The vertices of a facet as it is drawn, in order: indices into Vertices.
using Outline = std::vector<std::int32_t>;

/// Finds the outline of a facet, all its vertices on the raster. False when nothing of it is to be drawn, for the
/// reason recorded. New vertices are put behind the scene's points, replacing those of the facet before.
///
/// A concave polygon cut in pieces comes out as one outline whose pieces hang together by edges along the plane; they
/// have no area, and filling by the even-odd rule leaves no trace of them.
///
/// Screen scenes are neither culled nor clipped: scan conversion keeps to the raster by itself.
template <Recorder R>
bool find_outline(const Scene& scene, const Facet& facet, bool cull, const viewing::Lens& lens,
                  viewing::Vertices& vertices, Outline& outline, R& record);

/// The second half of it: clips an outline of a polygon whose facing is known. Its vertices have view coordinates
/// and outcodes, and are on the raster unless they lie before the near plane.
template <Recorder R>
bool clip_outline(std::int32_t polygon, Camera::Kind kind, const viewing::Lens& lens, viewing::Vertices& vertices,
                  Outline& outline, R& record);

}  // namespace zstep::clipping
