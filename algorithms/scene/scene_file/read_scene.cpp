// scale, rotate and translate of a [[mesh]].

#include "algorithms/scene/scene_file/read_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/built_in/built_in.hpp"
#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/scene_file/clip_points.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "algorithms/scene/surface/surface_scene.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

/// Scaled first (a number or [x, y, z]), then rotated (degrees about the x axis, then y, then z), then translated.
Placement read_placement(Keys& keys, const std::string& file);

namespace {

/// Counter-clockwise about the axis, seen from its tip. Right angles are exact, so that a turned cube stays a cube.
glm::dmat3 rotation(int axis, double degrees) {
  int quadrant = 0;
  const double rest = std::remquo(degrees, 90.0, &quadrant) * (3.14159265358979323846 / 180);
  double c = portable::cos(rest), s = portable::sin(rest);
  for (int i = 0; i < (quadrant & 3); ++i) {
    const double old = c;
    c = -s;
    s = old;
  }
  glm::dmat3 turn(1);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  turn[u][u] = c;
  turn[u][v] = s;
  turn[v][u] = -s;
  turn[v][v] = c;
  return turn;
}

}  // namespace

Placement read_placement(Keys& keys, const std::string& file) {
  Placement placement;
  if (const toml::node* node = keys.find("scale")) {
    const glm::dvec3 scale =
        node->is_number() ? glm::dvec3(number_in(*node, file, "scale")) : point_in(*node, file, "scale");
    if (scale.x == 0 || scale.y == 0 || scale.z == 0)
      fail_at(*node, file, "a scale of 0 makes the mesh flat", "use another");
    for (int axis = 0; axis < 3; ++axis) placement.linear[axis][axis] = scale[axis];
  }
  if (const auto angles = keys.point("rotate"))
    for (int axis = 0; axis < 3; ++axis) placement.linear = rotation(axis, (*angles)[axis]) * placement.linear;
  placement.offset = keys.point("translate").value_or(glm::dvec3(0));
  return placement;
}

// [light], [surface] and the keys of materials.

/// opacity, reflectance and refraction, as far as they are given.
MaterialKeys read_material(Keys& keys, const std::string& file);

/// The [light] of `top`, if there is one; window, near and far are 0 where they are to come from the extent.
std::optional<Light> read_light(Keys& top, const std::string& file, bool screen);

/// The formula, ranges and numbers of samples of a [surface]; what is not given is as in default_surface.
Surface read_surface(Keys& keys, const std::string& file);

namespace {

/// A number from `least` to `most`.
std::optional<double> number_between(Keys& keys, const std::string& file, std::string_view key, double least,
                                     double most) {
  const auto value = keys.number(key);
  if (value && !(*value >= least && *value <= most))
    fail_at(*keys.find(key), file, fmt::format("{} is {}", key, *value),
            fmt::format("it goes from {} to {}", least, most));
  return value;
}

/// key = [low, high]
void read_range(Keys& keys, const std::string& file, std::string_view key, double& low, double& high) {
  const toml::array* list = keys.array(key);
  if (list == nullptr) return;
  if (list->size() != 2) fail_at(*list, file, fmt::format("{} is no range", key), "write [-3, 3]");
  low = number_in((*list)[0], file, key);
  high = number_in((*list)[1], file, key);
  if (!(low < high))
    fail_at(*list, file, fmt::format("{} goes from {} to {}", key, low, high), "write the smaller number first");
}

}  // namespace

MaterialKeys read_material(Keys& keys, const std::string& file) {
  return {number_between(keys, file, "opacity", 0, 1), number_between(keys, file, "reflectance", 0, 1),
          number_between(keys, file, "refraction", least_refraction, most_refraction)};
}

std::optional<Light> read_light(Keys& top, const std::string& file, bool screen) {
  const toml::table* table = top.table("light");
  if (table == nullptr) return std::nullopt;
  if (screen)
    fail_at(*table, file, "a light needs a scene in world coordinates", "take it out, or use world coordinates");
  Keys keys(*table, file, "[light]");
  Light light;
  const auto position = keys.point("position");
  light.target = keys.point("target").value_or(light.target);
  light.window = keys.positive("window").value_or(0);
  light.near = keys.positive("near").value_or(0);
  light.far = keys.positive("far").value_or(0);
  keys.finish();
  if (!position) fail_at(*table, file, "the light has no position", "add position = [x, y, z]");
  light.position = *position;
  if (!(glm::length(light.target - light.position) > 1e-12 * (glm::length(light.target) + glm::length(light.position))))
    fail_at(*keys.find("position"), file, "the light stands at its target", "move one of them");
  if (light.far > 0 && !(light.far > light.near))
    fail_at(*keys.find("far"), file, "far is not greater than near", "give the greater distance to far");
  return light;
}

Surface read_surface(Keys& keys, const std::string& file) {
  Surface surface = default_surface();
  surface.formula = keys.text("formula").value_or("");
  read_range(keys, file, "x", surface.x_min, surface.x_max);
  read_range(keys, file, "z", surface.z_min, surface.z_max);
  const auto most = static_cast<std::int32_t>(most_surface_samples);
  surface.columns = keys.whole("columns", 1, most).value_or(surface.columns);
  surface.rows = keys.whole("rows", 1, most).value_or(surface.rows);
  return surface;
}

namespace {

class Reader {
 public:
  Reader(const toml::table& table, const std::string& file, const MeshFiles& meshes)
      : top_(table, file, "the scene"), file_(file), meshes_(meshes) {}

  SceneFile read(const std::string& title) {
    SceneFile result;
    Scene& scene = result.scene;
    scene.name = top_.text("name").value_or(title);
    scene.source = file_;
    scene.background = color(top_, "background").value_or(scene.background);
    const auto coordinates = top_.choice("coordinates", {"world", "screen", "clip", "clip_zero_to_one"}).value_or(0);
    screen_ = coordinates == 1;
    if (coordinates >= 2) clip_.emplace(file_, coordinates == 2 ? ClipNear::minus_w : ClipNear::zero);
    read_raster(top_, file_, screen_, scene.raster);
    read_camera(top_, file_, screen_, scene.camera);
    if (clip_) check_camera_of_clip_points();
    const toml::table* surface = top_.table("surface");
    // In screen coordinates there is no inside and outside, as textbooks give outlines either way round; a surface is
    // looked at from above and from below.
    read_options(top_, file_, screen_ || surface != nullptr, result.conventions);
    if (screen_ && result.conventions.cull)
      fail_at(*top_.table("options")->get("cull"), file_,
              "cull needs an eye that sees backs, and these points are on the screen already",
              "leave it out, or give the scene a [camera] with an eye");
    scene.light = read_light(top_, file_, screen_ || clip_);
    const toml::array* points = top_.array("points");
    keep_points_ = top_.boolean("keep_points").value_or(false);
    const toml::array* order = top_.array("order");
    const toml::array* polygons = top_.array("polygon");
    const toml::array* meshes = top_.array("mesh");
    if (keep_points_ && (points == nullptr || meshes != nullptr))
      fail_at(*top_.find("keep_points"), file_, "keep_points is for scenes all of whose points stand in one list",
              "remove it, or give points = [[x, y, z], …] and polygons with corners");
    for (const std::string_view other : {"points", "polygon", "mesh"})
      top_.not_both("surface", other, "a surface is a scene by itself: remove one of them");
    top_.finish();
    if (surface != nullptr) {
      result = read_surface_scene(*surface, std::move(result));
      if (order != nullptr) put_in_order_of(*order, result);
      return result;
    }

    SceneBuilder builder(std::move(result));
    if (points != nullptr) read_points(*points);
    read_in_file_order(polygons, meshes, builder);
    if (builder.size() == 0) throw InputError(file_, "the scene has no polygons", "add a [[polygon]] or a [[mesh]]");
    result = builder.finish();
    if (clip_) clip_->give_camera(result.scene.camera);
    if (order != nullptr) put_in_order_of(*order, result);
    return result;
  }

 private:
  /// order = ["B", "A"]: each polygon once, by its name.
  void put_in_order_of(const toml::array& order, SceneFile& file) const {
    Scene& scene = file.scene;
    std::map<std::string_view, std::size_t> by_name;
    for (std::size_t k = 0; k < scene.polygons.size(); ++k) by_name.try_emplace(*scene.polygons[k].name, k);
    std::vector<std::int32_t> place_of(scene.polygons.size(), -1);
    std::int32_t next = 0;
    for (const toml::node& node : order) {
      const auto name = node.value<std::string>();
      if (!name || name->empty())
        fail_at(node, file_, "the order is not a list of names", "write order = [\"A\", \"B\", …]");
      const auto found = by_name.find(*name);
      if (found == by_name.end())
        fail_at(node, file_, fmt::format("there is no polygon {} to put in order", in_quotes(*name)),
                "give each polygon's name once");
      if (place_of[found->second] >= 0)
        fail_at(node, file_, fmt::format("{} is in the order twice", in_quotes(*name)),
                "give each polygon's name once");
      place_of[found->second] = next++;
    }
    if (static_cast<std::size_t>(next) != scene.polygons.size())
      fail_at(order, file_, fmt::format("the order names {} of {} polygons", next, scene.polygons.size()),
              "give each polygon's name once");
    put_in_order(scene, place_of);
    const std::vector<Color> unlit = file.unlit_colors;
    for (std::size_t k = 0; k < unlit.size(); ++k) file.unlit_colors[place_of[k]] = unlit[k];
  }

  std::optional<Color> color(Keys& keys, std::string_view key) {
    const auto text = keys.text(key);
    if (!text) return std::nullopt;
    const auto found = color_from_text(*text);
    if (!found) {
      std::vector<std::string_view> names;
      for (const NamedColor& named : named_colors()) names.push_back(named.name);
      fail_at(*keys.find(key), file_, fmt::format("{} is no colour", in_quotes(*text)),
              text->substr(0, 1) == "#" ? "write #rrggbb" : suggestion(*text, names));
    }
    return found;
  }

  glm::dvec3 point_of(const toml::node& node) {
    return clip_ ? clip_->read(node) : point_in(node, file_, "a point", screen_);
  }

  /// Points in clip coordinates have been looked at already.
  void check_camera_of_clip_points() {
    const toml::table* table = top_.table("camera");
    if (table == nullptr) return;
    for (const auto& [key, node] : *table)
      if (key != "near" && key != "far" && key != "depth_range")
        fail_at(node, file_, fmt::format("'{}' stands in a scene in clip coordinates", key.str()),
                "take it out: of the camera only near, far and depth_range are left");
  }

  void read_points(const toml::array& list) {
    for (const toml::node& node : list) shared_points_.push_back({point_of(node), line_of(node)});
  }

  // The polygons' indices follow the file, whichever way [[polygon]] and [[mesh]] alternate.
  void read_in_file_order(const toml::array* polygons, const toml::array* meshes, SceneBuilder& builder) {
    struct Part {
      const toml::node* node;
      bool mesh;
    };
    std::vector<Part> parts;
    if (polygons != nullptr)
      for (const toml::node& node : *polygons) parts.push_back({&node, false});
    if (meshes != nullptr)
      for (const toml::node& node : *meshes) parts.push_back({&node, true});
    std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
      const auto& p = a.node->source().begin;
      const auto& q = b.node->source().begin;
      return p.line != q.line ? p.line < q.line : p.column < q.column;
    });
    PolygonSoup soup;
    PointMerger merger;
    at_vertices_.clear();
    if (keep_points_)
      for (const SharedPoint& point : shared_points_)
        soup.add_point(point.position, point.line, [&] { return fmt::format("{}:{}", file_, point.line); });
    const auto flush = [&] {
      if (!soup.outlines.empty()) {
        give_to_vertices(soup);
        load_textures(soup, beside_scene());
        builder.add(std::exchange(soup, {}), file_, {});
      }
      merger = PointMerger();
    };
    for (const Part& part : parts) {
      const toml::table* table = part.node->as_table();
      if (table == nullptr)
        fail_at(*part.node, file_, part.mesh ? "mesh is not a table" : "polygon is not a table",
                part.mesh ? "write [[mesh]]" : "write [[polygon]]");
      if (part.mesh) {
        flush();
        read_mesh_entry(*table, builder);
      } else {
        read_polygon(*table, soup, merger);
      }
    }
    flush();
  }

  void read_polygon(const toml::table& table, PolygonSoup& soup, PointMerger& merger) {
    Keys keys(table, file_, "[[polygon]]");
    const std::int32_t line = line_of(table);
    std::string name = keys.text("name").value_or("");
    if (!name.empty()) {
      const auto [other, is_new] = lines_of_names_.try_emplace(name, line);
      if (!is_new)
        fail_at(*keys.find("name"), file_,
                fmt::format("a polygon named {} stands at line {} already", in_quotes(name), other->second),
                "give it another name");
    }
    const auto polygon_color = color(keys, "color");
    const MaterialKeys material = read_material(keys, file_);
    const auto texture = keys.text("texture");
    const toml::table* at_vertices = keys.table("at_vertices");
    keys.not_both("points", "corners", "keep one: points are coordinates, corners are indices into the scene's points");
    const auto where = [&] { return fmt::format("{}:{}", file_, line); };
    const toml::array* points = keys.array("points");
    const toml::array* corners = keys.array("corners");
    keys.finish();
    if (keep_points_ && points != nullptr)
      fail_at(*points, file_, "with keep_points all points stand in one list", "give the polygon corners instead");
    if (points == nullptr && corners == nullptr)
      fail_at(table, file_, "the polygon has no points", "add points = [[x, y, z], [x, y, z], [x, y, z]]");
    if ((points != nullptr ? points : corners)->size() < 3)
      fail_at(table, file_, "the polygon has fewer than three corners", "add some");
    if (points != nullptr)
      for (const toml::node& node : *points)
        soup.add_corner(merger.add(soup, point_of(node), line_of(node), where), where);
    else
      for (const toml::node& node : *corners) {
        const auto index = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
        if (!index || *index < 0 || *index >= std::ssize(shared_points_))
          fail_at(node, file_, "a corner is no index into the scene's points",
                  shared_points_.empty() ? std::string("put points = [[x, y, z], …] at the top of the file")
                                         : fmt::format("the indices are 0 to {}", shared_points_.size() - 1));
        const SharedPoint& point = shared_points_[*index];
        soup.add_corner(keep_points_ ? *index : merger.add(soup, point.position, point.line, where), where);
      }
    soup.close_outline(line, polygon_color, where);
    soup.materials.push_back(material.over({}));
    if (texture) soup.materials.back().texture = soup.texture(*texture, at_line(*keys.find("texture")));
    soup.names.push_back(std::move(name));
    if (at_vertices != nullptr) read_at_vertices(*at_vertices, soup);
  }

  std::string at_line(const toml::node& node) const { return fmt::format("{}:{}", file_, line_of(node)); }

  /// at_vertices = { uv = [[0, 0], [1, 0], [1, 1]], heat = [1, 2, 3] }: lists of as many values as the polygon, the
  /// last one, has corners.
  void read_at_vertices(const toml::table& table, PolygonSoup& soup) {
    const Facet outline = soup.outlines.back();
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      const toml::array* list = node.as_array();
      if (list == nullptr || std::ssize(*list) != outline.corner_count)
        fail_at(node, file_, fmt::format("{} is no list of {} values", in_quotes(name), outline.corner_count),
                "give one for each corner of the polygon");
      const auto values = values_in(*list, name);
      const auto [place, is_new] = at_vertices_.try_emplace(name);
      auto& [attribute, value_of_corner] = place->second;
      const auto components = static_cast<std::int32_t>(values.front().size());
      if (is_new) attribute.name = name, attribute.components = components;
      if (std::ssize(at_vertices_) > most_attributes)
        fail_at(node, file_, fmt::format("there are more than {} names of values", most_attributes), "leave some out");
      value_of_corner.resize(static_cast<std::size_t>(outline.first_corner), no_value);
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::ssize(values[k]) != attribute.components)
          fail_at((*list)[k], file_,
                  fmt::format("a value of {} has {} numbers, and others have {}", in_quotes(name), values[k].size(),
                              attribute.components),
                  "give all as many");
        value_of_corner.push_back(static_cast<std::int32_t>(std::ssize(attribute.values) / attribute.components));
        soup.add_value(attribute, values[k], line_of((*list)[k]), [&] { return at_line(*list); });
      }
    }
  }
  /// Numbers, lists of them, or colours by name.
  std::vector<std::vector<double>> values_in(const toml::array& list, const std::string& name) const {
    std::vector<std::vector<double>> values;
    for (const toml::node& node : list) {
      std::vector<double>& value = values.emplace_back();
      if (const auto text = node.value<std::string>(); text && name == color_attribute) {
        const auto known = color_from_text(*text);
        if (!known) fail_at(node, file_, fmt::format("{} is no colour", in_quotes(*text)), "write #rrggbb");
        value = {known->red / 255.0, known->green / 255.0, known->blue / 255.0};
      } else if (const toml::array* numbers = node.as_array()) {
        for (const toml::node& number : *numbers) value.push_back(number_in(number, file_, name));
      } else {
        value.push_back(number_in(node, file_, name));
      }
      if (value.empty() || std::ssize(value) > most_components)
        fail_at(node, file_, fmt::format("a value of {} has {} numbers", in_quotes(name), value.size()),
                fmt::format("give 1 to {}", most_components));
      const std::size_t needed = name == color_attribute || name == normal_attribute ? 3 : name == uv_attribute ? 2 : 0;
      if (needed > 0 && value.size() != needed)
        fail_at(node, file_, fmt::format("{} has {} numbers", in_quotes(name), value.size()),
                fmt::format("give {}", needed));
    }
    return values;
  }
  void give_to_vertices(PolygonSoup& soup) {
    for (auto& [name, of] : at_vertices_) {
      of.value_of_corner.resize(soup.corners.size(), no_value);
      soup.give_to_corners(of.attribute, of.value_of_corner);
      soup.attributes.push_back(std::move(of.attribute));
    }
    at_vertices_.clear();
  }
  /// Images lie in the scene's folder or below.
  ImageFinder beside_scene() const {
    return [this](std::string_view named) { return beside_mesh(std::filesystem::path(file_).parent_path(), named); };
  }

  void read_mesh_entry(const toml::table& table, SceneBuilder& builder) {
    Keys keys(table, file_, "[[mesh]]");
    if (screen_ || clip_)
      fail_at(table, file_,
              fmt::format("a mesh cannot stand in a scene in {} coordinates", screen_ ? "screen" : "clip"),
              "use world coordinates");
    const auto path = keys.text("file"), built_in = keys.text("builtin");
    keys.not_both("file", "builtin", "keep one");
    const auto base = color(keys, "color");
    const MaterialKeys material = read_material(keys, file_);
    const Placement placement = read_placement(keys, file_);
    const auto texture = keys.text("texture");
    keys.finish();
    if (!path && !built_in)
      fail_at(table, file_, "the mesh has neither 'file' nor 'builtin'", "add file = \"mesh.obj\"");
    PolygonSoup soup;
    if (path) {
      soup = meshes_(*path);
    } else {
      auto found = built_in_mesh(*built_in, fmt::format("{}:{}", file_, line_of(table)));
      if (!found)
        fail_at(*keys.find("builtin"), file_, fmt::format("there is no built-in mesh {}", in_quotes(*built_in)),
                suggestion(*built_in, built_in_meshes()));
      soup = std::move(*found);
    }
    if (texture) {  // that of all, in place of the mesh's own
      soup.textures.clear();
      soup.materials.resize(soup.outlines.size());
      const std::int32_t number = soup.texture(*texture, at_line(*keys.find("texture")));
      for (Material& one : soup.materials) one.texture = number;
      load_textures(soup, beside_scene());
    }
    const bool few = soup.outlines.size() <= palette.size() && !base;
    // Polygons have lines of one file, the scene's own: those of a mesh stand at its [[mesh]].
    builder.add(std::move(soup), path ? *path : *built_in,
                {placement, few ? SceneBuilder::Bare::of_palette : SceneBuilder::Bare::shaded, base.value_or(clay),
                 line_of(table), material});
  }

  SceneFile read_surface_scene(const toml::table& table, SceneFile result) {
    if (screen_ || clip_)
      fail_at(table, file_,
              fmt::format("a surface cannot stand in a scene in {} coordinates", screen_ ? "screen" : "clip"),
              "use world coordinates");
    Keys keys(table, file_, "[surface]");
    const Surface surface = read_surface(keys, file_);
    const auto base = color(keys, "color");
    const MaterialKeys material = read_material(keys, file_);
    keys.finish();
    const toml::node* formula = keys.find("formula");
    if (formula == nullptr) fail_at(table, file_, "the surface has no formula", "add formula = \"sin(x) * cos(z)\"");
    if (std::int64_t{surface.columns} * surface.rows > most_surface_samples)
      fail_at(table, file_, fmt::format("the surface has more than {} samples", most_surface_samples),
              "give it fewer columns or rows");
    SceneBuilder::Style style;
    style.bare = SceneBuilder::Bare::shaded;
    style.bare_color = base.value_or(clay);
    style.line = line_of(table);
    style.material = material;
    style.open = true;
    return surface_scene(surface, fmt::format("{}:{}", file_, line_of(*formula)), std::move(result), style);
  }

  struct SharedPoint {
    glm::dvec3 position;
    std::int32_t line;
  };

  Keys top_;
  const std::string& file_;
  const MeshFiles& meshes_;
  bool screen_ = false;
  std::optional<ClipPoints> clip_;
  bool keep_points_ = false;  ///< each of the list is a vertex, under its number there
  std::vector<SharedPoint> shared_points_;
  /// Values at the vertices of polygons, by name, and which of them each corner of the soup at work has.
  struct AtVertices {
    VertexAttribute attribute;
    std::vector<std::int32_t> value_of_corner;
  };
  std::map<std::string, AtVertices> at_vertices_;
  std::map<std::string, std::int32_t> lines_of_names_;
};

}  // namespace

SceneFile read_scene(std::string_view text, const std::string& name, const std::string& title,
                     const MeshFiles& meshes) {
  if (text.size() > largest_scene_file)
    throw InputError(name, fmt::format("a scene file is at most {} bytes long", largest_scene_file),
                     "put the polygons into a mesh file and name it in a [[mesh]]");
  check_toml_depth(text, name);
  toml::table table;
  try {
    table = toml::parse(text, std::string_view(name));
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}", name, error.source().begin.line), error.description(),
                     "see docs/scene-format.md for how a scene is written");
  }
  return Reader(table, name, meshes).read(title);
}

}  // namespace zstep::scene
