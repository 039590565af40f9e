// What charts are drawn on: a sheet of its own, or a pane of the window.
#pragma once

#include <string>
#include <vector>

#include <imgui.h>

#include "sim/viewer/charts/chart.hpp"
#include "sim/viewer/draw/theme.hpp"

namespace zstep::viewer {

class Paper {
 public:
  enum class Side : unsigned char { left, middle, right };  ///< of the text lies at x

  virtual ~Paper() = default;
  virtual const Theme& theme() const = 0;
  virtual float text_height() const = 0;
  virtual float text_width(const std::string& text, bool bold = false) const = 0;
  virtual void text(float x, float y, const std::string& text, ImU32 color, Side side = Side::left,
                    bool bold = false) = 0;
  virtual void line(ImVec2 from, ImVec2 to, ImU32 color, float thickness) = 0;
  virtual void rectangle(ImVec2 from, ImVec2 to, ImU32 color) = 0;
  /// A mark of one of four shapes: disc, square, triangle, diamond; hollow unless filled.
  virtual void mark(ImVec2 at, float radius, int shape, ImU32 color, bool filled = true) = 0;

  void dashed_line(ImVec2 from, ImVec2 to, ImU32 color, float thickness);
  /// A line one pixel wide, along the raster.
  void rule(ImVec2 from, ImVec2 to, ImU32 color);
};

/// Where lines are drawn with their axes: all that stands beside and below them lies within, too.
struct PlotArea {
  float left = 0, top = 0, right = 0, bottom = 0;
  float labels = 0;  ///< room left of the axis; 0: as much as its numbers need
  float scale = 1;   ///< of marks and lines
};

/// The lines and axes of a chart, without its title. Nothing where there is nothing to draw.
void draw_lines(Paper& paper, const LineChart& chart, const PlotArea& area);

/// A round step of an axis of which at most so many parts are wanted: 1, 2 or 5 times a power of ten.
double nice_step(double range, int most);

}  // namespace zstep::viewer
