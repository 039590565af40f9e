#include "traces/image/bmp_tga.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "traces/image/file.hpp"
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

std::size_t number_at(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return std::size_t{bytes[at]} | std::size_t{bytes[at + 1]} << 8 | std::size_t{bytes[at + 2]} << 16 |
         std::size_t{bytes[at + 3]} << 24;
}
constexpr std::size_t bmp_header = 34;  // as far as it is read here
/// A head as OS/2 had it.
bool is_old_bmp(const std::vector<std::uint8_t>& bytes) { return number_at(bytes, 14) == 12; }
std::size_t bits_of_pixel(const std::vector<std::uint8_t>& bytes) {
  return is_tga(bytes) ? bytes[16] : is_old_bmp(bytes) ? bytes[24] : bytes[28];
}

constexpr std::uint8_t tga_packed = 8;
/// Where the rows of a .tga begin, after a text and a palette.
std::size_t rows_of_tga(const std::vector<std::uint8_t>& bytes) {
  return tga_header + bytes[0] + (bytes[1] == 0 ? 0 : (bytes[5] | bytes[6] << 8) * ((bytes[7] + 7u) / 8));
}

/// Why a file is not read that is a .bmp or a .tga; empty where nothing is known against it.
std::string reason_not_to_read(const std::vector<std::uint8_t>& bytes) {
  const bool tga = is_tga(bytes);
  if (bytes.size() < (tga ? tga_header : bmp_header)) return "";
  constexpr std::size_t rle_8 = 1, rle_4 = 2;
  const std::size_t packing = tga || is_old_bmp(bytes) ? 0 : number_at(bytes, 30);
  if (packing == rle_8 || packing == rle_4) return "is a .bmp with packed rows (RLE), which zstep does not read";
  const auto is_short = [](std::size_t bits) { return bits == 15 || bits == 16; };
  constexpr std::size_t with_palette = 1;
  const bool by_palette = tga && bytes[1] == with_palette;
  if (is_short(by_palette ? bytes[7] : bits_of_pixel(bytes)) && !(tga && (bytes[2] & ~tga_packed) == 3))
    return "has 5 or 6 bits for each of red, green and blue, and those of a scene have 8: they would all differ";
  return "";
}

/// stb fills up with zeros what is missing.
bool is_cut_off(const std::vector<std::uint8_t>& bytes, const Image& image) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  if (!is_tga(bytes))
    return bytes.size() >= bmp_header &&
           bytes.size() < number_at(bytes, 10) + (width * bits_of_pixel(bytes) + 31) / 32 * 4 * height;
  const std::size_t of_pixel = (bits_of_pixel(bytes) + 7) / 8;
  std::size_t at = rows_of_tga(bytes), left = width * height;
  if ((bytes[2] & tga_packed) == 0) return bytes.size() < at + left * of_pixel;
  // A packet is a count, and so many pixels, or one that is repeated.
  while (left > 0 && at < bytes.size()) {
    const std::size_t count = (bytes[at] & 127u) + 1;
    at += 1 + ((bytes[at] & 128u) != 0 ? 1 : std::min(count, left)) * of_pixel, left -= std::min(count, left);
  }
  return left > 0 || at > bytes.size();
}

}  // namespace

Image read_bmp_or_tga(const std::filesystem::path& path) {
  constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 29;  // stb counts them as int
  constexpr std::int64_t most_pixels = std::int64_t{1} << 26;
  const std::vector<std::uint8_t> bytes = read_file(path, most_bytes);
  const auto fail = [&](const std::string& what) {
    throw InputError(path.string(), what, "write it again, or convert it to .png or .ppm");
  };
  if (const std::string reason = reason_not_to_read(bytes); !reason.empty())
    throw InputError(path.string(), reason, "write it with 24 bits a pixel, not packed, or convert it to .png");
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
  if (is_cut_off(bytes, image)) fail("is cut off: it has not all of its rows");
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
