#include "traces/image/read_image.hpp"

#include <string>

#include "traces/error.hpp"
#include "traces/image/bmp_tga.hpp"
#include "traces/image/tables.hpp"
#include "traces/text.hpp"

namespace zstep {

namespace {

enum class Format : std::uint8_t { none, png, pnm, bmp_or_tga };

Format format_of(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".png") return Format::png;
  if (ending == ".ppm" || ending == ".pgm" || ending == ".pnm") return Format::pnm;
  return ending == ".tga" || ending == ".bmp" ? Format::bmp_or_tga : Format::none;
}

}  // namespace

bool is_image(const std::filesystem::path& path) { return format_of(path) != Format::none; }

Image read_image(const std::filesystem::path& path) {
  switch (format_of(path)) {
    case Format::png:
      return read_png(path);
    case Format::pnm:
      return read_pnm(path);
    case Format::bmp_or_tga:
      return read_bmp_or_tga(path);
    case Format::none:
      break;
  }
  throw InputError(path.string(), "is no picture that zstep reads", "convert it to .png");
}

}  // namespace zstep
