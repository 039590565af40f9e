// The straight interval of a curve between two samples, its columns and its pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>

#include "algorithms/viewing/vertices.hpp"

namespace zstep::floating_horizon {

struct Interval {
  glm::dvec2 from, to;  ///< (x_s, y_s)
  bool whole;           ///< its first end is the sample itself, not a cut
};

/// Cut at the near and the far plane; nothing if nothing is left, or if it ends farther than 10⁹ pixels away.
std::optional<Interval> interval_on_raster(const viewing::Lens& lens, const viewing::Vertex& a,
                                           const viewing::Vertex& b);

/// Calls visit(x, y) for every column of the raster between the ends, from the first to the second, with the interval's
/// row there. The column of the first end itself belongs to the interval before, so it is visited only `with_first`.
template <class Visit>
void for_each_column(const Interval& interval, std::int32_t width, bool with_first, Visit&& visit) {
  const auto [from, to, whole] = interval;
  const double step = to.x >= from.x ? 1 : -1;
  double begin = step > 0 ? std::ceil(from.x) : std::floor(from.x);
  if (begin == from.x && !with_first) begin += step;
  begin = std::clamp(begin, -1.0, static_cast<double>(width));
  if (begin < 0 && step > 0) begin = 0;
  if (begin == width && step < 0) begin = width - 1;
  for (double x = begin; x >= 0 && x < width && (to.x - x) * step >= 0; x += step) {
    const double y = to.x == from.x ? from.y : from.y + (to.y - from.y) * (x - from.x) / (to.x - from.x);
    visit(static_cast<std::int32_t>(x), y);
  }
}

/// Calls visit(x, y) for the ends of an interval that meets no column, on the nearest one.
template <class Visit>
void for_nearest_column(const Interval& interval, std::int32_t width, bool with_first, Visit&& visit) {
  const double x = std::floor(interval.from.x + 0.5);
  if (!(x >= 0 && x < width)) return;
  if (with_first) visit(static_cast<std::int32_t>(x), interval.from.y);
  visit(static_cast<std::int32_t>(x), interval.to.y);
}

/// Calls visit(x, y) for the pixels of a straight line, a pixel a column or a row, whichever are more; only those on
/// the raster.
template <class Visit>
void for_each_pixel(glm::dvec2 from, glm::dvec2 to, std::int32_t width, std::int32_t height, Visit&& visit) {
  const glm::dvec2 along = to - from;
  double t_0 = 0, t_1 = 1;  // of the part on the raster's rows, a hair inside: a line may be as long as you please
  if (along.y != 0) {
    const double t_top = (-0.49 - from.y) / along.y, t_bottom = (height - 0.51 - from.y) / along.y;
    t_0 = std::max(t_0, std::min(t_top, t_bottom));
    t_1 = std::min(t_1, std::max(t_top, t_bottom));
  }
  if (!(t_0 <= t_1)) return;
  const double steps = std::ceil(std::max(std::abs(along.x), std::abs(along.y)) * (t_1 - t_0));
  for (double i = 0; i <= steps; ++i) {
    const glm::dvec2 place = from + along * (steps == 0 ? t_0 : t_0 + (t_1 - t_0) * i / steps);
    const double x = std::floor(place.x + 0.5), y = std::floor(place.y + 0.5);
    if (x < 0 || x >= width || y < 0 || y >= height) continue;
    visit(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
  }
}

}  // namespace zstep::floating_horizon
