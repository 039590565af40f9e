// Scenes by name or by path.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "traces/scene.hpp"

namespace zstep {

/// What a command line (or a lesson) may change about a scene's camera and raster. Unset: the scene's own, or the
/// default.
struct ViewOptions {
  std::optional<double> rho, theta, phi, d, window, near, far;
  std::optional<Camera::DepthRange> depth_range;
  std::optional<bool> orthographic;
  std::optional<std::int32_t> width, height;
  std::optional<bool> y_up, corners;
  bool fit = false;  ///< bounding box's centre to the origin, farthest vertex at distance 1
};

/// A scene as its file says, before it is looked at: camera.rho, near and far of camera and light, and the
/// light's window may be 0, which means "from the extent".
struct SceneFile {
  Scene scene;
  Conventions conventions;            ///< the scene's own, where it states any
  std::vector<Color> unlit_colors{};  ///< of each polygon, before light was put on those that bring no colour
  std::vector<std::string> notes;  ///< what a user should know about it, a sentence each: holes, polygons not drawn, …
};

/// Loads a scene: the name of a built-in one ("pyramid", "teapot", "teapot:8" for a level of tessellation), a scene
/// file (.toml), a mesh (.obj .off .ply .stl), or a surface by its formula ("y = sin(x) * cos(z)"). Throws InputError
/// with FILE:LINE on anything wrong with it.
SceneFile load_scene(const std::string& name_or_path);

/// A scene from the text of a file that is, or will be, at `path`: meshes are found from its folder. Throws as
/// load_scene.
SceneFile read_scene_text(const std::string& text, const std::filesystem::path& path);

/// Whether a scene's name is a formula: "y = …".
bool names_formula(std::string_view name);

/// Where light is computed at vertices or pixels (the shade of these conventions), gives vertices without a normal the
/// mean of those of the polygons round them, by their areas.
void give_normals(Scene& scene, const Conventions& conventions);
/// The same, and polygons have their colours before any light.
void prepare_for_shade(SceneFile& file, const Conventions& conventions);

/// Applies the options and completes the camera (view matrix, eye, near and far) and the light. What the algorithms
/// may run on.
/// Throws InputError on impossible options (near >= far, a size of 0, …).
Scene look_at_scene(Scene scene, const ViewOptions& options);

/// Built-in scenes, for `zstep list`.
struct BuiltIn {
  std::string_view name, description;
};
std::vector<BuiltIn> built_in_scenes();

}  // namespace zstep
