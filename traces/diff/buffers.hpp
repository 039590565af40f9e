// Two pictures held against each other, pixel by pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "traces/check/precision.hpp"
#include "traces/scene.hpp"

namespace zstep::diff {

struct BufferDifference {
  std::int64_t pixels = 0;         ///< of the picture
  std::int64_t colors = 0;         ///< of these, with another colour
  std::int64_t depths = 0;         ///< with another depth, by more than rounding
  std::int64_t depths_rounded = 0; ///< with another depth, within rounding
  double farthest = 0;             ///< the largest difference of two depths
  std::optional<std::int64_t> first;  ///< index of the first pixel with another colour or depth, as Picture::at counts
  std::vector<float> apart;  ///< by pixel: 0 where nothing differs; else a colour's or a depth's difference, in 0..1
};

/// Colours and depths of two pictures of the same size.
BufferDifference compare_pictures(const Picture& a, const Scene& scene_a, const Picture& b, const Scene& scene_b,
                                  const Precision& precision);
/// Depths alone, rows as Picture::at counts. Infinity and no_depth both mean that nothing was drawn.
BufferDifference compare_depths(std::span<const double> a, std::span<const double> b, const Precision& precision);
/// Colours alone, three bytes a pixel.
BufferDifference compare_colors(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

}  // namespace zstep::diff
