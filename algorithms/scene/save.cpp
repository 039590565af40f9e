#include "algorithms/scene/save.hpp"

#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "algorithms/scene/built_in/built_in.hpp"
#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "algorithms/scene/scene_file/write_scene.hpp"
#include "traces/error.hpp"

namespace zstep {

namespace {

using namespace scene;
namespace fs = std::filesystem;

/// As TOML takes it as it stands.
std::string literal(const std::string& path) {
  return path.find('\'') == path.npos ? "'" + path + "'" : '"' + path + '"';
}

/// What the scene was read from, as the text of a scene file at `to`; empty where there is none.
std::string origin_of(const Scene& scene, const fs::path& to) {
  const fs::path source(scene.source);
  if (scene.source == "built-in") return built_in_scene(scene.name).value_or("");
  if (scene.surface) {
    const Surface& s = *scene.surface;
    if (source.extension() != ".toml")
      return fmt::format("[surface]\nformula = \"{}\"\nx = [{}, {}]\nz = [{}, {}]\ncolumns = {}\nrows = {}\n",
                         s.formula, s.x_min, s.x_max, s.z_min, s.z_max, s.columns, s.rows);
  }
  std::error_code ignored;
  if (!fs::is_regular_file(source, ignored)) return "";
  if (mesh_format(source)) return fmt::format("[[mesh]]\nfile = {}\n", literal(seen_from(to.parent_path(), source)));
  if (source.extension() != ".toml") return "";
  TomlText text(read_bytes(source, largest_scene_file));
  std::vector<std::pair<const toml::node*, std::string>> files;
  const fs::path here = to.parent_path(), there = source.parent_path();
  if (const toml::array* meshes = text.top()["mesh"].as_array();
      meshes && !fs::equivalent(here.empty() ? "." : here, there.empty() ? "." : there, ignored))
    for (const toml::node& mesh : *meshes)
      if (const toml::node* file = mesh.as_table()->get("file"))
        if (const fs::path path = file->value_or(std::string()); path.is_relative())
          files.emplace_back(file, literal(seen_from(here, there / path)));
  text.replace(files);
  return text.text();
}

bool says(const TomlText& text, const Wanted& wanted) {
  const SceneFile file = read_as_wanted(text, wanted);
  Conventions conventions = wanted.conventions;
  conventions.options.clear();
  return file.conventions == conventions && runs_alike(look_at_scene(file.scene, {}), wanted.scene);
}

bool edit_until_it_says(TomlText& text, const Wanted& wanted) {
  constexpr int most_rounds = 12;  // some more than there are kinds of things
  for (int round = 0; round < most_rounds; ++round)
    if (!edit_view(text, wanted)) break;
  return says(text, wanted);
}

std::optional<std::string> edited(const std::string& origin, const Wanted& wanted) {
  if (origin.empty()) return std::nullopt;
  try {
    TomlText text(origin);
    if (edit_polygons(text, wanted) && edit_until_it_says(text, wanted)) return text.text();
  } catch (const InputError&) {  // what was inserted means something else there
  } catch (const toml::parse_error&) {
  }
  return std::nullopt;
}

std::optional<std::string> with_polygons_written(const std::string& origin, const Wanted& wanted) {
  if (wanted.scene.surface) return std::nullopt;
  try {
    TomlText text(origin);
    write_polygons(text, wanted);
    if (edit_until_it_says(text, wanted)) return text.text();
  } catch (const InputError&) {
  } catch (const toml::parse_error&) {
  }
  return std::nullopt;
}

}  // namespace

namespace {

/// Have both scenes the same numbers at the vertices of their polygons? Where these stand in their files is all one.
bool carry_alike(const Scene& a, const Scene& b) {
  const auto numbers = [](const VertexAttribute& of, std::int32_t polygon, std::int32_t point) {
    const std::int32_t value = of.value_of(polygon, point);
    const auto first = of.values.begin() + std::ptrdiff_t{value} * of.components;
    return value == no_value ? std::vector<double>() : std::vector<double>(first, first + of.components);
  };
  return a.attributes.size() == b.attributes.size() &&
         std::all_of(a.attributes.begin(), a.attributes.end(), [&](const VertexAttribute& one) {
           const VertexAttribute* other = attribute_named(b, one.name);
           if (other == nullptr || other->components != one.components) return false;
           for (const Facet& facet : a.facets)
             for (std::int32_t k = 0; k < facet.corner_count; ++k) {
               const std::int32_t point = a.corners[static_cast<std::size_t>(facet.first_corner + k)];
               if (numbers(one, facet.polygon, point) != numbers(*other, facet.polygon, point)) return false;
             }
           return true;
         });
}

}  // namespace

bool runs_alike(const Scene& a, const Scene& b) {
  const auto alike = [](const Polygon& p, const Polygon& q) {
    return *p.name == *q.name && p.color == q.color && *p.material == *q.material;
  };
  return a.points == b.points && a.facets == b.facets && a.corners == b.corners && a.background == b.background &&
         a.camera == b.camera && a.raster == b.raster && a.light == b.light && a.surface == b.surface &&
         std::equal(a.polygons.begin(), a.polygons.end(), b.polygons.begin(), b.polygons.end(), alike) &&
         std::equal(a.textures.begin(), a.textures.end(), b.textures.begin(), b.textures.end(),
                    [](const Texture& s, const Texture& t) {
                      return s.width == t.width && s.height == t.height && s.texels == t.texels;
                    }) &&
         carry_alike(a, b);
}

SceneText text_of_scene(const Scene& scene, const Conventions& conventions, const fs::path& to) {
  const Wanted wanted{scene, conventions, to};
  std::string origin;
  try {
    origin = origin_of(scene, to);
  } catch (const InputError&) {  // it cannot be read any more
  } catch (const toml::parse_error&) {
  }
  if (auto text = edited(origin, wanted)) return {std::move(*text), true};
  constexpr std::size_t least_of_point = 12, least_of_polygon = 50;  // bytes
  if (least_of_point * scene.points.size() + least_of_polygon * scene.polygons.size() > largest_scene_file)
    throw InputError(scene.name,
                     fmt::format("{} polygons are too many to be written into a scene file", scene.polygons.size()),
                     "change a scene of fewer polygons, or keep the run as a trace (`record` takes --change)");
  if (auto text = with_polygons_written(origin, wanted)) return {std::move(*text), false};
  const std::string bare = scene.camera.kind == Camera::Kind::screen ? "coordinates = \"screen\"\n" : "";
  if (auto text = with_polygons_written(bare, wanted)) return {std::move(*text), false};
  throw InputError(scene.name, "no scene file can say this scene",
                   scene.surface ? "of a surface only the camera, the raster and options can be saved"
                                 : "keep the run as a trace (`record` takes --change)");
}

}  // namespace zstep
