#include "sim/image/bmp_tga.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>

#include "sim/image/file.hpp"
#include "traces/error.hpp"

#if ZSTEP_HAS_STB
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image.h>
#pragma GCC diagnostic pop
#endif

namespace zstep {

#if ZSTEP_HAS_STB

namespace {

constexpr std::size_t tga_header = 18, tga_descriptor = 17;

bool is_tga(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() >= tga_header && !(bytes[0] == 'B' && bytes[1] == 'M');
}

/// Of rows that are not packed: stb fills up with zeros what is missing.
std::size_t bytes_needed(const std::vector<std::uint8_t>& bytes, const Image& image) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  if (is_tga(bytes)) {
    constexpr std::uint8_t packed = 8;
    const std::size_t bits = bytes[16], map = bytes[1] == 0 ? 0 : (bytes[5] | bytes[6] << 8) * ((bytes[7] + 7u) / 8);
    return (bytes[2] & packed) != 0 ? 0 : tga_header + bytes[0] + map + width * height * ((bits + 7) / 8);
  }
  if (bytes.size() < 30) return 0;
  const auto number = [&](std::size_t at) {
    return std::size_t{bytes[at]} | std::size_t{bytes[at + 1]} << 8 | std::size_t{bytes[at + 2]} << 16 |
           std::size_t{bytes[at + 3]} << 24;
  };
  const bool is_old = number(14) == 12;  // the head of OS/2
  const std::size_t bits = is_old ? bytes[24] : bytes[28];
  return number(10) + (width * bits + 31) / 32 * 4 * height;
}

}  // namespace

Image read_bmp_or_tga(const std::filesystem::path& path) {
  constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 29;  // stb counts them as int
  constexpr std::int64_t most_pixels = std::int64_t{1} << 26;
  const std::vector<std::uint8_t> bytes = read_file(path, most_bytes);
  const auto fail = [&](const std::string& what) {
    throw InputError(path.string(), what, "write it again, or convert it to .png or .ppm");
  };
  const int size = static_cast<int>(bytes.size());
  Image image;
  int channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &image.width, &image.height, &channels) == 0)
    fail(fmt::format("is no .bmp or .tga that can be read ({})", stbi_failure_reason()));
  image.height = std::abs(image.height);  // a .bmp whose top row comes first has it negative
  if (image.width < 1 || image.height < 1 || std::int64_t{image.width} * image.height > most_pixels)
    fail(fmt::format("has {}x{} pixels, which is no size for a picture", image.width, image.height));
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(bytes.data(), size, &image.width, &image.height, &channels, 3), &stbi_image_free);
  if (!pixels) fail(fmt::format("is damaged ({})", stbi_failure_reason()));
  if (bytes.size() < bytes_needed(bytes, image)) fail("is cut off: it has not all of its rows");
  const std::size_t row = std::size_t{3} * static_cast<std::size_t>(image.width);
  image.rgb.assign(pixels.get(), pixels.get() + row * static_cast<std::size_t>(image.height));
  if (is_tga(bytes) && (bytes[tga_descriptor] & 0x10) != 0)  // from right to left, which stb passes over
    for (std::size_t begin = 0; begin < image.rgb.size(); begin += row)
      for (std::size_t x = 0; x < row / 6; ++x)
        std::swap_ranges(&image.rgb[begin + 3 * x], &image.rgb[begin + 3 * x] + 3, &image.rgb[begin + row - 3 * x - 3]);
  return image;
}

#else

Image read_bmp_or_tga(const std::filesystem::path& path) {
  throw InputError(path.string(), "is not read: this zstep was built without stb, which reads .bmp and .tga",
                   "convert it to .png or .ppm");
}

#endif

}  // namespace zstep
