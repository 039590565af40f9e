#include "sim/viewer/model/scene_parts.hpp"

#include <algorithm>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
namespace {

std::span<const std::int32_t> corners_of(const Scene& scene, const Facet& facet) {
  return std::span(scene.corners)
      .subspan(static_cast<std::size_t>(facet.first_corner), static_cast<std::size_t>(facet.corner_count));
}

EdgeEnds edge_at(std::span<const std::int32_t> corners, std::size_t k) {
  return std::minmax(corners[k], corners[(k + 1) % corners.size()]);
}

}  // namespace

std::vector<EdgeEnds> edges_of(const Scene& scene) {
  if (scene.corners.size() > most_corners_picked) return {};
  std::set<EdgeEnds> edges;
  for (const Facet& facet : scene.facets) {
    const auto corners = corners_of(scene, facet);
    for (std::size_t k = 0; k < corners.size(); ++k) edges.insert(edge_at(corners, k));
  }
  return {edges.begin(), edges.end()};
}

std::vector<std::int32_t> polygons_with(const Scene& scene, const ScenePart& part) {
  std::vector<std::int32_t> polygons;
  for (const Facet& facet : scene.facets) {
    const auto corners = corners_of(scene, facet);
    bool has = part.vertex && std::find(corners.begin(), corners.end(), *part.vertex) != corners.end();
    for (std::size_t k = 0; part.edge && !has && k < corners.size(); ++k) has = edge_at(corners, k) == *part.edge;
    if (has && (polygons.empty() || polygons.back() != facet.polygon)) polygons.push_back(facet.polygon);
  }
  return polygons;
}

std::string name_of(const Scene& scene, const ScenePart& part) {
  if (part.vertex) return "vertex " + vertex_label(scene, *part.vertex);
  if (!part.edge) return "";
  const std::string from = vertex_label(scene, part.edge->first), to = vertex_label(scene, part.edge->second);
  const bool letters = from[0] >= 'A' && to[0] >= 'A';
  return fmt::format("edge {}{}{}", from, letters ? "" : "\u2013", to);
}

std::string place_in_file(const Scene& scene, const ScenePart& part) {
  const std::int32_t vertex = part.vertex ? *part.vertex : part.edge ? part.edge->first : -1;
  const auto at = static_cast<std::size_t>(vertex);
  if (vertex < 0 || at >= scene.point_lines.size() || scene.point_lines[at] == 0) return "";
  return fmt::format("{}:{}", scene.source, scene.point_lines[at]);
}

std::string told_of(const Scene& scene, const ScenePart& part) {
  std::vector<std::string> names;
  for (const std::int32_t polygon : polygons_with(scene, part)) names.push_back(polygon_label(scene, polygon));
  if (names.size() > 6) names.resize(6), names.emplace_back("\u2026");
  std::string text = name_of(scene, part);
  if (!text.empty()) text[0] = static_cast<char>(text[0] - 'a' + 'A');
  if (part.vertex && static_cast<std::size_t>(*part.vertex) < scene.points.size()) {
    const glm::dvec3& p = scene.points[static_cast<std::size_t>(*part.vertex)];
    text += fmt::format(" at ({}, {}, {})", number(p.x), number(p.y), number(p.z));
  }
  if (!names.empty()) text += fmt::format(", of {}", fmt::join(names, ", "));
  const std::string place = place_in_file(scene, part);
  return text + (place.empty() ? "." : fmt::format("; {}.", place));
}

bool is_about(const Event& event, const ScenePart& part) {
  return visit_event(
      [&]<class E>(const E& e) {
        if constexpr (requires {
                        e.vertex_0;
                        e.vertex_1;
                      }) {
          const EdgeEnds ends = std::minmax(e.vertex_0, e.vertex_1);
          if (part.edge) return ends == *part.edge;
          return part.vertex && (ends.first == *part.vertex || ends.second == *part.vertex);
        } else if constexpr (requires { e.vertex; }) {
          return part.vertex && static_cast<std::int32_t>(e.vertex) == *part.vertex;
        } else {
          return false;
        }
      },
      event);
}

}  // namespace zstep::viewer
