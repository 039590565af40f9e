#include <algorithm>

#include "algorithms/floating_horizon/order.hpp"

namespace zstep::floating_horizon {

namespace {

/// Front to back along one axis of the world: from the eye outwards, and one list each way from it. A parallel
/// projection has its eye at infinity on one side, so there is one list.
Order outwards(const std::vector<double>& places, const Camera& camera, double eye) {
  std::vector<std::int32_t> ahead, behind;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(places.size()); ++i) {
    const double place = places[static_cast<std::size_t>(i)];
    const bool is_ahead = camera.kind == Camera::Kind::perspective ? place >= eye : eye <= 0;
    (is_ahead ? ahead : behind).push_back(i);
  }
  const auto at = [&](std::int32_t i) { return places[static_cast<std::size_t>(i)]; };
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
    places.push_back(scene.points[static_cast<std::size_t>(row) * static_cast<std::size_t>(surface.columns)].y);
  return outwards(places, scene.camera, scene.camera.eye.y);
}

Order columns_front_to_back(const Scene& scene) {
  const Surface& surface = scene.surface.value();
  std::vector<double> places;
  for (std::int32_t column = 0; column < surface.columns; ++column)
    places.push_back(scene.points[static_cast<std::size_t>(column)].x);
  return outwards(places, scene.camera, scene.camera.eye.x);
}

}  // namespace zstep::floating_horizon
