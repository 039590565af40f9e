// What a trace's scene and conventions tell of its events before any of them is read: where each vertex goes.
//
// The formulas are those of docs/trace-format.md, "Guesses", evaluated in float64 in the order given there. They are
// part of the file format: a method that computes otherwise makes larger files, and no others.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "traces/events/polygons.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/samples.hpp"
#include "traces/scene.hpp"

namespace zstep::codec {

/// A vertex from the world to the raster.
struct VertexGeometry {
  std::int32_t vertex = -1;
  glm::dvec3 view{0};        ///< (x_v, y_v, z_v)
  glm::dvec3 plane{0};       ///< (x_p, y_p, depth)
  glm::dvec2 raster{0};      ///< (x_s, y_s)
  std::int32_t outside = 0;  ///< bit k: it is outside plane k (near, far, left, right, bottom, top)
};

/// A x + B y + C z + D = 0, the normal of length 1; all zero where a facet has none.
struct FacetPlane {
  std::int32_t facet = -1;
  glm::dvec3 normal{0};
  double d = 0;
};

/// The depth of a plane on the raster at (x, y).
inline double depth_of(const FacetPlane& plane, double x, double y) {
  return formulas::plane_depth(plane.normal.x, plane.normal.y, plane.normal.z, plane.d, x, y);
}

using formulas::row_from;

/// An edge on the raster, (x_s, y_s, depth), from its end with the smaller y.
struct EdgeLine {
  glm::dvec3 start{0}, end{0};

  /// x = x_0 + (x_1 - x_0)(y - y_0)/(y_1 - y_0), and z likewise.
  double x_at(std::int32_t row) const { return formulas::on_line<double>(start.x, end.x, row, start.y, end.y); }
  double z_at(std::int32_t row) const { return formulas::on_line<double>(start.z, end.z, row, start.y, end.y); }
};

/// An edge of a table of all pieces' edges.
struct TableEdge : EdgeLine {
  std::int32_t edge = -1, piece = -1;
};

/// A piece's sides on the raster, (x_s, y_s); of those with few corners.
struct PieceSides {
  static constexpr std::size_t most = 4;
  std::int32_t piece = -1;
  std::uint32_t count = 0;  ///< 0 where it has more
  std::array<formulas::Segment, most> sides{};
};

/// From where to where a piece goes on the raster, (x_s, y_s, depth); with nothing else in its line of memory.
struct alignas(64) PieceExtent {
  std::int32_t piece = -1;
  glm::dvec3 low{0}, high{0};
};

class SceneGeometry {
 public:
  /// The scene must live as long as this does.
  SceneGeometry(const Scene& scene, const Header& header);

  const Scene& scene() const { return *scene_; }
  bool increments() const { return increments_; }
  bool inclusive() const { return inclusive_; }
  /// Are edge functions added to from pixel to pixel?
  bool steps_edges() const { return steps_edges_; }
  /// Of the pixels, and how far from their centres they are looked at.
  std::span<const formulas::SampleOffset> samples() const { return samples_; }
  double reach() const { return reach_; }
  /// False for scenes whose points stand on the raster already.
  bool viewed() const { return viewed_; }

  bool is_point(std::int32_t vertex) const { return vertex >= 0 && vertex < std::ssize(scene_->points); }
  /// Of one of the scene's points.
  const VertexGeometry& of_point(std::int32_t vertex) const {
    VertexGeometry& facts = points_.at(vertex);
    if (facts.vertex != vertex) find_out(vertex, facts);
    return facts;
  }

  /// A vertex that a run made, from its view coordinates.
  VertexGeometry from_view(std::int32_t vertex, glm::dvec3 view) const;
  glm::dvec3 project(glm::dvec3 view) const;
  glm::dvec2 to_viewport(double x_p, double y_p) const;

  /// The corners of a facet, indices into the scene's points; none for a facet that does not exist.
  std::span<const std::int32_t> corners(std::int32_t facet) const;
  /// The plane of a facet in the world: Newell's normal, through the mean of its corners.
  const FacetPlane& plane(std::int32_t facet) const;
  /// The same as BSP trees compute it: the corners divided by their number before they are added.
  FacetPlane plane_by_parts(std::int32_t facet) const;
  /// Of a piece of a method that keeps all pieces in a table, if it numbers the facets that are neither turned away nor
  /// out of view in their order: its plane on the raster, (x_s, y_s, depth), with the corners divided by their number
  /// before they are added, and its extents there; nullptr where there are not so many.
  const FacetPlane* plane_of_piece(std::int32_t piece) const {
    FacetPlane& plane = piece_planes_.at(piece);
    return piece >= 0 && (plane.facet == piece || find_out(piece, plane)) ? &plane : nullptr;
  }
  const PieceExtent* extent_of_piece(std::int32_t piece) const {
    PieceExtent& extent = piece_extents_.at(piece);
    return piece >= 0 && (extent.piece == piece || find_out(piece, extent)) ? &extent : nullptr;
  }
  const PieceSides* sides_of_piece(std::int32_t piece) const {
    PieceSides& sides = piece_sides_.at(piece);
    return piece >= 0 && (sides.piece == piece || find_out(piece, sides)) && sides.count > 0 ? &sides : nullptr;
  }
  /// The piece that comes after this one when they are ordered by their greatest depths, the farthest first, and of
  /// equal ones the later polygon and the later piece; -1 where that is not known.
  std::int32_t next_by_depth(std::int32_t piece) const;
  /// Of a table that has the edges of all these pieces in their order, as far as they meet a row; nullptr where there
  /// are not so many, or no such table, as the trace crosses no edges by their numbers.
  const TableEdge* edge_of_table(std::int32_t edge) const {
    TableEdge& known = table_edges_.at(edge);
    return one_table_ && edge >= 0 && (known.edge == edge || find_out(edge, known)) ? &known : nullptr;
  }
  /// How near to a plane a point lies on it, in a BSP tree of the scene: 1e-9 of the diagonal of the box around the
  /// points, and 1e-14 of the farthest coordinate.
  double tolerance() const;

 private:
  std::int32_t outcode(glm::dvec3 view) const;
  static constexpr std::size_t clip_planes = 6;
  double distance_inside(glm::dvec3 view, std::size_t plane) const;  ///< of the view volume
  /// Which planes some of the corners lie outside, and which all of them.
  struct Outside {
    std::int32_t some, all;
  };
  Outside outside_of(std::span<const std::int32_t> outline) const;
  /// What clipping leaves of an outline, in view coordinates.
  std::vector<glm::dvec3> clipped(std::span<const std::int32_t> outline, std::int32_t outside_some) const;
  bool in_view(std::span<const std::int32_t> outline) const;  ///< something of it is left by clipping
  void number_pieces() const;
  /// The corners of the facet that is this piece; none where there are not so many.
  std::span<const std::int32_t> corners_of_piece(std::int32_t piece) const;
  auto points_of(std::span<const std::int32_t> corners) const {
    return [this, corners](std::size_t i) { return scene_->points[corners[i]]; };
  }
  /// What clipping leaves of it, (x_s, y_s, depth); until the next is asked for.
  std::span<const glm::dvec3> raster_outline(std::int32_t piece) const;
  /// Calls each(edge) for the edges of a piece that meet a row.
  template <class Each>
  void for_each_edge(std::int32_t piece, Each&& each) const;

  const Scene* scene_;
  std::span<const formulas::SampleOffset> samples_;
  double reach_;
  bool increments_, inclusive_, steps_edges_, cull_, viewed_, orthographic_, view_depth_, one_table_;
  double d_, window_x_, window_y_, near_, far_, a_, b_, width_, height_;
  void find_out(std::int32_t vertex, VertexGeometry& facts) const;
  /// False where there are not so many pieces.
  bool find_out(std::int32_t piece, FacetPlane& plane) const;
  bool find_out(std::int32_t piece, PieceExtent& extent) const;
  bool find_out(std::int32_t piece, PieceSides& sides) const;
  bool find_out(std::int32_t edge, TableEdge& known) const;

  /// The last that were asked for, each in the place its number says; what they are depends on the scene alone.
  template <class Fact, std::size_t Size>
  class AtHand {
   public:
    Fact& at(std::int32_t number) {
      if (facts_ == nullptr) facts_ = std::make_unique<Fact[]>(Size);
      return facts_[static_cast<std::uint32_t>(number) % Size];
    }

   private:
    std::unique_ptr<Fact[]> facts_;
  };
  mutable AtHand<VertexGeometry, 2048> points_;
  mutable AtHand<FacetPlane, 16384> facet_planes_, piece_planes_;
  mutable AtHand<PieceExtent, 16384> piece_extents_;
  mutable AtHand<PieceSides, 8192> piece_sides_;
  mutable AtHand<TableEdge, 8192> table_edges_;
  mutable std::vector<glm::dvec3> outline_;
  mutable std::vector<std::int32_t> facets_of_pieces_;
  mutable std::vector<std::int32_t> first_edges_;  ///< in the table, of each piece
  mutable std::vector<std::int32_t> next_by_depth_;
  mutable bool numbered_ = false;
  mutable double tolerance_ = -1;  ///< once asked for
};

}  // namespace zstep::codec
