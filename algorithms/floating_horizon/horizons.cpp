#include "algorithms/floating_horizon/horizons.hpp"

#include <algorithm>

#include "traces/formulas/outlines.hpp"
#include "traces/scene.hpp"

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

namespace {

/// Front to back along one axis of the world: from the eye outwards, and one list each way from it. A parallel
/// projection has its eye at infinity on one side, so there is one list.
Order outwards(const std::vector<double>& places, const Camera& camera, double eye) {
  std::vector<std::int32_t> ahead, behind;
  for (std::int32_t i = 0; i < size32(places); ++i) {
    const double place = places[i];
    const bool is_ahead = camera.kind == Camera::Kind::perspective ? place >= eye : eye <= 0;
    (is_ahead ? ahead : behind).push_back(i);
  }
  const auto at = [&](std::int32_t i) { return places[i]; };
  std::stable_sort(ahead.begin(), ahead.end(), [&](std::int32_t a, std::int32_t b) { return at(a) < at(b); });
  std::stable_sort(behind.begin(), behind.end(), [&](std::int32_t a, std::int32_t b) { return at(a) > at(b); });
  Order order;
  for (std::vector<std::int32_t>* list : {&ahead, &behind})
    if (!list->empty()) order.push_back(std::move(*list));
  return order;
}

}  // namespace

Order rows_front_to_back(const Scene& scene) {
  const Surface& surface = scene.surface.value();
  std::vector<double> places;
  for (std::int32_t row = 0; row < surface.rows; ++row)
    places.push_back(scene.points[static_cast<std::size_t>(row) * surface.columns].y);
  return outwards(places, scene.camera, scene.camera.eye.y);
}

Order columns_front_to_back(const Scene& scene) {
  const Surface& surface = scene.surface.value();
  std::vector<double> places;
  for (std::int32_t column = 0; column < surface.columns; ++column) places.push_back(scene.points[column].x);
  return outwards(places, scene.camera, scene.camera.eye.x);
}

}  // namespace zstep::floating_horizon
