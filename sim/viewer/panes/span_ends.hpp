// Where the span at work begins and ends on the raster: x_L and x_R, which lie between pixels' centres.
#pragma once

#include <array>
#include <optional>

#include "sim/viewer/panes/taken_places.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

struct SpanEnds {
  float left = 0, right = 0, top = 0, end = 0;  ///< on screen: x_L, x_R, and the scan line's borders
  float cell = 1;                               ///< of a pixel
  struct Name {
    ImVec2 at, size;
  };
  std::optional<std::array<Name, 2>> names;  ///< of x_L and of x_R, where pixels are large enough for them
  TakenPlaces names_taken() const;
};
/// None where no span is at work, or pixels are too small to tell.
std::optional<SpanEnds> span_ends(const Ui& ui, const RasterMap& map, ImVec2 origin);
void draw_span_ends(const Ui& ui, const SpanEnds& ends);

}  // namespace zstep::viewer
