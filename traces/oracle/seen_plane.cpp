#include "traces/oracle/seen_plane.hpp"

#include <algorithm>

#include "traces/formulas/viewing.hpp"
#include "traces/oracle/exact_rays.hpp"

namespace zstep::oracle {

namespace {

/// A point of the scene on the raster, with its depth; nothing where it lies in the plane of the eye.
std::optional<Point> on_raster(const Scene& scene, Conventions::Depth depth, const glm::dvec3& at) {
  const Camera& camera = scene.camera;
  const Point p = exactly(at);
  if (camera.kind == Camera::Kind::screen) return p;
  const auto row = [&](int i) {
    const auto t = [&](int k) { return exactly(camera.view[k][i]); };
    return formulas::matrix_row(t(0), t(1), t(2), t(3), p.x, p.y, p.z);
  };
  Rational x = row(0), y = row(1);
  const Rational z_v = row(2), w_y = exactly(camera.window), width = scene.raster.width, height = scene.raster.height;
  if (camera.kind == Camera::Kind::perspective) {
    if (z_v == 0) return std::nullopt;
    x = formulas::projected(exactly(camera.d), x, z_v), y = formulas::projected(exactly(camera.d), y, z_v);
  }
  return Point{formulas::screen_x(x, formulas::window_width(w_y, width, height), width),
               formulas::screen_y(y, w_y, height), depth_of_view(camera, depth, z_v)};
}

}  // namespace

std::optional<SeenPlane> seen_plane(const Scene& scene, Conventions::Depth depth, std::int32_t facet) {
  const bool bent = depth == Conventions::Depth::corrected || depth == Conventions::Depth::view;
  if (bent && scene.camera.kind == Camera::Kind::perspective) return std::nullopt;
  ExactRays rays(scene, depth);
  const auto t = rays.meet(facet, 0, 0), t_x = rays.meet(facet, 1, 0), t_y = rays.meet(facet, 0, 1);
  if (!t || !t_x || !t_y) return std::nullopt;
  if (scene.camera.kind == Camera::Kind::perspective && (*t == 0 || *t_x == 0 || *t_y == 0)) return std::nullopt;
  const Rational z = rays.depth(*t), dz_dx = rays.depth(*t_x) - z, dz_dy = rays.depth(*t_y) - z;
  SeenPlane plane{rounded(dz_dx), rounded(dz_dy), 0};
  const Facet& shape = scene.facets[static_cast<std::size_t>(facet)];
  for (std::int32_t i = 0; i < shape.corner_count; ++i) {
    const std::int32_t corner = scene.corners[static_cast<std::size_t>(shape.first_corner + i)];
    const auto at = on_raster(scene, depth, scene.points[static_cast<std::size_t>(corner)]);
    if (!at) return std::nullopt;
    plane.bend = std::max(plane.bend, std::abs(rounded(at->z - (z + dz_dx * at->x + dz_dy * at->y))));
  }
  return plane;
}

}  // namespace zstep::oracle
