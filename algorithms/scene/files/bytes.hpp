// Files read whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace zstep::scene {

/// No file larger than this is read: 256 MiB, more than any mesh within the limits of polygon_soup.hpp needs.
inline constexpr std::size_t largest_file = std::size_t{256} << 20;

/// The file's bytes. Throws InputError if it does not exist, is no regular file (a folder, a device, a pipe), is larger
/// than `limit` bytes, or cannot be read.
std::string read_bytes(const std::filesystem::path& path, std::size_t limit = largest_file);

}  // namespace zstep::scene
