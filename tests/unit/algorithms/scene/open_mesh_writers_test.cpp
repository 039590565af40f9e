// What OpenMesh's own writers write, zstep's readers read.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // in OpenMesh's vectors of colours, which have no initial value
#endif

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

// OpenMesh registers its formats in static objects of this header.
#include <OpenMesh/Core/IO/MeshIO.hh>

#include "algorithms/scene/built_in/built_in.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/mesh.hpp"
#include "tests/folder.hpp"

using namespace zstep;
using namespace zstep::scene;

namespace {

struct ColorTraits : MeshTraits {
  using Color = OpenMesh::Vec3uc;
};
using ColoredMesh = OpenMesh::PolyMesh_ArrayKernelT<ColorTraits>;

ColoredMesh colored(const PolygonSoup& soup) {
  ColoredMesh mesh;
  mesh.request_face_colors();
  std::vector<ColoredMesh::VertexHandle> vertices, face;
  for (const glm::dvec3& p : soup.points) vertices.push_back(mesh.add_vertex({p.x, p.y, p.z}));
  for (const Facet& outline : soup.outlines) {
    face.clear();
    for (const std::int32_t corner : soup.corners_of(outline))
      face.push_back(vertices[static_cast<std::size_t>(corner)]);
    const auto k = static_cast<unsigned char>(outline.polygon);
    mesh.set_color(mesh.add_face(face), {static_cast<unsigned char>(k * 5), 200, static_cast<unsigned char>(255 - k)});
  }
  return mesh;
}

/// Corner for corner the same, each outline beginning anywhere; coordinates as exact as OpenMesh prints them.
void check_same(const PolygonSoup& soup, const PolygonSoup& original, double tolerance) {
  REQUIRE(soup.outlines.size() == original.outlines.size());
  for (std::size_t k = 0; k < soup.outlines.size(); ++k) {
    const auto a = soup.corners_of(soup.outlines[k]), b = original.corners_of(original.outlines[k]);
    REQUIRE(a.size() == b.size());
    bool same = false;
    for (std::size_t shift = 0; shift < a.size() && !same; ++shift) {
      same = true;
      for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 p = soup.points[static_cast<std::size_t>(a[(i + shift) % a.size()])];
        const glm::dvec3 q = original.points[static_cast<std::size_t>(b[i])];
        for (int axis = 0; axis < 3; ++axis) same = same && std::abs(p[axis] - q[axis]) <= tolerance;
      }
    }
    CHECK_MESSAGE(same, "polygon ", k);
  }
}

}  // namespace

TEST_SUITE("mesh readers against OpenMesh's writers") {
  TEST_CASE("OBJ, OFF, PLY and STL, ascii and binary") {
    using Options = OpenMesh::IO::Options;
    const test::Folder folder;
    omlog().disable();  // its writers announce themselves
    struct Way {
      const char* file;
      Options::Flag flags;
      bool polygons;
      bool colors;
    };
    const Way ways[] = {{"m.obj", Options::Default, true, false},  {"c.off", Options::FaceColor, true, true},
                        {"m.off", Options::Default, true, false},  {"m.ply", Options::Default, true, false},
                        {"c.ply", Options::FaceColor, true, true}, {"b.ply", Options::Binary, true, false},
                        {"m.stl", Options::Default, false, false}, {"b.stl", Options::Binary, false, false}};
    for (const char* name : {"cube", "dodecahedron", "pyramid", "tetrahedra"}) {
      PolygonSoup original;
      if (std::string(name) == "tetrahedra") {  // triangles only, for STL
        original.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.3}};
        for (const auto& ring : std::vector<std::vector<int>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
          for (const int corner : ring) original.add_corner(corner, [] { return "test"; });
          original.close_outline(0, std::nullopt, [] { return "test"; });
        }
      } else {
        original = *built_in_mesh(name);
      }
      const ColoredMesh mesh = colored(original);
      for (const Way& way : ways) {
        if (!way.polygons && std::string(name) != "tetrahedra") continue;
        CAPTURE(name);
        CAPTURE(way.file);
        const std::filesystem::path path = folder / way.file;
        REQUIRE(OpenMesh::IO::write_mesh(mesh, path.string(), Options(way.flags), 10));
        const PolygonSoup soup = read_mesh(path);
        check_same(soup, original, 1e-6);
        if (way.colors) {
          REQUIRE(soup.colors.size() == soup.outlines.size());
          CHECK(soup.colors[2] == Color{10, 200, 253});
        }
      }
    }
  }
}
