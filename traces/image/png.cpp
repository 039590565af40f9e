#include "traces/image/png.hpp"

#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <png.h>

#include "traces/image/file.hpp"
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

namespace {

InputError damaged(const std::filesystem::path& path, const char* message) {
  return {path.string(), fmt::format("is no PNG that can be read ({})", message), "give a whole PNG file"};
}
void begin_read(PngImage& image, const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path,
                std::size_t most_pixels) {
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) throw damaged(path, image.message);
  if (static_cast<std::size_t>(image.width) * image.height > most_pixels)
    throw InputError(path.string(), fmt::format("has {}x{} pixels", image.width, image.height),
                     "give a smaller picture");
}

}  // namespace

Image read_png(const std::filesystem::path& path, std::uintmax_t most_bytes, std::size_t most_pixels) {
  const std::vector<std::uint8_t> bytes = read_file(path, most_bytes);
  PngImage image;
  begin_read(image, bytes, path, most_pixels);
  image.format = PNG_FORMAT_RGB;
  Image result{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  result.rgb.resize(bytes_of(result.width, result.height));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&image, &white, result.rgb.data(), 0, nullptr)) throw damaged(path, image.message);
  return result;
}

std::optional<Grey16> read_grey16(const std::filesystem::path& path) {
  constexpr std::size_t most_pixels = std::size_t{1} << 26;
  const std::vector<std::uint8_t> bytes = read_file(path);
  PngImage image;
  begin_read(image, bytes, path, most_pixels);
  if (image.format != PNG_FORMAT_LINEAR_Y) return std::nullopt;
  Grey16 result{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  result.values.resize(static_cast<std::size_t>(image.width) * image.height);
  if (!png_image_finish_read(&image, nullptr, result.values.data(), 0, nullptr)) throw damaged(path, image.message);
  return result;
}

}  // namespace zstep
