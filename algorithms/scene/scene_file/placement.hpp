// scale, rotate and translate of a [[mesh]].
#pragma once

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/scene_file/keys.hpp"

namespace zstep::scene {

/// Scaled first (a number or [x, y, z]), then rotated (degrees about the x axis, then y, then z), then translated.
Placement read_placement(Keys& keys, const std::string& file);

}  // namespace zstep::scene
