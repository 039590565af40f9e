// Charts as pictures, drawn with the viewer's own letters and lines.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "sim/image/drawing.hpp"

namespace zstep {

/// One number of a chart, and how it reads ("1.3 ms").
struct ChartValue {
  double value = 0;  ///< not a number: there is no mark, the text alone
  std::string text;
  bool warning = false;  ///< marked by a cross in place of a dot
};

/// Rows of dots: a row a method, a column a quantity with an axis of its own. Axes are logarithmic; 0 has a place of
/// its own at their left end.
struct DotChart {
  struct Column {
    std::string title, subtitle;
    std::vector<ChartValue> values;  ///< one a row
  };
  std::string title, subtitle;
  std::vector<std::string> rows;
  std::vector<Column> columns;
};

/// Lines over two logarithmic axes.
struct LineChart {
  struct Line {
    std::string name;
    std::vector<glm::dvec2> points;  ///< both coordinates above 0
    bool dashed = false;
    int look = 0;  ///< colour and mark: lines of the same look belong together
  };
  std::string title, subtitle, x_title, y_title;
  std::vector<double> x_ticks;
  std::vector<Line> lines;
};

/// 1280 pixels wide, as high as its rows need.
Drawing draw_chart(const DotChart& chart);
/// 1280 x 720 pixels.
Drawing draw_chart(const LineChart& chart);

}  // namespace zstep
