#include "algorithms/scene/files/read_mesh.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "algorithms/scene/files/bytes.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
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
      return read_obj(bytes, name, [](const std::string&) { return std::nullopt; });
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

/// Textures belong to a mesh, too, though they are not drawn: they must not be written over.
void note_textures(const std::filesystem::path& folder, std::string_view text) {
  constexpr std::array<std::string_view, 6> statements{"map_", "bump", "disp", "decal", "norm", "refl"};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const bool texture = line.starts_with("comment TextureFile ") ||
                         std::any_of(statements.begin(), statements.end(),
                                     [&](std::string_view word) { return line.starts_with(word); });
    const std::size_t last = line.find_last_of(" \t");
    if (texture && last != std::string_view::npos) note_input(folder / std::filesystem::path(line.substr(last + 1)));
  }
}

}  // namespace

PolygonSoup read_mesh(const std::filesystem::path& path) {
  const auto format = mesh_format(path);
  if (!format) throw InputError(path.string(), "its extension names no mesh format", "use .obj, .off, .ply or .stl");
  const std::string bytes = read_bytes(path);
  PolygonSoup soup;
  if (*format == MeshFormat::ply)
    note_textures(path.parent_path(), std::string_view(bytes).substr(0, bytes.find("end_header")));
  if (*format == MeshFormat::obj) {
    // Only from the mesh's own folder: a mesh from the net must not make zstep open files elsewhere.
    const auto materials = [&](const std::string& file_name) -> std::optional<std::string> {
      const std::filesystem::path plain = std::filesystem::path(file_name).filename();
      const std::filesystem::path beside = path.parent_path() / plain;
      std::error_code error;
      if (plain.empty() || plain.string() != file_name || !std::filesystem::is_regular_file(beside, error))
        return std::nullopt;
      std::string text = read_bytes(beside, std::size_t{4} << 20);
      note_textures(path.parent_path(), text);
      return text;
    };
    soup = read_obj(bytes, path.string(), materials);
  } else {
    soup = read_mesh_bytes(*format, bytes, path.string());
  }
  if (soup.outlines.empty()) throw InputError(path.string(), "the mesh has no polygons", "give one that has faces");
  return soup;
}

}  // namespace zstep::scene
