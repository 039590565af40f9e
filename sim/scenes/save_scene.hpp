// Keeps the scene of a run as a scene file, as it was changed in the window or on the command line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "traces/scene.hpp"

namespace zstep {

/// What to call a file made from this scene, without extension: "teapot", "bunny" for meshes/bunny.obj.
std::string file_stem(const Scene& scene);

/// NAME-changed.toml in a folder, or the first of NAME-changed-2.toml, -3, … that is not there.
std::filesystem::path name_for_changed(const Scene& scene, const std::filesystem::path& folder);

/// Writes the scene file, in one piece: a file that was there stays until the new one is whole. Gives what a reader
/// should know beside its name, in sentences: what could not be kept as it stood, and the command that gives what a
/// scene file does not hold; mostly empty. Throws InputError.
std::string save_scene(const std::filesystem::path& path, const Scene& scene, const Conventions& conventions,
                       std::string_view method);

}  // namespace zstep
