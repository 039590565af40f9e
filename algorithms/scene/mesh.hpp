// The half-edge mesh of a scene (who is whose neighbour), the colours of what brings none, and how large a mesh may be.
#pragma once

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "traces/scene.hpp"

namespace zstep::scene {

// Defaults of cameras; the limits of scenes are in traces/scene.hpp.

inline constexpr double default_d = 2;  ///< a field of view of 53 degrees with the default window of 1

// Colours: by name, from the palette, and shaded for surfaces that bring none.

/// Eight colours that people with any of the common kinds of colour blindness tell apart: M. Okabe and K. Ito, "Color
/// Universal Design", 2002 (2008), with a grey in place of their black, which is kept for lines and text.
inline constexpr std::array<Color, 8> palette{{{230, 159, 0},
                                               {86, 180, 233},
                                               {0, 158, 115},
                                               {240, 228, 66},
                                               {0, 114, 178},
                                               {213, 94, 0},
                                               {204, 121, 167},
                                               {153, 153, 153}}};

/// A colour as scene files write it: "#rrggbb", "#rgb" or a name. Nothing if it is neither.
std::optional<Color> color_from_text(std::string_view text);

struct NamedColor {
  std::string_view name;
  Color color;
};
std::span<const NamedColor> named_colors();

/// What a surface without colours is made of.
inline constexpr Color clay{176, 196, 214};

/// The colour of a flat surface under a light that is fixed in the world, so that turning the camera does not change
/// it: brightness (1 + n·l)/2 (Valve's "half Lambert"), so that sides in the shade still differ. `normal` need not be
/// of unit length; of length zero, the surface counts as seen sideways.
Color shaded(Color base, glm::dvec3 normal);

}  // namespace zstep::scene

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
