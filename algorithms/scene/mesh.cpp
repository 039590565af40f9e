#include "algorithms/scene/mesh.hpp"

#include <algorithm>
#include <vector>

namespace zstep {

namespace {

/// OpenMesh reports every refused face on its error stream; the count in Mesh says it once.
class SilentOpenMesh {
 public:
  SilentOpenMesh() : was_enabled_(omerr().is_enabled()) { omerr().disable(); }
  ~SilentOpenMesh() {
    if (was_enabled_) omerr().enable();
  }
  SilentOpenMesh(const SilentOpenMesh&) = delete;
  SilentOpenMesh& operator=(const SilentOpenMesh&) = delete;

 private:
  bool was_enabled_;
};

class Builder {
 public:
  Builder(std::span<const glm::dvec3> points, std::size_t faces, std::size_t corners)
      : points_(points), vertex_of_point_(points.size()), valence_(points.size(), 0), mark_(points.size(), -1) {
    mesh_.half_edges.reserve(points.size(), std::min(corners, std::size_t{1} << 22), faces);
    for (std::size_t i = 0; i < points.size(); ++i) vertex_of_point_[i] = add_vertex(static_cast<std::int32_t>(i));
  }

  void add(std::span<const std::int32_t> corners) {
    const auto face_number = static_cast<std::int32_t>(mesh_.half_edges.n_faces());
    face_.clear();
    bool repeats = false;
    for (const std::int32_t point : corners) {
      const auto p = static_cast<std::size_t>(point);
      repeats = repeats || mark_[p] == face_number;
      mark_[p] = face_number;
      // Where faces stand all round the point already, another surface touches it: that one has a vertex of its own
      // there.
      if (!mesh_.half_edges.is_boundary(vertex_of_point_[p])) vertex_of_point_[p] = add_vertex(point);
      face_.push_back(vertex_of_point_[p]);
    }
    if (!repeats && corners.size() >= 3 && affordable(corners) && mesh_.half_edges.add_face(face_).is_valid()) return;
    add_loose(corners);
  }

  Mesh finish() {
    for (const auto edge : mesh_.half_edges.edges())
      if (mesh_.half_edges.is_boundary(edge)) ++mesh_.boundary_edges;
    mesh_.boundary_edges -= loose_edges_;
    return std::move(mesh_);
  }

 private:
  HalfEdgeMesh::VertexHandle add_vertex(std::int32_t point) {
    const glm::dvec3 p = point < 0 ? glm::dvec3(0) : points_[static_cast<std::size_t>(point)];
    const auto vertex = mesh_.half_edges.add_vertex(HalfEdgeMesh::Point(p.x, p.y, p.z));
    mesh_.half_edges.data(vertex).point = point;
    return vertex;
  }

  void add_loose(std::span<const std::int32_t> corners) {
    face_.clear();
    for (const std::int32_t point : corners) face_.push_back(add_vertex(point));
    while (face_.size() < 3) face_.push_back(add_vertex(corners.empty() ? -1 : corners.front()));
    mesh_.half_edges.add_face(face_);
    ++mesh_.loose_faces;
    loose_edges_ += static_cast<std::int64_t>(face_.size());
  }

  // To add a face OpenMesh walks round each of its vertices. A file of millions of triangles at one point would keep it
  // walking for hours, so there is a budget of steps; once it is spent, faces at crowded points are loose ones.
  bool affordable(std::span<const std::int32_t> corners) {
    constexpr std::int64_t budget = 100'000'000;
    constexpr std::int32_t crowded = 32;
    std::int32_t most = 0;
    for (const std::int32_t point : corners) {
      std::int32_t& valence = valence_[static_cast<std::size_t>(point)];
      if (steps_ > budget && valence > crowded) return false;
      most = std::max(most, ++valence);
      if (valence > crowded) steps_ += valence;
    }
    return true;
  }

  std::span<const glm::dvec3> points_;
  std::vector<HalfEdgeMesh::VertexHandle> vertex_of_point_;
  std::vector<std::int32_t> valence_;
  std::vector<std::int32_t> mark_;  // the last face that used the point
  std::vector<HalfEdgeMesh::VertexHandle> face_;
  Mesh mesh_;
  std::int64_t steps_ = 0, loose_edges_ = 0;
};

}  // namespace

Mesh build_mesh(std::span<const glm::dvec3> points, std::span<const Facet> faces,
                std::span<const std::int32_t> corners) {
  const SilentOpenMesh silent;
  Builder builder(points, faces.size(), corners.size());
  for (const Facet& face : faces)
    builder.add(
        corners.subspan(static_cast<std::size_t>(face.first_corner), static_cast<std::size_t>(face.corner_count)));
  return builder.finish();
}

Mesh mesh_of(const Scene& scene) { return build_mesh(scene.points, scene.facets, scene.corners); }

}  // namespace zstep
