// Names of polygons inside their outlines, and their extents along the raster.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "sim/viewer/panes/raster_words.hpp"

namespace zstep::viewer {

struct NamedOutline {
  std::vector<glm::dvec2> outline;  ///< in a picture's pixels; an empty one is left out
  std::string name;                 ///< none: it only keeps others away
};

/// Each name inside its own outline, on no line, and within as few others as can be; none where there are too many.
void name_outlines(const Ui& ui, WordPlaces& words, ImVec2 origin, const std::vector<NamedOutline>& all);

/// Vertices, lines and polygons that the lesson's stop names, on the raster.
void draw_stop_labels(const Ui& ui, WordPlaces& words, const Stop& stop, ImVec2 origin, const RasterMap& map);

struct ExtentBar {
  std::string name;
  double low, high;  ///< of the raster's x or y
  ImU32 color;
};
/// Along the raster's lower border for x, along its left one for y, an interval each with the numbers of its ends, and
/// from these thin lines across the raster.
void draw_extents(const Ui& ui, WordPlaces& words, const RasterMap& map, ImVec2 origin, bool of_y,
                  const std::vector<ExtentBar>& bars);

}  // namespace zstep::viewer
