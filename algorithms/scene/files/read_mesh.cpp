#include "algorithms/scene/files/read_mesh.hpp"

#include <algorithm>
#include <system_error>

#include "algorithms/scene/files/bytes.hpp"
#include "traces/error.hpp"

namespace zstep::scene {

std::optional<MeshFormat> mesh_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
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

PolygonSoup read_mesh(const std::filesystem::path& path) {
  const auto format = mesh_format(path);
  if (!format) throw InputError(path.string(), "its extension names no mesh format", "use .obj, .off, .ply or .stl");
  const std::string bytes = read_bytes(path);
  PolygonSoup soup;
  if (*format == MeshFormat::obj) {
    // Only from the mesh's own folder: a mesh from the net must not make zstep open files elsewhere.
    const auto materials = [&](const std::string& file_name) -> std::optional<std::string> {
      const std::filesystem::path plain = std::filesystem::path(file_name).filename();
      const std::filesystem::path beside = path.parent_path() / plain;
      std::error_code error;
      if (plain.empty() || plain.string() != file_name || !std::filesystem::is_regular_file(beside, error))
        return std::nullopt;
      return read_bytes(beside, std::size_t{4} << 20);
    };
    soup = read_obj(bytes, path.string(), materials);
  } else {
    soup = read_mesh_bytes(*format, bytes, path.string());
  }
  if (soup.outlines.empty()) throw InputError(path.string(), "the mesh has no polygons", "give one that has faces");
  return soup;
}

}  // namespace zstep::scene
