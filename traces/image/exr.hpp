// Depths as renderers write them into OpenEXR files.
#pragma once

#include <filesystem>

#include "traces/image/tables.hpp"

namespace zstep {

/// Reads the channel Z of a .exr, of half or single floats, else its only channel; the top row first. Throws InputError
/// for a file with other channels alone, in tiles or in several parts, for what is no .exr or is damaged, for one of
/// more than 2^26 pixels, and where zstep was built without tinyexr.
Pfm read_exr(const std::filesystem::path& path);

}  // namespace zstep
