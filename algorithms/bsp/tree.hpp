// A binary space partition: polygons of the world, cut by each other's planes so that every half-space can be drawn
// before or after the other one.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/pieces/pieces.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/events/vocabulary.hpp"

namespace zstep::bsp {

/// A facet of the scene, or a part of one.
struct Piece {
  std::int32_t polygon = 0, facet = 0;
  clipping::Outline outline;  ///< indices into Tree::points
  pieces::Plane plane;        ///< its normal points out of the facet's front
  double bend = 0;            ///< how far from it the facet's corners lie
};

struct Node {
  pieces::Plane plane;
  std::vector<std::int32_t> pieces;  ///< all that lie in the plane, in the order of the file
  std::int32_t front = -1, back = -1;
  std::int32_t nodes = 1;  ///< of the whole subtree, this one included
};

struct Tree {
  std::vector<glm::dvec3> points;  ///< the scene's, then those that cutting made
  std::vector<Piece> pieces;
  std::vector<Node> nodes;  ///< node 0 is the root; empty for a scene without polygons
  double tolerance = 0;     ///< values of a plane within this count as on it

  const Piece& piece(std::int32_t number) const { return pieces[number]; }
  const Node& node(std::int32_t number) const { return nodes[number]; }
  glm::dvec3 point(std::int32_t vertex) const { return points[vertex]; }
};

}  // namespace zstep::bsp
