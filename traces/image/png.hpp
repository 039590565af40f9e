// Pictures as PNG files, and charts as a picture and as SVG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace zstep {

/// Three bytes a pixel (red, green, blue; sRGB), row-major, the top row first.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< [height * width * 3]
  bool operator==(const Image&) const = default;
};

/// `rgb` [height * width * 3] as an 8-bit RGB PNG. The same pixels give the same bytes.
std::vector<std::uint8_t> png_bytes(int width, int height, std::span<const std::uint8_t> rgb);
/// Writes that to a file.
/// Throws InputError when `path` cannot be written (no such folder, disk full) and leaves nothing half-written.
void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb);

/// Reads any PNG as 8-bit RGB. Throws InputError for what is no PNG, is damaged, or has more than so many bytes or
/// pixels.
Image read_png(const std::filesystem::path& path, std::uintmax_t most_bytes = std::uintmax_t{1} << 30,
               std::size_t most_pixels = std::size_t{1} << 26);

/// A picture of shades alone.
struct Grey16 {
  int width = 0, height = 0;
  std::vector<std::uint16_t> values;  ///< [height * width], the top row first
};
/// Reads a PNG of 16 bits a pixel without colours; nothing of another PNG. Throws InputError as read_png() does.
std::optional<Grey16> read_grey16(const std::filesystem::path& path);

/// A chart as a picture, and the same as SVG.
struct Drawing : Image {
  std::string svg;
};

}  // namespace zstep
