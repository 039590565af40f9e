// A scene that is one surface y = f(x, z).
#pragma once

#include <string>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/load.hpp"

namespace zstep::scene {

/// Samples `surface` into `file`, whose camera, raster and conventions stay as they are. Throws InputError at `where`
/// for a formula that cannot be read or has no value somewhere.
SceneFile surface_scene(Surface surface, const std::string& where, SceneFile file, const SceneBuilder::Style& style);

/// The scene that a formula alone stands for: default ranges, seen from above.
SceneFile formula_scene(const std::string& formula);

}  // namespace zstep::scene
