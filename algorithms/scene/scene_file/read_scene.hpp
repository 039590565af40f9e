// Scene files, read: the format is described in docs/scene-format.md.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/scene_file/toml_text.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

// [raster], [camera] and [options] of a scene file.

// `top` is the whole scene's table, `screen` whether it is in screen coordinates. All throw InputError.

void read_raster(Keys& top, const std::string& file, bool screen, Raster& raster);
/// Leaves rho, near and far at 0 where they are to come from the extent.
void read_camera(Keys& top, const std::string& file, bool screen, Camera& camera);
/// `two_sided`: back faces are drawn unless it says otherwise.
void read_options(Keys& top, const std::string& file, bool two_sided, Conventions& conventions);

/// Gives the mesh that a scene file names, by the path as it is written there. Throws InputError.
using MeshFiles = std::function<PolygonSoup(const std::string& path)>;

/// Reads a scene. `name` is what errors call the file, `title` the scene's name if it states none. Throws InputError at
/// FILE:LINE on anything wrong with it.
SceneFile read_scene(std::string_view text, const std::string& name, const std::string& title, const MeshFiles& meshes);

/// The most bytes of a scene file; larger scenes are meshes.
inline constexpr std::size_t largest_scene_file = std::size_t{2} << 20;

}  // namespace zstep::scene
