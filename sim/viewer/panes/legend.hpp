// What colours and numbers mean, below a buffer.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// From the least to the most in the colours of depths, and what hatched cells mean, in a line that ends at `bottom`.
void draw_scale(Ui& ui, float bottom, const std::string& before, const std::string& after, const std::string& hatched);
/// Of what is painted over the frame.
void draw_heat_legend(Ui& ui, float bottom);
/// Of the depth buffer, in `range`.
void draw_depth_legend(Ui& ui, float bottom, const DepthRange& range);

/// How many pixels have which depth, above the legend and on its scale.
void draw_histogram(Ui& ui, float bottom, const DepthRange& range, const Picture& picture);
float legend_height(const Ui& ui);
float histogram_height(const Ui& ui);

/// How the values of a picture are spread over a range: pixels in each of so many equal parts, and beside it.
struct Histogram {
  std::vector<std::int32_t> bins;
  std::int32_t nearer = 0, farther = 0;  ///< than the range
  std::int32_t most = 0;                 ///< in one part
};
Histogram histogram_of(const Picture& picture, const DepthRange& range, std::size_t bins);

/// The range of the depths that a picture of such a trace holds.
DepthRange fitted_range(const Picture& picture, const Header& header);

}  // namespace zstep::viewer
