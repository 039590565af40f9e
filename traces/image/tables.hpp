// Tables of numbers and pictures as other programs write them: NumPy's .npy (numpy.lib.format; np.load() reads them as
// [height, width]) and .pfm.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <variant>
#include <vector>

#include "traces/image/png.hpp"

namespace zstep {

/// Write `values` [height * width], row-major, as an array of shape (height, width). Throw InputError when `path`
/// cannot be written and leave nothing half-written.
void write_npy(const std::filesystem::path& path, std::span<const std::int32_t> values, int height, int width);
void write_npy(const std::filesystem::path& path, std::span<const float> values, int height, int width);
void write_npy(const std::filesystem::path& path, std::span<const double> values, int height, int width);

struct Npy {
  int height = 0, width = 0;
  std::variant<std::vector<std::int32_t>, std::vector<float>, std::vector<double>> values;
};

/// Reads a two-dimensional .npy of format 1.0 to 3.0: whole numbers of any size as int32, float32 or float64; in either
/// byte order, rows or columns first.
/// Throws InputError for anything else, and for a file of more than `limit` bytes.
Npy read_npy(const std::filesystem::path& path, std::uintmax_t limit = std::uintmax_t{1} << 30);

// Tables of numbers as .pfm files (the portable float map: "Pf", width and height, scale; rows from the bottom up).

struct Pfm {
  int height = 0, width = 0;
  std::vector<float> values;  ///< [height * width], the top row first
};

/// Reads a grey one ("Pf"). Throws InputError for anything else.
Pfm read_pfm(const std::filesystem::path& path);

/// Reads a portable pixmap or graymap, as text (P2, P3) or bytes (P5, P6), with values up to 65535, as 8-bit RGB.
/// Throws InputError for anything else.
Image read_pnm(const std::filesystem::path& path);

}  // namespace zstep
