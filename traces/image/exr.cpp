#include "traces/image/exr.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/image/file.hpp"

#if ZSTEP_HAS_TINYEXR
#include <tinyexr.h>
#endif

namespace zstep {

#if ZSTEP_HAS_TINYEXR

namespace {

constexpr int most_channels = 64;
constexpr std::int64_t most_side = std::int64_t{1} << 20, most_pixels = std::int64_t{1} << 26;

/// The channel of depths; -1 where none is.
int depths_of(const EXRHeader& header) {
  for (int k = 0; k < header.num_channels; ++k)
    if (const std::string_view name = header.channels[k].name; name == "Z" || name.ends_with(".Z")) return k;
  return header.num_channels == 1 ? 0 : -1;
}

}  // namespace

Pfm read_exr(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  const char* reason = nullptr;
  const auto fail = [&](const std::string& what) {
    const std::string because = reason ? fmt::format(" ({})", reason) : "";
    if (reason) FreeEXRErrorMessage(reason);
    throw InputError(path.string(), what + because, "write its depths as .pfm or .npy");
  };
  EXRVersion version;
  if (ParseEXRVersionFromMemory(&version, bytes.data(), bytes.size()) != TINYEXR_SUCCESS) fail("is no .exr");
  if (version.multipart || version.non_image || version.tiled) fail("is a .exr in tiles or of several parts");
  EXRHeader header;
  InitEXRHeader(&header);
  if (ParseEXRHeaderFromMemory(&header, &version, bytes.data(), bytes.size(), &reason) != TINYEXR_SUCCESS)
    fail("is a damaged .exr");
  // What tinyexr could not make it has freed itself.
  const std::unique_ptr<EXRHeader, decltype(&FreeEXRHeader)> made_header(&header, &FreeEXRHeader);
  const EXRBox2i& window = header.data_window;
  const std::int64_t width = std::int64_t{window.max_x} - window.min_x + 1,
                     height = std::int64_t{window.max_y} - window.min_y + 1;
  if (width < 1 || height < 1 || width > most_side || height > most_side || width * height > most_pixels)
    fail(fmt::format("has {} x {} pixels, which is no size for a picture", width, height));
  if (header.num_channels > most_channels) fail(fmt::format("has more than {} channels", most_channels));
  const int channel = depths_of(header);
  if (channel < 0) fail("has no channel Z, of depths");
  if (header.pixel_types[channel] == TINYEXR_PIXELTYPE_UINT) fail("has whole numbers for depths");
  for (int k = 0; k < header.num_channels; ++k)
    if (header.pixel_types[k] == TINYEXR_PIXELTYPE_HALF) header.requested_pixel_types[k] = TINYEXR_PIXELTYPE_FLOAT;
  EXRImage pixels;
  InitEXRImage(&pixels);
  if (LoadEXRImageFromMemory(&pixels, &header, bytes.data(), bytes.size(), &reason) != TINYEXR_SUCCESS)
    fail("is a damaged .exr");
  const std::unique_ptr<EXRImage, decltype(&FreeEXRImage)> made_pixels(&pixels, &FreeEXRImage);
  if (pixels.images == nullptr || pixels.width != width || pixels.height != height) fail("is a damaged .exr");
  const auto* const first = reinterpret_cast<const float*>(pixels.images[channel]);
  return {static_cast<int>(height), static_cast<int>(width), std::vector<float>(first, first + width * height)};
}

#else

Pfm read_exr(const std::filesystem::path& path) {
  throw InputError(path.string(), "is not read: this zstep was built without tinyexr, which reads .exr",
                   "write its depths as .pfm or .npy");
}

#endif

}  // namespace zstep
