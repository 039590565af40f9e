
#include "algorithms/scene/scene_file/write_scene.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path relative = fs::relative(fs::absolute(file), fs::absolute(folder.empty() ? "." : folder), error);
  return (error || relative.empty() ? fs::absolute(file) : relative).generic_string();
}

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
      if (placement_of(read_, index32(at)) != nullptr) return false;  // in another file
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
        if (const int k = index32(axis); point[k] != to[k])
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
    const Scene read = read_as_wanted(text, wanted).scene;
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

SceneFile read_as_wanted(const TomlText& text, const Wanted& wanted) {
  SceneFile file = read_scene_text(text.text(), wanted.path);
  prepare_for_shade(file, wanted.conventions);
  return file;
}

namespace {

/// at_vertices of a polygon with these corners; nothing where no attribute has a value at all of them.
std::string values_at(const Scene& scene, std::int32_t polygon, std::span<const std::int32_t> corners) {
  std::vector<std::string> lists;
  for (const VertexAttribute& attribute : scene.attributes) {
    std::vector<std::string> values;
    for (const std::int32_t corner : corners) {
      const std::int32_t value = attribute.value_of(polygon, corner);
      if (value == no_value) break;
      const double* const first = attribute.values.data() + std::ptrdiff_t{value} * attribute.components;
      const auto numbers = fmt::format("{}", fmt::join(first, first + attribute.components, ", "));
      values.push_back(attribute.components == 1 ? numbers : "[" + numbers + "]");
    }
    if (values.size() == corners.size())
      lists.push_back(fmt::format("{} = [{}]", in_toml(attribute.name), fmt::join(values, ", ")));
  }
  return lists.empty() ? "" : fmt::format("at_vertices = {{ {} }}\n", fmt::join(lists, ", "));
}

}  // namespace

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
    while (facet < scene.facets.size() && scene.facets[facet].polygon == index32(k)) ++facet;
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
    if (material.texture != no_texture) {
      const std::string& source = scene.textures[static_cast<std::size_t>(material.texture)].source;
      polygons += fmt::format("texture = {}\n", in_toml(seen_from(wanted.path.parent_path(), source)));
    }
    polygons += fmt::format("corners = [{}]\n", fmt::join(corners, ", "));
    polygons += values_at(scene, index32(k), corners);
  }
  text.append(polygons);
}

namespace {

struct CameraKey {
  const char* name;
  double Camera::*number;
};
constexpr std::array<CameraKey, 3> eye_keys{{{"rho", &Camera::rho}, {"theta", &Camera::theta}, {"phi", &Camera::phi}}};
constexpr std::array<CameraKey, 2> plane_keys{{{"near", &Camera::near}, {"far", &Camera::far}}};

std::string in_toml(double number) { return fmt::format("{}", number); }
std::string in_toml(bool yes) { return yes ? "true" : "false"; }
std::string in_toml(const glm::dvec3& point) { return fmt::format("[{}, {}, {}]", point.x, point.y, point.z); }

bool edit_raster(TomlText& text, const Raster& was, const Raster& is) {
  if (was.width != is.width) text.set("raster", "width", fmt::format("{}", is.width));
  if (was.height != is.height) text.set("raster", "height", fmt::format("{}", is.height));
  if (was.y_up != is.y_up) text.set("raster", "y_axis", is.y_up ? "\"up\"" : "\"down\"");
  if (was.corners != is.corners) text.set("raster", "seen_at", is.corners ? "\"corners\"" : "\"centres\"");
  return was != is;
}

bool edit_options(TomlText& text, const Conventions& was, const Conventions& is) {
  bool edited = false;
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
    if (was.*member == is.*member) return;
    text.set("options", key, fmt::format("\"{}\"", word_of(is.*member)));
    edited = true;
  });
  if (was.cull != is.cull) text.set("options", "cull", in_toml(is.cull)), edited = true;
  return edited;
}

template <std::size_t Count>
bool edit_numbers(TomlText& text, const std::array<CameraKey, Count>& keys, const Camera& was, const Camera& is) {
  bool edited = false;
  for (const auto& [name, number] : keys)
    if (was.*number != is.*number) text.set("camera", name, in_toml(is.*number)), edited = true;
  return edited;
}

bool edit_depth_range(TomlText& text, const Camera::DepthRange& was, const Camera::DepthRange& is) {
  if (was != is) text.set("camera", "depth_range", fmt::format("[{}, {}]", is.low, is.high));
  return was != is;
}

bool edit_eye(TomlText& text, const Camera& was, const Camera& is) {
  bool edited = was.kind != is.kind;
  if (edited) text.set("camera", "orthographic", in_toml(is.kind == Camera::Kind::orthographic));
  if (was.d != is.d) text.set("camera", "d", in_toml(is.d)), edited = true;
  if (!is.polar) return edited;
  if (!was.polar)
    for (const char* key : {"eye", "target", "up"}) text.erase("camera", key);
  return edit_numbers(text, eye_keys, was, is) || edited || !was.polar;
}

bool edit_window(TomlText& text, const Camera& was, const Camera& is) {
  if (was.window == is.window) return false;
  const toml::table* camera = text.table("camera");
  if (camera && camera->contains("field_of_view")) text.rename("camera", "field_of_view", "window");
  text.set("camera", "window", in_toml(is.window));
  return true;
}

bool edit_light(TomlText& text, const std::optional<Light>& was, const std::optional<Light>& is) {
  if (was == is || !is) return false;
  const bool moved = !was || was->position != is->position || was->target != is->target;
  if (!was || was->position != is->position) text.set("light", "position", in_toml(is->position));
  if (!was || was->target != is->target) text.set("light", "target", in_toml(is->target));
  if (moved) return true;
  for (const auto& [name, number] : {std::pair{"window", &Light::window}, {"near", &Light::near}, {"far", &Light::far}})
    if ((*was).*number != (*is).*number) text.set("light", name, in_toml((*is).*number));
  return true;
}

}  // namespace

bool edit_view(TomlText& text, const Wanted& wanted) {
  const SceneFile file = read_scene_text(text.text(), wanted.path);
  const Scene was = look_at_scene(file.scene, {});
  const Scene& is = wanted.scene;
  if (was.background != is.background) {
    const Color& c = is.background;
    return text.set("", "background", fmt::format("\"#{:02x}{:02x}{:02x}\"", c.red, c.green, c.blue)), true;
  }
  if (edit_raster(text, was.raster, is.raster) || edit_options(text, file.conventions, wanted.conventions)) return true;
  if (is.camera.kind == Camera::Kind::screen) return false;
  return edit_eye(text, was.camera, is.camera) || edit_window(text, was.camera, is.camera) ||
         edit_numbers(text, plane_keys, was.camera, is.camera) ||
         edit_depth_range(text, was.camera.depth_range, is.camera.depth_range) || edit_light(text, was.light, is.light);
}

}  // namespace zstep::scene
