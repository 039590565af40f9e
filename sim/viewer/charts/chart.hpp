// Charts as pictures, drawn with the viewer's own letters and lines.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "traces/image/png.hpp"
#include "traces/scene.hpp"

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

/// Lines over two axes.
struct LineChart {
  struct Line {
    std::string name;
    std::vector<glm::dvec2> points;  ///< on logarithmic axes both coordinates are above 0
    bool dashed = false;
    int look = 0;       ///< colour and mark: lines of the same look belong together
    bool bare = false;  ///< no mark at its points
  };
  /// A place that is marked as now at work, and what stands beside it.
  struct Now {
    glm::dvec2 at{0, 0};
    std::string text;
  };
  enum class Scale : unsigned char { logarithmic, linear };

  std::string title, subtitle, x_title, y_title;
  Scale scale = Scale::logarithmic;
  std::vector<double> x_ticks;  ///< of logarithmic axes; linear ones have round numbers
  std::vector<Line> lines;
  /// The axes of a linear chart reach at least so far, from the least to the greatest.
  glm::dvec2 x_reach{0, 0}, y_reach{0, 0};
  /// In place of upright lines of a grid: points that lines lead to both axes. So are the places that are marked.
  std::vector<glm::dvec2> led;
  std::vector<Now> now;

  /// Looks for a pane: there the accent colours mean something else.
  static constexpr int plain_look = 4, muted_look = 5;
};

/// 1280 pixels wide, as high as its rows need.
Drawing draw_chart(const DotChart& chart);
/// 1280 x 720 pixels.
Drawing draw_chart(const LineChart& chart);

/// The powers of ten from one number to another.
std::vector<double> decades_between(double from, double to);

/// How far apart the depths are that depth buffers can hold, from the near plane to the far one: a line for each of
/// some conventions, by formula. At most four, for a scene with such planes.
LineChart unit_chart(const Scene& scene, const std::vector<std::pair<std::string, Conventions>>& modes);

}  // namespace zstep
