// The scene as it stands in a trace file: small things as JSON, arrays as columns.
#pragma once

#include "traces/file/container.hpp"
#include "traces/scene.hpp"

namespace zstep {

Bytes scene_to_bytes(const Scene& scene);
/// Throws MalformedBytes or MalformedJson; the scene it returns has been checked.
Scene scene_from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace zstep
