// The half-edge mesh of a scene: who is whose neighbour, for silhouettes and for walks over a surface.
#pragma once

#include <cstdint>
#include <span>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <glm/vec3.hpp>

#include "traces/scene.hpp"

namespace zstep {

struct MeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexTraits { std::int32_t point = 0; };  ///< index into Scene::points; several vertices may stand at one point
};
using HalfEdgeMesh = OpenMesh::PolyMesh_ArrayKernelT<MeshTraits>;

/// Face k is the k-th of the given faces, vertices of a face keep their order, and every face is there:
/// - a face that a half-edge mesh cannot hold beside the others (a third face at an edge, a neighbour that runs the
///   other way round, a repeated vertex) gets vertices of its own, so it is cut loose from its neighbours;
/// - where two surfaces touch at a point, each has a vertex of its own there;
/// - a face with fewer than three different corners cannot be a face at all: it is a triangle on its own with all
///   vertices at its first point (at the origin and with point -1 if it has no corner at all).
struct Mesh {
  HalfEdgeMesh half_edges;
  std::int64_t loose_faces = 0;     ///< faces that got vertices of their own
  std::int64_t boundary_edges = 0;  ///< edges with a face on one side only, those of loose faces left out
};

/// The mesh of these faces. Corners must be indices into points.
Mesh build_mesh(std::span<const glm::dvec3> points, std::span<const Facet> faces,
                std::span<const std::int32_t> corners);

/// The mesh of a scene; face k is facet k.
Mesh mesh_of(const Scene& scene);

}  // namespace zstep
