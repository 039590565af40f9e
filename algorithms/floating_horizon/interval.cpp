#include "algorithms/floating_horizon/interval.hpp"

#include "traces/formulas/lines.hpp"
#include "traces/formulas/outlines.hpp"

namespace zstep::floating_horizon {

namespace {

/// Coordinates beyond this lose whole pixels in differences (docs/architecture.md, "Degenerate input").
constexpr double farthest_pixel = 1e9;

}  // namespace

std::optional<Interval> interval_on_raster(const viewing::Lens& lens, const viewing::Vertex& a,
                                           const viewing::Vertex& b) {
  double t_0 = 0, t_1 = 1;
  for (const ClipPlane plane : {ClipPlane::near, ClipPlane::far}) {
    const double d_0 = distance_inside(lens, a.view, plane), d_1 = distance_inside(lens, b.view, plane);
    if (!(d_0 >= 0) && !(d_1 >= 0)) return std::nullopt;
    if (!(d_0 >= 0)) t_0 = std::max(t_0, formulas::where_zero(d_0, d_1));
    if (!(d_1 >= 0)) t_1 = std::min(t_1, formulas::where_zero(d_0, d_1));
  }
  if (!(t_0 <= t_1)) return std::nullopt;
  const auto at = [&](double t) {
    const glm::dvec3 plane = lens.project(formulas::part_of_way(a.view, b.view, t));
    return lens.to_viewport(plane.x, plane.y);
  };
  const Interval interval{t_0 > 0 ? at(t_0) : glm::dvec2(a.raster), t_1 < 1 ? at(t_1) : glm::dvec2(b.raster), t_0 == 0};
  for (const glm::dvec2 end : {interval.from, interval.to})
    if (!(std::abs(end.x) <= farthest_pixel && std::abs(end.y) <= farthest_pixel)) return std::nullopt;
  return interval;
}

}  // namespace zstep::floating_horizon
