#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/charts/chart.hpp"
#include "traces/formulas/resolution.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep {

std::vector<double> decades_between(double from, double to) {
  std::vector<double> all;
  for (double decade = portable::pow(10, std::ceil(portable::log10(from) - 1e-9)); decade <= to * 1.0001; decade *= 10)
    all.push_back(decade);
  return all;
}

LineChart unit_chart(const Scene& scene, const std::vector<std::pair<std::string, Conventions>>& modes) {
  const double near = scene.camera.near, far = scene.camera.far;
  LineChart chart;
  chart.title = fmt::format("{}: which depths a buffer can tell apart, near = {:g}, far = {:g}", scene.name, near, far);
  chart.subtitle = "By formula: the distance in z_v to the next depth that the mode's buffer can hold.";
  chart.x_title = "z_v";
  chart.y_title = "a unit of the depth buffer, in z_v";
  chart.x_ticks = decades_between(near, far);
  constexpr int points = 17;
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    LineChart::Line line{modes[mode].first, {}, false, static_cast<int>(mode)};
    for (int k = 0; k < points; ++k) {
      const double z =
          near * portable::pow(far / near, (k + 0.5) / points);  // not at the planes: about 0 floats are endless
      if (const double unit = formulas::resolution(scene, modes[mode].second, z); unit > 0)
        line.points.emplace_back(z, unit);
    }
    if (!line.points.empty()) chart.lines.push_back(std::move(line));
  }
  return chart;
}

}  // namespace zstep
