#include "algorithms/scene/files/read_mesh.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <system_error>
#include <utility>

#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/image/read_image.hpp"
#include "traces/text.hpp"

namespace zstep::scene {

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".off") return MeshFormat::off;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  return std::nullopt;
}

PolygonSoup read_mesh_bytes(MeshFormat format, std::string_view bytes, const std::string& name) {
  switch (format) {
    case MeshFormat::obj:
      return read_obj(bytes, name, [](std::string_view) { return std::nullopt; });
    case MeshFormat::off:
      return read_off(bytes, name);
    case MeshFormat::ply:
      return read_ply(bytes, name);
    case MeshFormat::stl:
      return read_stl(bytes, name);
  }
  throw InputError(name, "unknown mesh format", "use .obj, .off, .ply or .stl");
}

namespace {

/// All images belong to a mesh, also those that are not read: they must not be written over.
void note_textures(const std::filesystem::path& folder, std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const bool texture = line.starts_with("comment TextureFile ") || is_texture(line);
    const std::size_t last = line.find_last_of(" \t");
    if (texture && last != std::string_view::npos) note_input(folder / std::filesystem::path(line.substr(last + 1)));
  }
}

namespace fs = std::filesystem;

/// The entry of this name in a folder; else one whose name differs only in capitals, the first of them.
fs::path entry_of(const fs::path& folder, const fs::path& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  const std::string wanted = lower_case(name.string());
  fs::path found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path other = entry->path().filename();
    if (lower_case(other.string()) == wanted && (found.empty() || other < found)) found = other;
  }
  return found.empty() ? found : folder / found;
}

/// Whether a folder is `top` or lies in it, whatever links lead there.
bool is_within(const fs::path& folder, const fs::path& top) {
  std::error_code error;
  const fs::path inner = fs::canonical(folder, error);
  if (error) return false;
  const fs::path outer = fs::canonical(top, error);
  if (error) return false;
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace

std::optional<fs::path> beside_mesh(const fs::path& folder, std::string_view named) {
  if (named.size() >= 2 && named.front() == '"' && named.back() == '"') named = named.substr(1, named.size() - 2);
  std::string slashes(named);
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const fs::path plain = fs::path(slashes).lexically_normal();
  const fs::path top = folder.empty() ? fs::path(".") : folder;
  const auto found_at = [&](const fs::path& relative) -> std::optional<fs::path> {
    fs::path found = top;
    for (const fs::path& part : relative) {
      if (part.empty() || part == ".." || !is_within(found, top)) return std::nullopt;
      found = entry_of(found, part);
      if (found.empty()) return std::nullopt;
    }
    std::error_code error;
    if (!fs::is_regular_file(found, error)) return std::nullopt;
    return folder.empty() ? found.lexically_normal() : found;
  };
  if (plain.is_relative())
    if (const auto found = found_at(plain)) return found;
  return found_at(plain.filename());
}

bool is_texture(std::string_view statement) {
  constexpr std::array<std::string_view, 6> beginnings{"map_", "bump", "disp", "decal", "norm", "refl"};
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view word) { return statement.starts_with(word); });
}

namespace {

/// Throws InputError where it cannot be read, or has more texels than are left.
Texture read_texture(const fs::path& path, std::int64_t left) {
  if (!is_image(path)) throw InputError(path.string(), "is no picture that zstep reads", "convert it to .png");
  const Image image = read_image(path);
  if (std::int64_t{image.width} * image.height > left)
    throw InputError(path.string(),
                     fmt::format("has {} x {} texels, and the scene's textures {} at most together", image.width,
                                 image.height, most_texels),
                     "make it smaller");
  Texture texture{path.string(), image.width, image.height, {}};
  texture.texels.reserve(image.rgb.size() / 3);
  for (std::size_t k = 0; k + 2 < image.rgb.size(); k += 3)
    texture.texels.push_back({image.rgb[k], image.rgb[k + 1], image.rgb[k + 2]});
  return texture;
}

}  // namespace

void load_textures(PolygonSoup& soup, const ImageFinder& find) {
  std::vector<std::int32_t> number_of(soup.named_textures.size(), no_texture);
  std::int64_t left = most_texels;
  for (std::size_t k = 0; k < number_of.size(); ++k) {
    const auto& [named, where] = soup.named_textures[k];
    try {
      const auto path = find(named);
      if (!path)
        throw InputError(where, fmt::format("there is no image {} in this folder or below", in_quotes(named)),
                         "put it there");
      note_input(*path);
      soup.textures.push_back(read_texture(*path, left));
      left -= std::ssize(soup.textures.back().texels);
      number_of[k] = index32(soup.textures.size() - 1);
    } catch (const InputError& error) {
      soup.notes.push_back(fmt::format("{}; this texture is left out", error.what()));
    }
  }
  soup.named_textures.clear();
  for (Material& material : soup.materials)
    if (material.texture != no_texture) material.texture = number_of[static_cast<std::size_t>(material.texture)];
}

PolygonSoup read_mesh(const std::filesystem::path& path) {
  const auto format = mesh_format(path);
  if (!format) throw InputError(path.string(), "its extension names no mesh format", "use .obj, .off, .ply or .stl");
  const std::string bytes = read_bytes(path);
  PolygonSoup soup;
  if (*format == MeshFormat::ply)
    note_textures(path.parent_path(), std::string_view(bytes).substr(0, bytes.find("end_header")));
  if (*format == MeshFormat::obj) {
    const auto materials = [&](std::string_view named) -> std::optional<MaterialFile> {
      const auto file = beside_mesh(path.parent_path(), named);
      if (!file) return std::nullopt;
      std::string text = read_bytes(*file, std::size_t{4} << 20);
      note_textures(file->parent_path(), text);
      return MaterialFile{file->string(), std::move(text)};
    };
    soup = read_obj(bytes, path.string(), materials);
  } else {
    soup = read_mesh_bytes(*format, bytes, path.string());
  }
  // A material file may lie in a folder below: its images are looked for from the mesh's.
  load_textures(soup, [&](std::string_view named) { return beside_mesh(path.parent_path(), named); });
  if (soup.outlines.empty())
    throw InputError(path.string(),
                     soup.points.empty()
                         ? std::string("the mesh has no polygons")
                         : fmt::format("the mesh has no polygons, only vertices ({})", soup.points.size()),
                     "give one that has faces");
  return soup;
}

}  // namespace zstep::scene
