// Two pictures held against each other, pixel by pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "traces/check/precision.hpp"
#include "traces/file/trace.hpp"
#include "traces/scene.hpp"

namespace zstep::diff {

struct BufferDifference {
  std::int64_t pixels = 0;      ///< of the picture
  std::int64_t colors = 0;      ///< of these, with another colour
  std::int64_t depths = 0;      ///< with another depth, by more than rounding; of these
  std::int64_t only_a = 0;      ///< …drawn in A alone,
  std::int64_t only_b = 0;      ///< …in B alone,
  std::int64_t not_finite = 0;  ///< …drawn in both, and the one depth is no finite number, as the other is or is not
  std::int64_t depths_rounded = 0;                ///< with another depth, within rounding
  double farthest = 0;                            ///< the largest difference of two finite depths
  bool depths_compared = true;                    ///< false where one of the two has none
  double empty_a = no_depth, empty_b = no_depth;  ///< what stands where nothing was drawn
  std::optional<std::int64_t> first;  ///< index of the first pixel with another colour or depth, as Picture::at counts
  std::vector<float> apart;  ///< by pixel: 0 where nothing differs; else a colour's or a depth's difference, in 0..1
};

/// What is in the buffers of a run.
struct Buffers {
  const Picture& picture;
  const Scene& scene;
  double empty = no_depth;  ///< the depth of a pixel where nothing was drawn
  bool has_depths = true;   ///< false of methods that keep none
};
Buffers buffers_of(const Trace& trace, const Picture& picture);

/// Colours and depths of two pictures of the same size. Where nothing is drawn in either, depths are the same, whatever
/// the buffers were cleared to; a NaN or an infinity that was drawn is equal to no number.
BufferDifference compare_pictures(const Buffers& a, const Buffers& b, const Precision& precision);
/// Depths alone, rows as Picture::at counts, of a run and of another program's file. In the run `empty_a` and
/// infinities mean that nothing was drawn; in the file infinities, what stands at most pixels where the run has
/// nothing, and at these NaN.
BufferDifference compare_depths(std::span<const double> a, std::span<const double> b, const Precision& precision,
                                double empty_a = no_depth);
/// Colours alone, three bytes a pixel.
BufferDifference compare_colors(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

}  // namespace zstep::diff
