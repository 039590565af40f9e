#include "traces/oracle/exact_rays.hpp"

#include <cmath>
#include <vector>

#include "traces/formulas/eye_rays.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::oracle {

namespace {

Point scaled(const Point& p, const Rational& by) { return {p.x * by, p.y * by, p.z * by}; }

}  // namespace

Rational depth_of_view(const Camera& camera, Conventions::Depth depth, const Rational& z_v) {
  if (camera.kind == Camera::Kind::screen) return z_v;
  const Rational near = exactly(camera.near), far = exactly(camera.far);
  const bool parallel = camera.kind == Camera::Kind::orthographic;
  if (depth != Conventions::Depth::pseudodepth) return formulas::other_depth(depth, parallel, near, far, z_v);
  return parallel
             ? formulas::parallel_pseudodepth(near, far, z_v)
             : formulas::pseudodepth(near, formulas::pseudodepth_a(near, far), formulas::pseudodepth_b(near, far), z_v);
}

const ExactRays::Ray& ExactRays::ray(std::int32_t x, std::int32_t y) {
  if (ray_.x == x && ray_.y == y) return ray_;
  ray_.x = x, ray_.y = y;
  const Camera& camera = scene_.camera;
  if (camera.kind == Camera::Kind::screen) {
    ray_.from = {x, y, 0}, ray_.along = {0, 0, 1};
    return ray_;
  }
  // The axes of view coordinates are the rows of T_v.
  const auto row = [&](int i) { return exactly(glm::dvec3(camera.view[0][i], camera.view[1][i], camera.view[2][i])); };
  const Point right = row(0), up = row(1), away = row(2);
  const Rational width = scene_.raster.width, height = scene_.raster.height, w_y = exactly(camera.window),
                 w_x = formulas::window_width(w_y, width, height);
  const Rational x_p = formulas::ray_x(Rational(x), w_x, width), y_p = formulas::ray_y(Rational(y), w_y, height);
  const Point across = scaled(right, x_p) + scaled(up, y_p);
  if (camera.kind == Camera::Kind::orthographic) {
    const Point origin = exactly(glm::dvec3(camera.view[3]));  // of the world, in view coordinates
    ray_.from = across - (scaled(right, origin.x) + scaled(up, origin.y) + scaled(away, origin.z));
    ray_.along = away;
  } else {
    ray_.from = exactly(camera.eye), ray_.along = across + scaled(away, exactly(camera.d));
  }
  return ray_;
}

const std::optional<Plane>& ExactRays::plane(std::int32_t facet) {
  const auto [known, is_new] = planes_.try_emplace(facet);
  if (!is_new || facet < 0 || static_cast<std::size_t>(facet) >= scene_.facets.size()) return known->second;
  const Facet& entry = scene_.facets[static_cast<std::size_t>(facet)];
  std::vector<Point> corners;
  for (std::int32_t i = 0; i < entry.corner_count; ++i) {
    const std::int32_t corner = scene_.corners[static_cast<std::size_t>(entry.first_corner + i)];
    const glm::dvec3& point = scene_.points[static_cast<std::size_t>(corner)];
    if (!std::isfinite(point.x + point.y + point.z)) return known->second;
    corners.push_back(exactly(point));
  }
  if (corners.size() >= 3) known->second = plane_of(corners);
  return known->second;
}

std::optional<Rational> ExactRays::meet(std::int32_t facet, std::int32_t x, std::int32_t y) {
  const std::optional<Plane>& on = plane(facet);
  if (!on) return std::nullopt;
  const Ray& through = ray(x, y);
  const Rational slope = on->a * through.along.x + on->b * through.along.y + on->c * through.along.z;
  if (slope == 0) return std::nullopt;
  return -on->value(through.from) / slope;
}

Rational ExactRays::depth(const Rational& t) const {
  const bool perspective = scene_.camera.kind == Camera::Kind::perspective;
  return depth_of_view(scene_.camera, depth_, perspective ? t * exactly(scene_.camera.d) : t);
}

}  // namespace zstep::oracle
