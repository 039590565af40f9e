// Ray casting in a hurry: for whoever wants the picture and no trace.
//
// ray_casting.cpp is the method, and the place to read it. Here a ray is held against eight boxes and four triangles at
// once. Boxes are in single precision and rounded outwards; what is hit, and where, is found in double precision, with
// planes and barycentric coordinates reckoned beforehand. Pictures agree with the taught method's up to rounding: a
// pixel's centre within 1e-9 of an edge may fall to either side.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "traces/scene.hpp"

namespace zstep::ray_casting {

// The hierarchy of boxes behind cast_fast: eight boxes a node, four triangles a leaf.
//
// J. Goldsmith, J. Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE Computer Graphics and
// Applications 7(5), 1987, for the cost by surface area; I. Wald, "On fast Construction of SAH-based Bounding Volume
// Hierarchies", IEEE Symposium on Interactive Ray Tracing, 2007, for bins; H. Dammertz, J. Hanika, A. Keller, "Shallow
// Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent Rays", Computer Graphics Forum 27(4), 2008, for
// wide nodes.

/// Four triangles of facets: n·p + n_0 is 0 on the facet's plane, and u·p + u_0, v·p + v_0 are barycentric coordinates
/// of a point p there.
struct alignas(64) Packet {
  double n[3][4], n_0[4], u[3][4], u_0[4], v[3][4], v_0[4];
  std::int32_t facet[4];  ///< index in Scene::facets
};

inline constexpr std::size_t children = 8;  ///< of a node

/// Boxes around the nodes and packets below, rounded outwards.
struct alignas(64) Node {
  float low[3][children], high[3][children];
  std::int32_t child[children];  ///< a node; ~child is a packet
};

/// In the world.
struct Tree {
  std::vector<Node> nodes;  ///< nodes[0] is the root
  std::vector<Packet> packets;
  std::vector<glm::dvec3> corners;         ///< of the facets, one facet after the other
  std::vector<std::int32_t> first_corner;  ///< by facet; one more at the end
};

/// All facets that have an area.
Tree build_tree(const Scene& scene);

/// One ray a pixel, from the eye through its centre. Of equal depths the facet drawn first is seen.
Picture cast_fast(const Scene& scene, const Conventions& conventions);

/// The same with a tree that was built before, of this scene.
Picture cast_fast(const Tree& tree, const Scene& scene, const Conventions& conventions);

}  // namespace zstep::ray_casting
