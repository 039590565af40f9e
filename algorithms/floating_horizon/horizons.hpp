// The two horizons, and a curve against them.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "traces/events/vocabulary.hpp"

namespace zstep::floating_horizon {

/// One entry a column of the raster: the row, not rounded, above which (below which) nothing was drawn so far. Rows
/// grow downwards, so the upper horizon is the smaller number. Infinite while nothing was drawn in the column.
struct Horizons {
  explicit Horizons(std::int32_t width)
      : upper(static_cast<std::size_t>(width), std::numeric_limits<double>::infinity()),
        lower(static_cast<std::size_t>(width), -std::numeric_limits<double>::infinity()) {}
  struct Entry {
    double &upper, &lower;
  };
  Entry at(std::int32_t x) { return {upper[static_cast<std::size_t>(x)], lower[static_cast<std::size_t>(x)]}; }

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

}  // namespace zstep::floating_horizon
