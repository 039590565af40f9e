// Scenes and meshes that come with zstep.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/load.hpp"

namespace zstep::scene {

/// The built-in scene's text, in the format of scene files; nothing if no scene has this name. Throws InputError for a
/// scene that exists at an impossible level ("teapot:0").
std::optional<std::string> built_in_scene(const std::string& name);

/// All scenes in the order of `zstep list`.
std::span<const BuiltIn> built_in_scene_list();

/// A mesh for `builtin = …` of a scene file: "cube", "pyramid", "dodecahedron", "teapot", "teapot:N". Outlines run
/// counter-clockwise seen from outside. Nothing if there is no such mesh; throws InputError at `where` for an
/// impossible level.
std::optional<PolygonSoup> built_in_mesh(const std::string& name, const std::string& where = "built-in mesh");
std::vector<std::string_view> built_in_meshes();

/// Newell's teapot, each patch cut into level x level pieces: quadrangles, and triangles at the knob's pole. z is up,
/// the spout points along x; it is centred at the origin and reaches from x = -1 to 1.
PolygonSoup teapot(int level);
inline constexpr int default_teapot_level = 8, highest_teapot_level = 64;

/// The level in "teapot:12"; the default level for "teapot"; nothing for any other name. Throws InputError at `where`.
std::optional<int> teapot_level(const std::string& name, const std::string& where);

}  // namespace zstep::scene
