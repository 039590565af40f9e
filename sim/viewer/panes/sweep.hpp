// The span and the scan line at work: where they begin and end on the raster, which lies between pixels' centres.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "sim/viewer/panes/raster_words.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// A line through the centres of the scan line's pixels from x_L to x_R, and a stroke across the row at each of them.
/// What stands in pixels is not crossed.
struct SpanEnds {
  float left = 0, right = 0, top = 0, end = 0;  ///< on screen: x_L, x_R, and the scan line's borders
  struct Box {
    ImVec2 at, size;
  };
  std::vector<Box> line;
  std::array<Box, 4> strokes{};
  /// For letters that keep clear of it.
  TakenPlaces taken() const;
};
/// How wide what stands in a pixel of the raster is; 0 where nothing does.
using WidthInCell = std::function<float(std::int32_t x, std::int32_t y)>;
/// None where no span is at work, or pixels are too small to tell.
std::optional<SpanEnds> span_ends(const Ui& ui, const RasterMap& map, ImVec2 origin, const WidthInCell& width = {});
void draw_span_ends(const Ui& ui, const SpanEnds& ends);

}  // namespace zstep::viewer
