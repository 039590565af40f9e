// All polygons of the scene at once, as they lie on the raster: what methods work on that order, cut or sweep them.
//
// A piece is a facet after culling and clipping, or a part of one. It lives in the space of the raster, (x_s, y_s,
// depth), where the eye looks along the z axis from z = -infinity: pseudodepth keeps planes plane (001, "What z?";
// 003).
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/pieces/plane.hpp"
#include "algorithms/pieces/steps.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::pieces {

struct Piece {
  std::int32_t polygon = 0;
  std::int32_t parent = -1;    ///< the piece it was cut from
  clipping::Outline outline;   ///< indices into Pieces::vertices
  Plane plane;                 ///< in raster space; its normal may point either way
  glm::dvec3 low{0}, high{0};  ///< its extents
  std::int32_t facet = -1;     ///< the facet that it is, or is a part of
  double bend = 0;             ///< of that facet: how far from its plane its corners lie
};

struct Pieces {
  viewing::Vertices vertices;  ///< the scene's points, then what clipping and cutting made
  std::vector<Piece> pieces;   ///< a piece's place here is its number

  glm::dvec3 corner(std::int32_t vertex) const { return vertices[static_cast<std::size_t>(vertex)].raster; }
  std::vector<glm::dvec3> corners(const clipping::Outline& outline) const;
  const Piece& operator[](std::int32_t number) const { return pieces[static_cast<std::size_t>(number)]; }
};

/// Views, culls and clips every facet. What is left of each is a piece, in the order of the facets; a facet that is
/// edge-on to the eye covers no pixel and has none. Planes are planes on the raster only as long as conventions.depth
/// is pseudodepth; z_v is for methods that interpolate.
template <Recorder R>
Pieces gather(const Scene& scene, const Conventions& conventions, R& record);

/// Cuts a piece by a plane into the part on the plane's positive side and the one on its negative side, and returns
/// their numbers (the positive one first). New vertices are computed from the end on the positive side. Values of the
/// plane within `tolerance` count as on it. To be called for pieces that cross the plane: both parts have corners off
/// it.
struct Parts {
  std::int32_t positive, negative;
};
template <Recorder R>
Parts cut(Pieces& all, std::int32_t number, const Plane& plane, double tolerance, R& record);

/// Fills a piece by scan conversion, over whatever is there.
template <Recorder R>
void paint(const Pieces& all, const clipping::Outline& outline, std::int32_t polygon, const Scene& scene,
           Picture& picture, R& record);
/// The same for an outline that is not among such pieces.
template <Recorder R>
void paint(const viewing::Vertices& vertices, const clipping::Outline& outline, std::int32_t polygon,
           const Raster& raster, Picture& picture, R& record);

}  // namespace zstep::pieces
