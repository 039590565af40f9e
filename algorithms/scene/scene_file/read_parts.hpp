// [light], [surface] and the keys of materials.
#pragma once

#include <optional>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/scene_file/keys.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

/// opacity, reflectance and refraction, as far as they stand there.
MaterialKeys read_material(Keys& keys, const std::string& file);

/// The [light] of `top`, if there is one; window, near and far are 0 where they are to come from the extent.
std::optional<Light> read_light(Keys& top, const std::string& file, bool screen);

/// The formula, ranges and numbers of samples of a [surface]; what is not there is as in default_surface.
Surface read_surface(Keys& keys, const std::string& file);

}  // namespace zstep::scene
