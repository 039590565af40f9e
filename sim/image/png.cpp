#include "sim/image/png.hpp"

#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <png.h>

#include "sim/image/file.hpp"
#include "traces/error.hpp"

namespace zstep {
namespace {

constexpr std::size_t channels = 3;

// libpng's simplified interface reports errors by return value, so no setjmp crosses C++ frames.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

std::size_t bytes_of(int width, int height) { return static_cast<std::size_t>(width) * height * channels; }

}  // namespace

std::vector<std::uint8_t> png_bytes(int width, int height, std::span<const std::uint8_t> rgb) {
  if (width <= 0 || height <= 0 || rgb.size() != bytes_of(width, height))
    throw std::invalid_argument(fmt::format("png_bytes: {} bytes do not make {}x{} pixels", rgb.size(), width, height));
  PngImage image;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(image));
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr))
    throw std::runtime_error(fmt::format("libpng: {}", image.message));
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb) {
  write_file(path, png_bytes(width, height, rgb));
}

Image read_png(const std::filesystem::path& path, std::uintmax_t most_bytes, std::size_t most_pixels) {
  const std::vector<std::uint8_t> bytes = read_file(path, most_bytes);
  const auto damaged = [&](const char* message) {
    return InputError(path.string(), fmt::format("is no PNG that can be read ({})", message), "give a whole PNG file");
  };
  PngImage image;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) throw damaged(image.message);
  if (static_cast<std::size_t>(image.width) * image.height > most_pixels)
    throw InputError(path.string(), fmt::format("has {}x{} pixels", image.width, image.height),
                     "give a smaller picture");
  image.format = PNG_FORMAT_RGB;
  Image result{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  result.rgb.resize(bytes_of(result.width, result.height));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&image, &white, result.rgb.data(), 0, nullptr)) throw damaged(image.message);
  return result;
}

}  // namespace zstep
