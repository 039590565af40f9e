// Pictures in whatever format their name says.
#pragma once

#include <filesystem>

#include "traces/image/png.hpp"

namespace zstep {

/// Whether a file of this name is a picture of colours that can be read: .png, .ppm, .pgm, .pnm, .tga, .bmp, in
/// capitals or not.
bool is_image(const std::filesystem::path& path);
/// Reads it as 8-bit RGB, the top row first. Throws InputError for a name of another kind, and for what is not as its
/// name says or is damaged.
Image read_image(const std::filesystem::path& path);

}  // namespace zstep
