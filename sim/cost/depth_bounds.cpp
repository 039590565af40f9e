#include "sim/cost/depth_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "algorithms/catalog/catalog.hpp"
#include "traces/error.hpp"

namespace zstep::compare {

namespace {

std::optional<interpolation::Bounds> bounds_in(const Trace& run, NumberFormat format) {
  const Header& header = run.header();
  if (header.algorithm != "z-buffer" || !header.declares(Convention::number_format)) return std::nullopt;
  Conventions conventions = header.conventions;
  conventions.number_format = format;
  try {
    check_run(method("z-buffer"), run.scene(), conventions);
  } catch (const InputError&) {
    return std::nullopt;
  }
  return interpolation::bounds_of(run.scene(), conventions);
}

/// What both together may be apart: each is as near to what is exact as its own bound says.
HeldTo held_to_both(std::initializer_list<std::pair<const Trace*, NumberFormat>> both) {
  HeldTo held;
  auto depths = std::make_shared<DepthBounds>();
  for (const auto& [run, format] : both) {
    // Of float64 a share of each number says more than enough.
    const auto bounds = format != NumberFormat::float64 ? bounds_in(*run, format) : std::nullopt;
    if (!bounds) continue;
    depths->width = run->scene().raster.width;
    depths->of_pixel.resize(std::max(depths->of_pixel.size(), bounds->of_any.size()));
    // Beyond what fixed point can hold there is no bound, and nothing is allowed for that.
    for (std::size_t pixel = 0; pixel < bounds->of_any.size(); ++pixel)
      if (std::isfinite(bounds->of_any[pixel])) depths->of_pixel[pixel] += bounds->of_any[pixel];
  }
  if (!depths->of_pixel.empty()) held.depths = std::move(depths);
  return held;
}

}  // namespace

std::optional<interpolation::Bounds> bounds_in(const Trace& run) {
  return bounds_in(run, run.header().conventions.number_format);
}

HeldTo held_to_bounds(const Trace& a, const Trace& b) {
  return held_to_both({{&a, a.header().conventions.number_format}, {&b, b.header().conventions.number_format}});
}

HeldTo held_to_bounds(const Trace& a, NumberFormat of_b) {
  return held_to_both({{&a, a.header().conventions.number_format}, {&a, of_b}});
}

}  // namespace zstep::compare
