#include "sim/viewer/panes/raster_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zstep::viewer {
namespace {

Pixel32 hatch_at(int x, int y, const RasterInk& ink) { return (x + y) % 6 == 0 ? ink.hatch_line : ink.hatch; }

/// Cells at least a pixel wide: every canvas pixel shows the cell it lies in.
void paint_large(Canvas& canvas, const RasterMap& map, const std::vector<Pixel32>& cells, const RasterInk& ink) {
  const int left = std::max(0, map.column_begin(0)), right = std::min(canvas.width(), map.column_begin(map.width));
  const int top = std::max(0, static_cast<int>(std::lround(map.top)));
  const int bottom = std::min(canvas.height(), static_cast<int>(std::lround(map.top + map.height * map.cell)));
  if (left >= right) return;
  std::vector<int> column(static_cast<std::size_t>(right));
  std::vector<bool> line(static_cast<std::size_t>(right));
  const bool grid = map.cell >= grid_from;
  for (int x = 0; x < map.width; ++x)
    for (int px = std::max(left, map.column_begin(x)); px < std::min(right, map.column_begin(x + 1)); ++px) {
      column[static_cast<std::size_t>(px)] = x;
      line[static_cast<std::size_t>(px)] = grid && px + 1 == map.column_begin(x + 1);
    }
  for (int y = 0; y < map.height; ++y) {
    const Pixel32* source = cells.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
    for (int py = std::max(top, map.row_begin(y)); py < std::min(bottom, map.row_end(y)); ++py) {
      Pixel32* out = canvas.row(py);
      const bool grid_row = grid && py + 1 == map.row_end(y);
      for (int px = left; px < right; ++px) {
        const Pixel32 cell = source[column[static_cast<std::size_t>(px)]];
        out[px] = grid_row || line[static_cast<std::size_t>(px)] ? ink.grid
                  : cell == hatched_cell                         ? hatch_at(px, py, ink)
                                                                 : cell;
      }
    }
  }
}

/// Rows and columns under a pixel, the last ones exclusive.
struct Under {
  int left = 0, right = 0, top = 0, bottom = 0;
};

/// The mean of the cells that a pixel covers, so that thin things grow faint instead of vanishing.
struct Mean {
  const RasterMap& map;
  const std::vector<Pixel32>& cells;
  const RasterInk& ink;

  Pixel32 operator()(const Under& under) const {
    unsigned red = 0, green = 0, blue = 0, count = 0;
    for (int row = under.top; row < under.bottom; ++row) {
      const int y = map.y_up ? map.height - 1 - row : row;
      const Pixel32* source = cells.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
      for (int x = under.left; x < under.right; ++x) {
        const Pixel32 cell = source[x] == hatched_cell ? ink.hatch : source[x];
        red += cell >> 16 & 255u;
        green += cell >> 8 & 255u;
        blue += cell & 255u;
        ++count;
      }
    }
    return 0xff000000u | red / count << 16 | green / count << 8 | blue / count;
  }
};

/// The cell with the greatest count of those that a pixel covers.
struct Greatest {
  const RasterMap& map;
  const std::vector<Pixel32>& cells;
  const RasterInk& ink;
  const std::vector<double>& counts;

  Pixel32 operator()(const Under& under) const {
    Pixel32 found = hatched_cell;
    double most = -std::numeric_limits<double>::infinity();
    for (int row = under.top; row < under.bottom; ++row) {
      const int y = map.y_up ? map.height - 1 - row : row;
      const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
      for (int x = under.left; x < under.right; ++x)
        if (const std::size_t at = first + static_cast<std::size_t>(x); counts[at] >= most)
          most = counts[at], found = cells[at];
    }
    return found == hatched_cell ? ink.hatch : found;
  }
};

/// Cells smaller than a pixel: each pixel has the colour that `color` makes of those under it.
template <class ColorOf>
void paint_small(Canvas& canvas, const RasterMap& map, const ColorOf& color) {
  const double step = 1 / map.cell;
  // Each pixel begins where the one before it ends, so no cell is left out, and rounding does not lose the last one.
  const auto cell_at = [step](int pixel, double begin) {
    return static_cast<int>(std::floor((pixel - begin) * step + 1e-9));
  };
  for (int py = 0; py < canvas.height(); ++py) {
    Under under;
    under.top = std::max(0, cell_at(py, map.top)), under.bottom = std::min(map.height, cell_at(py + 1, map.top));
    if (under.top >= under.bottom) continue;
    Pixel32* out = canvas.row(py);
    for (int px = 0; px < canvas.width(); ++px) {
      under.left = std::max(0, cell_at(px, map.left)), under.right = std::min(map.width, cell_at(px + 1, map.left));
      if (under.left < under.right) out[px] = color(under);
    }
  }
}

}  // namespace

void paint_raster(Canvas& canvas, const RasterMap& map, const std::vector<Pixel32>& cells, const RasterInk& ink,
                  const std::vector<double>* counts) {
  canvas.fill(ink.outside);
  if (cells.size() < static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height)) return;
  if (map.cell >= 1) paint_large(canvas, map, cells, ink);
  else if (counts && counts->size() == cells.size()) paint_small(canvas, map, Greatest{map, cells, ink, *counts});
  else paint_small(canvas, map, Mean{map, cells, ink});
}

}  // namespace zstep::viewer
