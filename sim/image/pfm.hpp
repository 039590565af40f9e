// Tables of numbers as .pfm files (the portable float map: "Pf", width and height, scale; rows from the bottom up).
#pragma once

#include <filesystem>
#include <vector>

namespace zstep {

struct Pfm {
  int height = 0, width = 0;
  std::vector<float> values;  ///< [height * width], the top row first
};

/// Reads a grey one ("Pf"). Throws InputError for anything else.
Pfm read_pfm(const std::filesystem::path& path);

}  // namespace zstep
