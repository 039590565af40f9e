#include "traces/scene.hpp"

#include <algorithm>
#include <cmath>

namespace zstep {

double view_depth(const Camera& camera, const Conventions& conventions, double buffer_depth) {
  const bool holds_z_v = camera.kind == Camera::Kind::screen || conventions.depth == Conventions::Depth::view;
  if (holds_z_v || std::isinf(buffer_depth)) return buffer_depth;
  const double f = camera.near, F = camera.far;
  if (camera.kind == Camera::Kind::orthographic) return f + (buffer_depth + 1) * (F - f) / 2;
  // z* = f (a z + b) / z with a = -(f + F) / (f (f - F)) and b = 2 F / (f - F) (003), solved for z
  return 2 * f * F / (F + f - buffer_depth * (F - f));
}

double buffer_depth(const Camera& camera, const Conventions& conventions, double view_depth) {
  const bool holds_z_v = camera.kind == Camera::Kind::screen || conventions.depth == Conventions::Depth::view;
  if (holds_z_v || std::isinf(view_depth)) return view_depth;
  const double f = camera.near, F = camera.far;
  if (camera.kind == Camera::Kind::orthographic) return 2 * (view_depth - f) / (F - f) - 1;
  return ((f + F) * view_depth - 2 * f * F) / ((F - f) * view_depth);
}

const Placement* placement_of(const Scene& scene, std::int32_t point) {
  const auto& placements = scene.placements;
  const auto after =
      std::upper_bound(placements.begin(), placements.end(), point,
                       [](std::int32_t p, const Placement& placement) { return p < placement.first_point; });
  if (after == placements.begin()) return nullptr;
  const Placement& last = *std::prev(after);
  return point - last.first_point < last.point_count ? &last : nullptr;
}

Color color_at(const Picture& picture, const Scene& scene, std::size_t pixel) {
  if (!picture.ink.empty() && picture.ink[pixel] != no_ink) return color_of(picture.ink[pixel]);
  const std::int32_t polygon = picture.polygon[pixel];
  return polygon == no_polygon ? scene.background : scene.polygons.at(static_cast<std::size_t>(polygon)).color;
}

}  // namespace zstep
