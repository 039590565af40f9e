
#include "algorithms/scene/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

namespace {

// The palette's own names first; then what people try, as CSS has them where the palette has no such colour.
constexpr std::array<NamedColor, 23> names{{{"orange", palette[0]},
                                            {"sky blue", palette[1]},
                                            {"green", palette[2]},
                                            {"yellow", palette[3]},
                                            {"blue", palette[4]},
                                            {"vermillion", palette[5]},
                                            {"purple", palette[6]},
                                            {"grey", palette[7]},
                                            {"gray", palette[7]},
                                            {"black", {0, 0, 0}},
                                            {"white", {255, 255, 255}},
                                            {"red", {204, 37, 41}},
                                            {"pink", {255, 192, 203}},
                                            {"brown", {140, 86, 75}},
                                            {"cyan", {0, 183, 196}},
                                            {"magenta", {199, 36, 177}},
                                            {"violet", {128, 90, 200}},
                                            {"navy", {0, 32, 96}},
                                            {"light grey", {211, 211, 211}},
                                            {"light gray", {211, 211, 211}},
                                            {"dark grey", {90, 90, 90}},
                                            {"dark gray", {90, 90, 90}},
                                            {"clay", clay}}};

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::span<const NamedColor> named_colors() { return names; }

std::optional<Color> color_from_text(std::string_view text) {
  for (const NamedColor& named : names)
    if (named.name == text) return named.color;
  if (text.empty() || text[0] != '#' || (text.size() != 4 && text.size() != 7)) return std::nullopt;
  const std::size_t digits = text.size() == 4 ? 1 : 2;
  std::array<std::uint8_t, 3> channels{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int high = hex_digit(text[1 + i * digits]), low = hex_digit(text[i * digits + digits]);
    if (high < 0 || low < 0) return std::nullopt;
    channels[i] = static_cast<std::uint8_t>(16 * high + low);
  }
  return Color{channels[0], channels[1], channels[2]};
}

Color shaded(Color base, glm::dvec3 normal) {
  // From the left, behind and above an eye at the default theta of 30 degrees.
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.9, -0.35, 0.8));
  const double length = glm::length(normal);
  const double facing = length > 0 ? glm::dot(normal, light) / length : 0;
  const double half = (1 + facing) / 2;
  const double brightness = 0.30 + 0.85 * half * half;
  const auto channel = [&](std::uint8_t value) { return nearest_byte(std::fmin(255, value * brightness)); };
  return {channel(base.red), channel(base.green), channel(base.blue)};
}

}  // namespace zstep::scene

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
    for (std::size_t i = 0; i < points.size(); ++i) vertex_of_point_[i] = add_vertex(index32(i));
  }

  void add(std::span<const std::int32_t> corners) {
    const auto face_number = static_cast<std::int32_t>(mesh_.half_edges.n_faces());
    face_.clear();
    bool repeats = false;
    for (const std::int32_t point : corners) {
      const std::size_t p = point;
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
    const glm::dvec3 p = point < 0 ? glm::dvec3(0) : points_[point];
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
    loose_edges_ += std::ssize(face_);
  }

  // To add a face OpenMesh walks round each of its vertices. A file of millions of triangles at one point would keep it
  // walking for hours, so there is a budget of steps; once it is spent, faces at crowded points are loose ones.
  bool affordable(std::span<const std::int32_t> corners) {
    constexpr std::int64_t budget = 100'000'000;
    constexpr std::int32_t crowded = 32;
    std::int32_t most = 0;
    for (const std::int32_t point : corners) {
      std::int32_t& valence = valence_[point];
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
  for (const Facet& face : faces) builder.add(corners.subspan(face.first_corner, face.corner_count));
  return builder.finish();
}

Mesh mesh_of(const Scene& scene) { return build_mesh(scene.points, scene.facets, scene.corners); }

}  // namespace zstep
