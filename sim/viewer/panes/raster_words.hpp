// What is written on a raster and beside it: numbers in pixels, letters of polygons, columns and rows along the sides,
// none over another.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
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

/// Writes on a part of the window, each word where nothing stands yet.
/// Of the line from + t way between two t, the part within a box; none where it passes the box by.
std::optional<std::pair<double, double>> part_within(glm::dvec2 low, glm::dvec2 high, glm::dvec2 from, glm::dvec2 way,
                                                     double least, double most);

class WordPlaces {
 public:
  WordPlaces(const Ui& ui, ImVec2 low, ImVec2 high, TakenPlaces taken_ = {})
      : taken(std::move(taken_)), ui_(ui), low_(low), high_(high) {}

  /// In the first of these places, given by their middles, that is free; false where none is.
  bool put(const std::string& text, ImU32 color, const ImFont* font, const std::vector<ImVec2>& middles);
  /// Beside the middle of a line or nearer to one of its ends; on the side of `out`, or else on the other.
  bool beside(const std::string& text, ImU32 color, const ImFont* font, ImVec2 from, ImVec2 to, glm::dvec2 out);
  /// Around a dot, towards `out` or else elsewhere.
  bool around(const std::string& text, ImU32 color, const ImFont* font, ImVec2 dot, glm::dvec2 out);
  void keep_line_free(ImVec2 from, ImVec2 to);

  TakenPlaces taken;
  bool on_paper = true;                                  ///< with the pane's colour behind each word
  std::function<bool(ImVec2 low, ImVec2 high)> allowed;  ///< of a place that is free; anywhere where there is none

 private:
  const Ui& ui_;
  ImVec2 low_, high_;
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
