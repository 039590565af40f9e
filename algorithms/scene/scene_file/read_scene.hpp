// Scene files: the format is described in docs/scene-format.md.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/load.hpp"

namespace zstep::scene {

/// Gives the mesh that a scene file names, by the path as it is written there. Throws InputError.
using MeshFiles = std::function<PolygonSoup(const std::string& path)>;

/// Reads a scene. `name` is what errors call the file, `title` the scene's name if it states none. Throws InputError at
/// FILE:LINE on anything wrong with it.
SceneFile read_scene(std::string_view text, const std::string& name, const std::string& title, const MeshFiles& meshes);

/// The most bytes of a scene file; larger scenes are meshes.
inline constexpr std::size_t largest_scene_file = std::size_t{2} << 20;

}  // namespace zstep::scene
