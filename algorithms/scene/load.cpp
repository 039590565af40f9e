#include "algorithms/scene/load.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/built_in/built_in.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/scene_file/read_scene.hpp"
#include "algorithms/scene/surface/surface_scene.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep {

namespace {

using namespace scene;

bool has_extension(const std::filesystem::path& path, std::string_view extension) {
  return lower_case(path.extension().string()) == extension;
}

SceneFile load_mesh(const std::filesystem::path& path) {
  SceneFile file;
  file.scene.name = path.stem().string();
  file.scene.source = path.string();
  file.scene.camera.rho = 0;  // from the extent
  file.scene.camera.d = default_d;
  file.scene.raster = {640, 480, false};
  PolygonSoup soup = read_mesh(path);
  const auto bare =
      soup.outlines.size() <= palette.size() ? SceneBuilder::Bare::of_palette : SceneBuilder::Bare::shaded;
  SceneBuilder builder(std::move(file));
  builder.add(std::move(soup), path.string(), {{}, bare, clay, 0});
  return builder.finish();
}

SceneFile scene_from_text(const std::string& text, const std::filesystem::path& path) {
  std::size_t budget = largest_file;  // of all its meshes together
  const auto mesh = [&](const std::string& written) {
    const std::filesystem::path beside = path.parent_path() / std::filesystem::path(written);
    std::error_code error;
    const auto size = std::filesystem::file_size(beside, error);
    if (!error && size > budget)
      throw InputError(path.string(), "its meshes are too large together", "use smaller ones");
    if (!error) budget -= static_cast<std::size_t>(size);
    return read_mesh(beside);
  };
  return read_scene(text, path.string(), path.stem().string(), mesh);
}

}  // namespace

namespace {

SceneFile load_any(const std::string& name_or_path) {
  if (is_formula(name_or_path)) return formula_scene(name_or_path);
  if (const auto text = built_in_scene(name_or_path)) {
    const auto no_files = [](const std::string& path) -> PolygonSoup {
      throw InputError(path, "a built-in scene has no files", "use a built-in mesh");
    };
    SceneFile file = read_scene(*text, name_or_path, name_or_path, no_files);
    file.scene.source = "built-in";
    return file;
  }
  const std::filesystem::path path(name_or_path);
  if (has_extension(path, ".toml")) return scene_from_text(read_bytes(path, largest_scene_file), path);
  if (mesh_format(path)) return load_mesh(path);
  if (std::error_code error; std::filesystem::is_regular_file(path, error))
    throw InputError(in_quotes(name_or_path), "a file of this kind is not read as a scene",
                     "name a .toml scene, or a mesh that a modelling program saves as .obj, .off, .ply or .stl");

  std::vector<std::string_view> names;
  for (const BuiltIn& built_in : built_in_scenes()) names.push_back(built_in.name);
  throw InputError(in_quotes(name_or_path), "there is no such scene",
                   fmt::format("name a .toml, .obj, .off, .ply or .stl file, write y = sin(x), or one of: {}",
                               fmt::join(names, ", ")));
}

}  // namespace

SceneFile load_scene(const std::string& name_or_path) {
  SceneFile file = load_any(name_or_path);
  make_printable(file.scene);
  return file;
}

SceneFile read_scene_text(const std::string& text, const std::filesystem::path& path) {
  SceneFile file = scene_from_text(text, path);
  make_printable(file.scene);
  return file;
}

bool names_formula(std::string_view name) { return is_formula(name); }

std::vector<BuiltIn> built_in_scenes() {
  const auto list = built_in_scene_list();
  return {list.begin(), list.end()};
}

}  // namespace zstep
