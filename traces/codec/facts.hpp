// What a trace's scene and conventions tell of its events before any of them is read: where each vertex goes.
//
// The formulas are those of docs/trace-format.md, "Guesses", evaluated in float64 in the order given there. They are part of the file
// format: a method that computes otherwise makes larger files, and no others.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "traces/events/polygons.hpp"
#include "traces/scene.hpp"

namespace zstep::codec {

/// A vertex from the world to the raster.
struct VertexFacts {
  std::int32_t vertex = -1;
  glm::dvec3 view{0};    ///< (x_v, y_v, z_v)
  glm::dvec3 plane{0};   ///< (x_p, y_p, depth)
  glm::dvec2 raster{0};  ///< (x_s, y_s)
  std::int32_t outside = 0;  ///< bit k: it is outside plane k (near, far, left, right, bottom, top)
};

/// A x + B y + C z + D = 0, the normal of length 1; all zero where a facet has none.
struct FacetPlane {
  std::int32_t facet = -1;
  glm::dvec3 normal{0};
  double d = 0;
};

/// What a piece is on the raster, (x_s, y_s, depth), that is a whole facet: its plane, the corners divided by their number before they are
/// added, and its extents.
struct RasterPiece {
  std::int32_t piece = -1;
  FacetPlane plane;
  glm::dvec3 low{0}, high{0};
};

class Facts {
 public:
  /// The scene must live as long as this does.
  Facts(const Scene& scene, const Conventions& conventions);

  const Scene& scene() const { return *scene_; }
  bool increments() const { return increments_; }
  bool inclusive() const { return inclusive_; }
  /// False for scenes whose points stand on the raster already.
  bool viewed() const { return viewed_; }

  bool is_point(std::int32_t vertex) const { return vertex >= 0 && static_cast<std::size_t>(vertex) < scene_->points.size(); }
  /// Of one of the scene's points.
  const VertexFacts& of_point(std::int32_t vertex) const;

  /// A vertex that a run made, from its viewing coordinates.
  VertexFacts from_view(std::int32_t vertex, glm::dvec3 view) const;
  glm::dvec3 project(glm::dvec3 view) const;
  glm::dvec2 to_viewport(double x_p, double y_p) const;

  /// The corners of a facet, indices into the scene's points; none for a facet that does not exist.
  std::span<const std::int32_t> corners(std::int32_t facet) const;
  /// The plane of a facet in the world: Newell's normal, through the mean of its corners.
  const FacetPlane& plane(std::int32_t facet) const;
  /// The same as BSP trees compute it: the corners divided by their number before they are added.
  FacetPlane plane_by_parts(std::int32_t facet) const;
  /// A piece of a method that keeps all pieces in a table, if it numbers the facets that are neither turned away nor out of view in their
  /// order; nullptr where there are not so many.
  const RasterPiece* piece(std::int32_t number) const;
  /// How near to a plane a point lies on it, in a BSP tree of the scene: 1e-9 of the diagonal of the box around the points, and 1e-14 of
  /// the farthest coordinate.
  double tolerance() const;

 private:
  std::int32_t outcode(glm::dvec3 view) const;
  std::array<double, 6> distances_inside(glm::dvec3 view) const;  ///< of the six planes of the view volume
  bool in_view(std::span<const std::int32_t> outline) const;      ///< something of it is left by clipping
  void number_pieces() const;

  const Scene* scene_;
  bool increments_, inclusive_, cull_, viewed_, orthographic_, view_depth_;
  double d_, window_x_, window_y_, near_, far_, a_, b_, width_, height_;
  // The last that were asked for, each in the place its number says; what they are depends on the scene alone.
  mutable std::vector<VertexFacts> at_hand_;
  mutable std::vector<FacetPlane> planes_at_hand_;
  mutable std::vector<std::int32_t> facets_of_pieces_;
  mutable bool numbered_ = false;
  mutable std::vector<RasterPiece> pieces_at_hand_;
  mutable double tolerance_ = -1;  ///< once asked for
};

}  // namespace zstep::codec
