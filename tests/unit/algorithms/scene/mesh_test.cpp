// The half-edge mesh.
#include <doctest/doctest.h>

#include <vector>

#include "algorithms/scene/built_in/built_in.hpp"
#include "algorithms/scene/mesh.hpp"

using namespace zstep;
using zstep::scene::PolygonSoup;

namespace {

Mesh mesh_of_rings(const std::vector<glm::dvec3>& points, const std::vector<std::vector<std::int32_t>>& rings) {
  std::vector<Facet> faces;
  std::vector<std::int32_t> corners;
  for (const auto& ring : rings) {
    faces.push_back({static_cast<std::int32_t>(faces.size()), static_cast<std::int32_t>(corners.size()),
                     static_cast<std::int32_t>(ring.size())});
    corners.insert(corners.end(), ring.begin(), ring.end());
  }
  return build_mesh(points, faces, corners);
}

const std::vector<glm::dvec3> five{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};

/// The points of face k, in its order, beginning anywhere.
bool has_ring(const Mesh& mesh, int face, std::vector<std::int32_t> ring) {
  std::vector<std::int32_t> own;
  for (const auto vertex : mesh.half_edges.fv_range(OpenMesh::FaceHandle(face)))
    own.push_back(mesh.half_edges.data(vertex).point);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (own == ring) return true;
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
  return own == ring;
}

}  // namespace

TEST_SUITE("half-edge mesh") {
  TEST_CASE("a closed surface has no boundary, and its faces keep their order") {
    const Mesh mesh = mesh_of_rings(five, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
    CHECK(mesh.half_edges.n_faces() == 4);
    CHECK(mesh.half_edges.n_edges() == 6);
    CHECK(mesh.boundary_edges == 0);
    CHECK(mesh.loose_faces == 0);
    CHECK(has_ring(mesh, 1, {0, 1, 3}));
    CHECK(mesh.half_edges.point(OpenMesh::VertexHandle(4)) == OpenMesh::Vec3d(1, 1, 1));
  }

  TEST_CASE("a third face at an edge, a neighbour that runs against, a repeated corner: loose faces") {
    const Mesh third = mesh_of_rings(five, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    CHECK(third.half_edges.n_faces() == 3);
    CHECK(third.loose_faces == 1);
    CHECK(third.boundary_edges == 4);
    CHECK(has_ring(third, 2, {0, 1, 4}));
    const Mesh against = mesh_of_rings(five, {{0, 1, 2}, {0, 1, 3}});
    CHECK(against.loose_faces == 1);
    CHECK(has_ring(against, 1, {0, 1, 3}));
    const Mesh repeated = mesh_of_rings(five, {{0, 1, 2, 0, 3}, {0, 0, 1}, {2, 3}, {}, {4}});
    CHECK(repeated.half_edges.n_faces() == 5);
    CHECK(repeated.loose_faces == 5);
    CHECK(repeated.boundary_edges == 0);
    CHECK(has_ring(repeated, 0, {0, 1, 2, 0, 3}));
  }

  TEST_CASE("faces without corners, even where there are no points") {
    const Mesh mesh = mesh_of_rings({}, {{}, {}});
    CHECK(mesh.half_edges.n_faces() == 2);
    CHECK(mesh.loose_faces == 2);
    CHECK(mesh.boundary_edges == 0);
  }

  TEST_CASE("two cones that touch at their tips keep all their faces") {
    const Mesh mesh = mesh_of_rings({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 0, -1}, {0, 1, -1}}, {{0, 1, 2}, {0, 3, 4}});
    CHECK(mesh.half_edges.n_faces() == 2);
    CHECK(has_ring(mesh, 0, {0, 1, 2}));
    CHECK(has_ring(mesh, 1, {0, 3, 4}));
  }

  TEST_CASE("two closed surfaces that touch at a point stay whole") {
    const Mesh mesh =
        mesh_of_rings({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}});
    CHECK(mesh.loose_faces == 0);
    CHECK(mesh.boundary_edges == 0);
    CHECK(mesh.half_edges.n_vertices() == 8);
    CHECK(mesh.half_edges.n_edges() == 12);
    CHECK(has_ring(mesh, 4, {0, 4, 5}));
  }

  TEST_CASE("the built-in solids are closed, and Euler's formula holds for them") {
    for (const char* name : {"cube", "pyramid", "dodecahedron"}) {
      const auto soup = scene::built_in_mesh(name);
      REQUIRE(soup);
      const Mesh mesh = build_mesh(soup->points, soup->outlines, soup->corners);
      CHECK(mesh.loose_faces == 0);
      CHECK(mesh.boundary_edges == 0);
      CHECK(mesh.half_edges.n_vertices() + mesh.half_edges.n_faces() - mesh.half_edges.n_edges() == 2);
    }
  }

  TEST_CASE("a hundred thousand triangles round one point do not take for ever") {
    std::vector<glm::dvec3> points{{0, 0, 1}};
    std::vector<std::vector<std::int32_t>> rings;
    for (int i = 0; i < 100000; ++i) {
      points.push_back({i, 0, 0});
      points.push_back({i, 1, 0});
      rings.push_back({0, 2 * i + 1, 2 * i + 2});
    }
    const Mesh mesh = mesh_of_rings(points, rings);
    CHECK(mesh.half_edges.n_faces() == 100000);
    CHECK(has_ring(mesh, 99999, {0, 199999, 200000}));
  }
}
