// A sheet of paper without a window: text, lines and marks, then the picture, of pixels and as SVG.
#pragma once

#include <imgui.h>
#include <string>
#include <vector>

#include "traces/image/png.hpp"
#include "sim/viewer/charts/chart.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/draw/fonts.hpp"
#include "sim/viewer/draw/renderer.hpp"
#include "sim/viewer/draw/theme.hpp"

namespace zstep::viewer {

// What charts are drawn on: a sheet of its own, or a pane of the window.

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

/// Of charts, in pixels.
inline constexpr int chart_wide = 1280;
inline constexpr float chart_text = 19, chart_margin = 28;

class Sheet : public Paper {
 public:
  Sheet(int width, int height, float text_pixels);
  ~Sheet() override;
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  const Theme& theme() const override { return light_theme(); }
  float width() const { return to_float(renderer_.width()); }
  float height() const { return to_float(renderer_.height()); }
  float text_height() const override { return fonts_.text->FontSize; }
  float text_width(const std::string& text, bool bold = false) const override;
  void text(float x, float y, const std::string& text, ImU32 color, Side side = Side::left, bool bold = false) override;
  void line(ImVec2 from, ImVec2 to, ImU32 color, float thickness) override;
  void rectangle(ImVec2 from, ImVec2 to, ImU32 color) override;
  /// A picture with its upper left corner there.
  void image(int x, int y, const Image& image);
  void mark(ImVec2 at, float radius, int shape, ImU32 color, bool filled = true) override;
  void cross(ImVec2 at, float radius, ImU32 color);

  /// The finished sheet.
  Image picture();
  /// The same as SVG 1.1, but for pictures of pixels, which it leaves out.
  std::string svg() const;

 private:
  ImGuiContext* before_;
  ImGuiContext* context_;
  Renderer renderer_;
  Canvas canvas_;  ///< all but the text, which lies on it
  Fonts fonts_;
  std::string svg_;  ///< what is on it, an element a line
};

/// A logarithmic axis from a to b pixels, over whole decades.
class LogAxis {
 public:
  /// `least` and `most` > 0.
  LogAxis(double least, double most, float from, float to);
  float at(double value) const;
  int first_decade() const { return first_; }
  int last_decade() const { return last_; }

 private:
  int first_, last_;
  float from_, to_;
};

/// 10^n as it is written on an axis: "0.01", "1", "1 000", "10⁶".
std::string decade_text(int n);

}  // namespace zstep::viewer
