// Tables of a picture's values in the order in which files have them.
#pragma once

#include <cstdint>
#include <vector>

namespace zstep {

/// The values [height*width] from the top row to the bottom one; `y_up`: the picture's row 0 is the bottom one.
template <class Out, class In, class Function>
std::vector<Out> top_row_first(const std::vector<In>& values, std::int32_t width, std::int32_t height, bool y_up,
                               Function&& convert) {
  std::vector<Out> result;
  result.reserve(values.size());
  for (std::int32_t row = 0; row < height; ++row) {
    const auto begin = static_cast<std::size_t>(y_up ? height - 1 - row : row) * static_cast<std::size_t>(width);
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) result.push_back(convert(values[begin + x]));
  }
  return result;
}

}  // namespace zstep
