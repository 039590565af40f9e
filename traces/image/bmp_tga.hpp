// Pictures as short rasterisers write them: .tga and .bmp.
#pragma once

#include <filesystem>
#include <vector>

#include "traces/image/png.hpp"

namespace zstep {

/// Reads a .tga or .bmp as 8-bit RGB, the top row first; what is transparent in it has its colour all the same. Throws
/// InputError for what is neither, is damaged or has more than 2^26 pixels, and where zstep was built without stb.
Image read_bmp_or_tga(const std::filesystem::path& path);

}  // namespace zstep
