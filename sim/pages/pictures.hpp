// What is in a run's buffers, as images. The top row comes first, whichever way the raster counts.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "traces/image/png.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// The picture in its polygons' colours; each pixel becomes enlarge x enlarge pixels.
Image image_of(const Picture& picture, const Scene& scene, int enlarge);

/// Where two pictures differ (diff::BufferDifference::apart): white where they do not, the darker the more.
Image map_of(const std::vector<float>& apart, std::int32_t width, std::int32_t height, bool y_up);

/// The depths of several pictures, which are drawn in the same greys.
struct DepthRange {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void include(const Picture& picture);
};
/// The depth buffer in greys, the smaller the darker; what was not drawn is white with a stroke through it.
Image depths_of(const Picture& picture, bool y_up, const DepthRange& range);

/// What one sees on it, in words: "8 × 6 pixels: A on 10, B on 4, 34 of the background".
std::string picture_in_words(const Picture& picture, const Scene& scene);
/// "8 × 6 pixels: 14 with depths from 0.25 to 0.75, 34 empty".
std::string depths_in_words(const Picture& picture);

}  // namespace zstep
