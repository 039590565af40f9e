// The two horizons, and a curve against them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "algorithms/viewing/vertices.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/scene.hpp"

namespace zstep::floating_horizon {

// The straight interval of a curve between two samples, its columns and its pixels.

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

/// One entry a column of the raster: the row, not rounded, above which (below which) nothing was drawn so far. Rows
/// grow downwards, so the upper horizon is the smaller number. Infinite while nothing was drawn in the column.
struct Horizons {
  explicit Horizons(std::int32_t width)
      : upper(static_cast<std::size_t>(width), std::numeric_limits<double>::infinity()),
        lower(static_cast<std::size_t>(width), -std::numeric_limits<double>::infinity()) {}
  struct Entry {
    double &upper, &lower;
  };
  Entry at(std::int32_t x) { return {upper[x], lower[x]}; }

  std::vector<double> upper, lower;
};

/// A curve where it passes a column, and the horizons there as the curves before it left them.
struct Passage {
  std::int32_t x = 0;
  double y = 0, upper = 0, lower = 0;
  Horizon where = Horizon::hidden;
};

/// 004: visible if it is larger (smaller, for rows) than any y before at that x, or smaller than all of them. On the
/// horizon it is visible. With one horizon, only what is above is.
inline Horizon held_against(double y, double upper, double lower, bool two) {
  if (y <= upper) return Horizon::above;
  if (two && y >= lower) return Horizon::below;
  return Horizon::hidden;
}

/// Where the curve crosses a horizon between two columns, both taken as straight there: with the distances
/// d = y − horizon at both columns, at the part d_0/(d_0 − d_1) of the way. Nothing where the horizon is not known at
/// both columns, or where the two do not cross.
inline std::optional<glm::dvec2> crossing(const Passage& from, const Passage& to, Horizon horizon) {
  const bool upper = horizon == Horizon::above;
  const double d_0 = from.y - (upper ? from.upper : from.lower), d_1 = to.y - (upper ? to.upper : to.lower);
  if (!std::isfinite(d_0) || !std::isfinite(d_1)) return std::nullopt;
  const double t = d_0 / (d_0 - d_1);
  if (!(t >= 0 && t <= 1)) return std::nullopt;
  return glm::dvec2(from.x + t * (to.x - from.x), from.y + t * (to.y - from.y));
}

// From front to back.

/// Rows (or columns) of the surface's grid, nearest first. One list; two in perspective where the eye stands between
/// rows: those before it and those behind it cannot hide each other, as its own plane z = constant lies between them,
/// so each list starts with empty horizons.
using Order = std::vector<std::vector<std::int32_t>>;

/// The scene must have a surface.
Order rows_front_to_back(const Scene& scene);
Order columns_front_to_back(const Scene& scene);

}  // namespace zstep::floating_horizon
