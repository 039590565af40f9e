// All polygons of the scene at once, as they lie on the raster: what methods work on that order, cut or sweep them.
//
// A piece is a facet after culling and clipping, or a part of one. It lives in the space of the raster, (x_s, y_s,
// depth), where the eye looks along the z axis from z = -infinity: pseudodepth keeps planes plane (001, "What z?";
// 003).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/scan_conversion/edge_table.hpp"
#include "algorithms/viewing/clip.hpp"
#include "algorithms/viewing/vertices.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of gathering all polygons, of cutting them, and of painting them.

#define ZSTEP_MODULE pieces
#define ZSTEP_FIRST_STEP 40
#define ZSTEP_STEPS "algorithms/pieces/steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE painting
#define ZSTEP_FIRST_STEP 48
#define ZSTEP_STEPS "algorithms/pieces/painting_steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE cutting
#define ZSTEP_FIRST_STEP 52
#define ZSTEP_STEPS "algorithms/pieces/cutting_steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::pieces {

// Planes: A x + B y + C z + D = 0.

struct Plane {
  double a = 0, b = 0, c = 0, d = 0;

  glm::dvec3 normal() const { return {a, b, c}; }
  /// Zero on the plane; its sign tells the side. A distance where the normal has length 1.
  double value(glm::dvec3 point) const { return a * point.x + b * point.y + c * point.z + d; }
  /// z of the plane above (x, y): -(A x + B y + D)/C. Not finite where the plane is seen edge-on (C = 0).
  double depth(double x, double y) const { return formulas::plane_depth(a, b, c, d, x, y); }
  Plane flipped() const { return {-a, -b, -c, -d}; }
};

/// The plane of a polygon: Newell's normal, of length 1, through the mean of its corners. All zero when the polygon
/// encloses no area. M. E. Newell, after Sutherland, Sproull and Schumacker, "A Characterization of Ten Hidden-Surface
/// Algorithms", 1974.
Plane plane_of(std::span<const glm::dvec3> corners);

/// The largest distance of a corner from the polygon's plane. Of polygons in files it is that of the last digit.
double bend_of(const Plane& plane, std::span<const glm::dvec3> corners);

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

  glm::dvec3 corner(std::int32_t vertex) const { return vertices[vertex].raster; }
  std::vector<glm::dvec3> corners(const clipping::Outline& outline) const;
  const Piece& operator[](std::int32_t number) const { return pieces[number]; }
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

// Cutting an outline by a plane: the geometry alone, for pieces on the raster and for pieces in the world.

struct Halves {
  clipping::Outline positive, negative;
};

/// Does an outline with corners at these distances go through the plane once each way, and touch it nowhere else? Any
/// convex one does that crosses it.
inline bool crosses_once(const std::vector<double>& distance) {
  int changes = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const double before = distance[i > 0 ? i - 1 : distance.size() - 1], here = distance[i];
    const double after = distance[i + 1 < distance.size() ? i + 1 : 0];
    if (here == 0 && !(before * after < 0)) return false;
    if (here == 0 || here * after < 0) ++changes;
  }
  return changes == 2;
}

/// The parts of an outline on the two sides of a plane. `own` is the outline's plane and `bend` how far from it its
/// corners lie. `corner(vertex)` is where a vertex lies; `make(from, to, t, point)` makes the vertex at which the edge
/// from -> to crosses, t of the way along, and returns its index. Values of the plane within `tolerance` count as on
/// it; such a vertex belongs to both parts.
///
/// Where an outline crosses the plane more than twice, what is on one side hangs together by edges along the cut. What
/// they enclose beside the outline cancels by the even-odd rule, but only if the ends of all of them lie on one line.
/// Where two planes are almost parallel, a corner within the tolerance, or one that is off its own plane, can be far
/// from that line. So there each corner is taken as it lies in its own plane, and no value but 0 is on the other one.
template <class Corner, class Make>
Halves split(const clipping::Outline& outline, const Plane& own, double bend, const Plane& plane, double tolerance,
             Corner&& corner, Make&& make) {
  const double cosine = glm::dot(own.normal(), plane.normal());
  std::vector<double> distance, exact;
  for (const std::int32_t vertex : outline) {
    const glm::dvec3 point = corner(vertex);
    const double value = plane.value(point);
    distance.push_back(std::abs(value) <= tolerance ? 0 : value);
    exact.push_back(value - cosine * own.value(point));
  }
  if (bend > tolerance || !crosses_once(distance)) distance = std::move(exact);
  Halves halves;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = i + 1 < outline.size() ? i + 1 : 0;
    if (distance[i] >= 0) halves.positive.push_back(outline[i]);
    if (distance[i] <= 0) halves.negative.push_back(outline[i]);
    if (!((distance[i] > 0 && distance[next] < 0) || (distance[i] < 0 && distance[next] > 0))) continue;

    const bool down = distance[i] > 0;  // from the positive end, so that neighbours cut at the same point
    const std::size_t from = down ? i : next, to = down ? next : i;
    const double t = formulas::where_zero(distance[from], distance[to]);
    const glm::dvec3 start = corner(outline[from]), end = corner(outline[to]);
    const std::int32_t made = make(outline[from], outline[to], t, formulas::part_of_way(start, end, t));
    halves.positive.push_back(made);
    halves.negative.push_back(made);
  }
  return halves;
}

}  // namespace zstep::pieces
