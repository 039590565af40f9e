// Meshes from files: OBJ, OFF, PLY and STL, read by zstep's own checked readers (docs/architecture.md, "Reading
// meshes").
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "algorithms/scene/files/polygon_soup.hpp"

namespace zstep::scene {

enum class MeshFormat : std::uint8_t { obj, off, ply, stl };

/// The format that the file's extension stands for, in any case; nothing if it stands for none.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);

struct MaterialFile {
  std::string path;  ///< what notes call it
  std::string text;
};
/// Gives the material file that an OBJ names, or nothing where there is none.
using MaterialFiles = std::function<std::optional<MaterialFile>(std::string_view named)>;

/// Whether a statement of a material file names a texture.
bool is_texture(std::string_view statement);

// The readers. `name` is what errors call the file. All throw InputError, and nothing else, on anything wrong in
// `bytes`: at FILE:LINE in text, at FILE:byte N in binary. Time and memory are bounded by the number of bytes, never by
// a count that the file declares.

/// OBJ: v, vt, vn, f with negative indices, usemtl with Kd, d, Ni and map_Kd of its mtllib, whose faults are notes.
/// Points and lines (p, l) are passed over; free-form surfaces are an error.
PolygonSoup read_obj(std::string_view bytes, const std::string& name, const MaterialFiles& materials);
/// OFF with the prefixes C, N, ST and 4, and colours of faces.
PolygonSoup read_off(std::string_view bytes, const std::string& name);
/// PLY 1.0, ascii and binary of both byte orders; red, green, blue and texcoord of faces, all numbers of vertices, and
/// the first TextureFile of its comments.
PolygonSoup read_ply(std::string_view bytes, const std::string& name);
/// STL, ascii and binary, with colours of its triangles. Equal points become one, so that neighbours share their
/// vertices.
PolygonSoup read_stl(std::string_view bytes, const std::string& name);

/// Reads the images that the soup's materials name, found by `find` from the names as they stand. What cannot be had is
/// a note, and those materials have no texture then.
using ImageFinder = std::function<std::optional<std::filesystem::path>(std::string_view named)>;
void load_textures(PolygonSoup& soup, const ImageFinder& find);

/// A file that a mesh or a scene names, in its folder or below: one from the net must not make zstep open files
/// elsewhere. A name that leads elsewhere, as the full path where it was made, is looked for by its last part.
std::optional<std::filesystem::path> beside_mesh(const std::filesystem::path& folder, std::string_view named);

/// The readers by format; an OBJ without materials.
PolygonSoup read_mesh_bytes(MeshFormat format, std::string_view bytes, const std::string& name);
/// Reads a mesh file, an OBJ with the material files of its own folder. Throws InputError, also for a mesh without
/// polygons.
PolygonSoup read_mesh(const std::filesystem::path& path);

}  // namespace zstep::scene
