// Antialiasing by area coverage: a pixel's colour is the mixture of what is seen on its area, not at its centre.
//
// E. Catmull, "A Hidden-Surface Algorithm with Anti-Aliasing", SIGGRAPH 1978, whose areas are exact. Here the method is
// run on four more scan lines a row, at y - 3/8, - 1/8, + 1/8 and + 3/8, along which it finds what is seen from where
// to where: a polygon's share of a pixel is the mean of the lengths it has there. Exact where edges are upright, within
// 1/8 where they lie; implied edges are smoothed as well. Shares mix the colours' numbers from 0 to 255 as they are.
#pragma once

#include "algorithms/scan_line/front.hpp"
#include "traces/formulas/samples.hpp"
#include "traces/scene.hpp"

namespace zstep::scan_line {

inline constexpr std::int32_t lines_in_a_row = 4;

class Coverage {
 public:
  /// `polygons`: the polygon table, which must outlive this.
  Coverage(const pieces::Pieces& polygons, const Raster& raster);

  /// The rows that any polygon touches, with an area however small: first_row <= y < end_row.
  std::int32_t first_row() const { return tables_.edges.first_row / lines_in_a_row; }
  std::int32_t end_row() const { return (tables_.edges.end_row + lines_in_a_row - 1) / lines_in_a_row; }

  /// Mixes the colours of row y, once its pixels are drawn. Rows must be asked for one by one, from first_row() on.
  /// Pixels of one colour are left as they are.
  template <Recorder R>
  void mix_row(const Scene& scene, std::int32_t y, Picture& picture, R& record);

 private:
  void add(std::int32_t polygon, double x_left, double x_right);

  Tables tables_;  // with edges on lines four times as dense
  scan_conversion::ActiveEdges active_;
  std::int32_t width_;
  std::vector<std::vector<formulas::PixelShare>> shares_;  // by column
};

}  // namespace zstep::scan_line
