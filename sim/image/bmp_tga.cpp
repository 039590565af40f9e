#include "sim/image/bmp_tga.hpp"

#include <cstdint>
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
  if (image.width < 1 || image.height < 1 || std::int64_t{image.width} * image.height > most_pixels)
    fail(fmt::format("has {}x{} pixels, which is no size for a picture", image.width, image.height));
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(bytes.data(), size, &image.width, &image.height, &channels, 3), &stbi_image_free);
  if (!pixels) fail(fmt::format("is damaged ({})", stbi_failure_reason()));
  image.rgb.assign(pixels.get(), pixels.get() + std::size_t{3} * static_cast<std::size_t>(image.width) *
                                                    static_cast<std::size_t>(image.height));
  return image;
}

#else

Image read_bmp_or_tga(const std::filesystem::path& path) {
  throw InputError(path.string(), "is not read: this zstep was built without stb, which reads .bmp and .tga",
                   "convert it to .png or .ppm");
}

#endif

}  // namespace zstep
