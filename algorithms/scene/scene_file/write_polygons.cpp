#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algorithms/scene/facets.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/keys.hpp"
#include "algorithms/scene/scene_file/write_scene.hpp"
#include "traces/error.hpp"

namespace zstep::scene {

namespace {

std::string text_of(Color color) { return fmt::format("\"#{:02x}{:02x}{:02x}\"", color.red, color.green, color.blue); }
std::string text_of(const glm::dvec3& point) { return fmt::format("[{}, {}, {}]", point.x, point.y, point.z); }

/// Written as TOML does; names have no control characters.
std::string in_toml(std::string_view text) {
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') all += '\\';
    all += c;
  }
  return all + '"';
}

std::vector<std::string> names_of_polygons(const Scene& scene) {
  std::vector<std::string> names;
  for (const Polygon& polygon : scene.polygons) names.push_back(in_toml(*polygon.name));
  return names;
}

/// A point's group and coordinates. Within a group, the polygons between two meshes, points that are equal are one
/// vertex.
using PlaceOfPoint = std::array<double, 4>;
PlaceOfPoint place_of(std::size_t group, const glm::dvec3& point) {
  const glm::dvec3 plain = point + 0.0;
  return {static_cast<double>(group), plain.x, plain.y, plain.z};
}

class PolygonEdits {
 public:
  PolygonEdits(TomlText& text, const Wanted& wanted, const Scene& read) : text_(text), wanted_(wanted), read_(read) {}

  bool move_points() {
    if (read_.points.size() != wanted_.scene.points.size()) return false;
    std::map<PlaceOfPoint, std::size_t> moved;
    for (std::size_t at = 0; at < read_.points.size(); ++at) {
      if (read_.points[at] == wanted_.scene.points[at]) continue;
      if (placement_of(read_, static_cast<std::int32_t>(at)) != nullptr) return false;  // in another file
      std::size_t group = 0;
      for (const Placement& mesh : read_.placements) group += static_cast<std::size_t>(mesh.first_point) <= at;
      if (!moved.try_emplace(place_of(group, read_.points[at]), at).second) return false;
    }
    if (moved.empty()) return true;
    if (const toml::array* shared = text_.top()["points"].as_array()) move_all(*shared, moved);
    if (const toml::array* polygons = text_.top()["polygon"].as_array())
      for (const toml::node& polygon : *polygons)
        if (const toml::array* own = (*polygon.as_table())["points"].as_array()) move_all(*own, moved);
    text_.replace(values_);
    return true;
  }

  bool paint() {
    const std::size_t count = read_.polygons.size();
    std::map<std::string_view, Color> colors;
    for (const Polygon& polygon : wanted_.scene.polygons) colors.emplace(*polygon.name, polygon.color);
    for (std::size_t k = 0; k < count; ++k) {
      const Polygon& polygon = read_.polygons[k];
      const auto named = polygon.name->empty() ? colors.end() : colors.find(*polygon.name);
      const Color color = named != colors.end() ? named->second : wanted_.scene.polygons[k].color;
      if (color == polygon.color) continue;
      const toml::table* table = polygon_at(polygon.source_line);
      if (table == nullptr) return false;
      text_.set(*table, "color", text_of(color));
      // Lines move; the scene is read anew for the next.
      return true;
    }
    return painted_ = true;
  }
  bool painted() const { return painted_; }

  void put_in_order() {
    const std::vector<std::string> was = names_of_polygons(read_), is = names_of_polygons(wanted_.scene);
    if (was != is) text_.set("", "order", fmt::format("[{}]", fmt::join(is, ", ")));
  }

 private:
  void move_all(const toml::array& list, const std::map<PlaceOfPoint, std::size_t>& moved) {
    for (const toml::node& node : list) {
      const glm::dvec3 point = point_in(node, "", "", true);
      // A list of shared points serves all groups; where these disagree, the text reads otherwise than wanted.
      auto found = moved.end();
      for (std::size_t group = 0; group <= read_.placements.size() && found == moved.end(); ++group)
        found = moved.find(place_of(group, point));
      if (found == moved.end()) continue;
      const glm::dvec3& to = wanted_.scene.points[found->second];
      const toml::array& numbers = *node.as_array();
      if (numbers.size() == 2 && to.z != 0) {
        values_.emplace_back(&node, text_of(to));
        continue;
      }
      for (std::size_t axis = 0; axis < numbers.size(); ++axis)
        if (const int k = static_cast<int>(axis); point[k] != to[k])
          values_.emplace_back(&numbers[axis], fmt::format("{}", to[k]));
    }
  }

  const toml::table* polygon_at(std::int32_t line) const {
    const toml::array* polygons = text_.top()["polygon"].as_array();
    if (polygons == nullptr) return nullptr;
    for (const toml::node& node : *polygons)
      if (line_of(node) == line && !node.as_table()->is_inline()) return node.as_table();
    return nullptr;
  }

  TomlText& text_;
  const Wanted& wanted_;
  const Scene& read_;
  std::vector<std::pair<const toml::node*, std::string>> values_;
  bool painted_ = false;
};

/// Its corners as a file has them, before it is cut into facets.
std::vector<std::int32_t> corners_of(const Scene& scene, std::span<const Facet> facets) {
  std::vector<std::int32_t> corners;
  for (const Facet& facet : facets) {
    const auto first = scene.corners.begin() + facet.first_corner;
    corners.insert(corners.end(), first, first + facet.corner_count);
  }
  if (facets.empty()) return {0, 0, 0};  // it was none either
  if (facets.size() == 1) return corners;
  return outline_of(scene.points, corners);
}

}  // namespace

bool edit_polygons(TomlText& text, const Wanted& wanted) {
  // Each colour is a change of its own.
  for (std::size_t round = 0; round <= wanted.scene.polygons.size() + 1; ++round) {
    const Scene read = read_scene_text(text.text(), wanted.path).scene;
    if (read.polygons.size() != wanted.scene.polygons.size()) return false;
    PolygonEdits edits(text, wanted, read);
    if (round == 0) {
      if (!edits.move_points()) return false;
    } else if (!edits.paint()) {
      return false;
    } else if (edits.painted()) {
      edits.put_in_order();
      return true;
    }
  }
  return false;
}

void write_polygons(TomlText& text, const Wanted& wanted) {
  const Scene& scene = wanted.scene;
  for (const char* part : {"polygon", "mesh", "surface"}) text.erase_tables(part);
  text.erase("", "order");
  text.erase("", "points");
  std::string points = "[\n";
  for (const glm::dvec3& point : scene.points) points += fmt::format("  {},\n", text_of(point));
  text.set("", "keep_points", "true");
  text.set("", "points", points + "]");
  std::string polygons;
  std::size_t facet = 0;
  for (std::size_t k = 0; k < scene.polygons.size(); ++k) {
    const Polygon& polygon = scene.polygons[k];
    const std::size_t first = facet;
    while (facet < scene.facets.size() && scene.facets[facet].polygon == static_cast<std::int32_t>(k)) ++facet;
    const auto corners = corners_of(scene, std::span(scene.facets).subspan(first, facet - first));
    if (corners.empty())
      throw InputError(scene.name,
                       fmt::format("the pieces of polygon {} have no outline that a scene file could say", k),
                       "save it as a trace: zstep record");
    polygons += polygons.empty() ? "[[polygon]]\n" : "\n[[polygon]]\n";
    if (!polygon.name->empty()) polygons += fmt::format("name = {}\n", in_toml(*polygon.name));
    polygons += fmt::format("color = {}\n", text_of(polygon.color));
    const Material& material = *polygon.material;
    if (material.opacity != 1) polygons += fmt::format("opacity = {}\n", material.opacity);
    if (material.reflectance != 0) polygons += fmt::format("reflectance = {}\n", material.reflectance);
    if (material.refraction != 1) polygons += fmt::format("refraction = {}\n", material.refraction);
    polygons += fmt::format("corners = [{}]\n", fmt::join(corners, ", "));
  }
  text.append(polygons);
}

}  // namespace zstep::scene
