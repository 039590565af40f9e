#include "sim/viewer/draw/raster_canvas.hpp"

#include <algorithm>

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
        out[px] = grid_row || line[static_cast<std::size_t>(px)] ? ink.grid : cell == hatched_cell ? hatch_at(px, py, ink) : cell;
      }
    }
  }
}

/// Cells smaller than a pixel: the mean of those a pixel covers, so that thin things grow faint instead of vanishing.
void paint_small(Canvas& canvas, const RasterMap& map, const std::vector<Pixel32>& cells, const RasterInk& ink) {
  const double step = 1 / map.cell;
  for (int py = 0; py < canvas.height(); ++py) {
    const double first_row = (py - map.top) * step;
    const int row_a = static_cast<int>(std::floor(first_row)), row_b = std::max(row_a + 1, static_cast<int>(std::floor(first_row + step)));
    if (row_b <= 0 || row_a >= map.height) continue;
    Pixel32* out = canvas.row(py);
    for (int px = 0; px < canvas.width(); ++px) {
      const double first = (px - map.left) * step;
      const int a = static_cast<int>(std::floor(first)), b = std::max(a + 1, static_cast<int>(std::floor(first + step)));
      if (b <= 0 || a >= map.width) continue;
      unsigned red = 0, green = 0, blue = 0, count = 0;
      for (int row = std::max(0, row_a); row < std::min(map.height, row_b); ++row) {
        const int y = map.y_up ? map.height - 1 - row : row;
        const Pixel32* source = cells.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
        for (int x = std::max(0, a); x < std::min(map.width, b); ++x) {
          const Pixel32 cell = source[x] == hatched_cell ? ink.hatch : source[x];
          red += cell >> 16 & 255u;
          green += cell >> 8 & 255u;
          blue += cell & 255u;
          ++count;
        }
      }
      if (count) out[px] = 0xff000000u | red / count << 16 | green / count << 8 | blue / count;
    }
  }
}

}  // namespace

void paint_raster(Canvas& canvas, const RasterMap& map, const std::vector<Pixel32>& cells, const RasterInk& ink) {
  canvas.fill(ink.outside);
  if (cells.size() < static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height)) return;
  if (map.cell >= 1) paint_large(canvas, map, cells, ink);
  else paint_small(canvas, map, cells, ink);
}

}  // namespace zstep::viewer
