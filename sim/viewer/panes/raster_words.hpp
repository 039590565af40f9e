// What is written on a raster and beside it: numbers in pixels, letters of polygons, columns and rows along the sides,
// none over another.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/model/raster_view.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

// Which places of a picture words and marks stand on already, so that none is written over another.

class TakenPlaces {
 public:
  void take(ImVec2 at, ImVec2 size) { boxes_.push_back({at.x, at.y, at.x + size.x, at.y + size.y}); }
  bool free(ImVec2 at, ImVec2 size) const {
    return std::none_of(boxes_.begin(), boxes_.end(), [&](const ImVec4& box) {
      return at.x < box.z && box.x < at.x + size.x && at.y < box.w && box.y < at.y + size.y;
    });
  }

 private:
  std::vector<ImVec4> boxes_;  ///< left, top, right, bottom
};

// Paints a raster's cells into a canvas of a pane's size.

/// A cell without a colour of its own: drawn hatched.
inline constexpr Pixel32 hatched_cell = 0;

struct RasterInk {
  Pixel32 outside, grid, hatch, hatch_line;
};

/// `cells` is row-major, row 0 first; cells smaller than a pixel are averaged. Draws a grid when cells are large
/// enough. With `counts`, one for each cell and NaN for none, a pixel shows the colour of the greatest one under it
/// instead: a single marked cell stays in sight, and no colour is shown that is not on the scale.
void paint_raster(Canvas& canvas, const RasterMap& map, const std::vector<Pixel32>& cells, const RasterInk& ink,
                  const std::vector<double>* counts = nullptr);

inline constexpr double grid_from = 5;      ///< pixels a cell needs for a grid
inline constexpr double numbers_from = 16;  ///< … for numbers to be tried

/// Column and row numbers along the raster, as many as have room.
struct Rulers {
  float left = 0, below = 0;
};
Rulers room_for_rulers(const Ui& ui, const Raster& raster);
void draw_rulers(Ui& ui, const RasterMap& map, ImVec2 origin, const Rulers& rulers);

/// How many decimals a cell's numbers are written with, from `most` down to the fewest that say something: two, or all
/// that they have. `widest` tells the width of the widest of them; nullopt when not even the shortest has room.
std::optional<int> decimals_that_fit(int most, double room, const std::function<double(int)>& widest);

/// As many decimals as fit every visible cell; none at all when two do not: a depth without decimals would mislead.
/// True when there are any.
bool draw_numbers(Ui& ui, const RasterMap& map, ImVec2 origin, const Cells& cells,
                  const std::function<std::string(std::size_t, int)>& cell_text);

/// The letter of each polygon, once, with a rim: where pixels are too small for one each. The largest first, and none
/// over another, over what is taken already or over the pixel at work.
void draw_labels(Ui& ui, const RasterMap& map, ImVec2 origin, TakenPlaces taken = {});

}  // namespace zstep::viewer
