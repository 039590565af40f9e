// Zoom and pan of the two buffers, linked: where each cell of the raster lies in a pane.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "sim/answers/pixel_counts.hpp"
#include "sim/viewer/model/inquiry.hpp"
#include "sim/viewer/model/session.hpp"
#include "traces/math/whole.hpp"

namespace zstep::viewer {

struct RasterView {
  double zoom = 1;  ///< 1: the whole raster fits the pane
  double center_x = 0,
         center_y = 0;  ///< the raster point in the middle of the pane while zoomed in, in cells from the centre
  bool operator==(const RasterView&) const = default;
};

/// How far one may zoom: in a large raster until four cells fill the pane, so that numbers in projector type have room
/// in them.
inline double most_zoom(const Raster& raster) { return std::max(64.0, std::max(raster.width, raster.height) / 4.0); }

/// The raster laid into a box of pixels. Raster coordinates have pixel centres at integers.
struct RasterMap {
  int width = 1, height = 1;  ///< cells
  bool y_up = false;
  double cell = 1;           ///< pixels a cell
  double left = 0, top = 0;  ///< of the raster's corner inside the box, in pixels
  int box_width = 1, box_height = 1;

  RasterMap(const Raster& raster, const RasterView& view, int box_width_, int box_height_);

  double px(double x) const { return left + (x + 0.5) * cell; }
  double py(double y) const { return top + ((y_up ? height - 1 - y : y) + 0.5) * cell; }
  /// Pixel bounds of column x and of row y; whole pixels, so that neighbours share a border.
  int column_begin(int x) const { return nearest_int(left + x * cell); }
  int row_begin(int y) const { return nearest_int(top + (y_up ? height - 1 - y : y) * cell); }
  int row_end(int y) const { return nearest_int(top + (y_up ? height - y : y + 1) * cell); }
  std::optional<Cell> cell_at(double pixel_x, double pixel_y) const;
};

/// A span in the pane: its ends on the scale on which pixel centres are whole numbers, and its scan line's upper and
/// lower border.
struct SpanOnRaster {
  double left = 0, right = 0, top = 0, end = 0;
};
inline SpanOnRaster span_on_raster(const RasterMap& map, double x_left, double x_right, int y) {
  return {map.px(x_left), map.px(x_right), static_cast<double>(map.row_begin(y)), static_cast<double>(map.row_end(y))};
}

inline RasterMap::RasterMap(const Raster& raster, const RasterView& view, int box_width_, int box_height_)
    : width(std::max(1, raster.width)),
      height(std::max(1, raster.height)),
      y_up(raster.y_up),
      box_width(std::max(1, box_width_)),
      box_height(std::max(1, box_height_)) {
  const double fit = std::min(ratio(box_width, width), ratio(box_height, height));
  cell = fit * view.zoom;
  // Whole pixels make an even grid; where they would waste much room, quarters.
  if (cell > 12) cell = std::floor(cell);
  else if (cell > 2) cell = std::floor(cell * 4) / 4;
  // What fits must not be moved out of the box by rounding.
  left = std::floor((box_width - width * cell) / 2 - view.center_x * cell + 1e-9);
  top = std::floor((box_height - height * cell) / 2 - view.center_y * cell + 1e-9);
}

inline std::optional<Cell> RasterMap::cell_at(double pixel_x, double pixel_y) const {
  const int x = floor_int((pixel_x - left) / cell), row = floor_int((pixel_y - top) / cell);
  if (x < 0 || row < 0 || x >= width || row >= height) return std::nullopt;
  return Cell{x, y_up ? height - 1 - row : row};
}

// What is painted over the frame for each pixel: how often it was written, who wrote it last, … Follows the reader's
// step, and catches up a little each frame.

class PixelOverlay {
 public:
  /// The session must outlive it.
  explicit PixelOverlay(Session& session) : session_(session) {}

  std::optional<answers::Count> shown() const { return shown_; }
  void show(std::optional<answers::Count> count);
  /// The next one of them, with none between the last and the first.
  void turn(int direction);
  /// Is the picture of this step not whole yet?
  bool counts() const { return shown_ && painted_at_ != session_.position(); }
  /// Counts on for some milliseconds. True when there is a picture to take.
  bool look_on();
  /// Into `shown`, whose memory is used again.
  void take_picture(std::optional<HeatMap>& shown);
  /// How far it is behind the reader, for who watches; empty when it is not.
  std::string behind() const;

  /// "overdraw", and what it says in a few words.
  static std::string name(answers::Count count);
  static std::string meaning(answers::Count count);

 private:
  void paint();
  Session& session_;
  std::unique_ptr<answers::PixelCounts> counts_;  // made when first shown
  std::optional<answers::Count> shown_;
  HeatMap picture_;
  std::int64_t painted_at_ = -1;
};

}  // namespace zstep::viewer
