// Tables of numbers as NumPy's .npy files, version 1.0 (numpy.lib.format): np.load() reads them as [height, width].
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <variant>
#include <vector>

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

/// Reads a two-dimensional .npy of int32, float32 or float64 in this machine's byte order, rows first.
/// Throws InputError for anything else.
Npy read_npy(const std::filesystem::path& path);

}  // namespace zstep
