#include "sim/cost/viewing_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/scan_conversion/numbers.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/oracle/seen_plane.hpp"

namespace zstep::compare {

namespace {

/// A corner as numbers of type T have it, each with its bound.
template <class T>
struct Corner {
  Bounded<T> x, y, z;
  bool in_view = true;
};
template <class T>
Corner<T> viewed(const Scene& scene, Conventions::Depth depth, const glm::dvec3& point) {
  using Number = Bounded<T>;
  const auto number = [](double value) {
    const T known = static_cast<T>(value);
    return Number(known, std::abs(static_cast<double>(known) - value));
  };
  const Camera& camera = scene.camera;
  Corner<T> corner{number(point.x), number(point.y), number(point.z)};
  if (camera.kind == Camera::Kind::screen) return corner;
  const auto row = [&](int i) {
    const auto t = [&](int k) { return number(camera.view[k][i]); };
    return formulas::matrix_row(t(0), t(1), t(2), t(3), corner.x, corner.y, corner.z);
  };
  const bool parallel = camera.kind == Camera::Kind::orthographic;
  const Number x_v = row(0), y_v = row(1), z_v = row(2), d = number(camera.d), near = number(camera.near),
               far = number(camera.far), w_y = number(camera.window), width = number(scene.raster.width),
               height = number(scene.raster.height), w_x = formulas::window_width(w_y, width, height);
  const Number x_p = parallel ? x_v : formulas::projected(d, x_v, z_v),
               y_p = parallel ? y_v : formulas::projected(d, y_v, z_v);
  const auto beyond = [](double size, double limit) { return size > limit; };
  corner.in_view = !beyond(near, z_v) && !beyond(z_v, far) && !beyond(std::abs(double{x_p}), w_x) &&
                   !beyond(std::abs(double{y_p}), w_y);
  corner.x = formulas::screen_x(x_p, w_x, width), corner.y = formulas::screen_y(y_p, w_y, height);
  corner.z = depth != Conventions::Depth::pseudodepth ? formulas::other_depth(depth, parallel, near, far, z_v)
             : parallel                               ? formulas::parallel_pseudodepth(near, far, z_v)
                                                      : formulas::pseudodepth(near, formulas::pseudodepth_a(near, far),
                                                                              formulas::pseudodepth_b(near, far), z_v);
  return corner;
}

template <class T>
std::optional<double> bound_of(const Scene& scene, Conventions::Depth depth, const Facet& shape,
                               const oracle::SeenPlane& plane) {
  // What is off at the corners is off in between in the same measure at most: it goes linearly from one to the other.
  double most = 0;
  for (std::int32_t i = 0; i < shape.corner_count; ++i) {
    const std::int32_t number = scene.corners[static_cast<std::size_t>(shape.first_corner + i)];
    const Corner<T> corner = viewed<T>(scene, depth, scene.points[static_cast<std::size_t>(number)]);
    if (!corner.in_view) return std::nullopt;
    most = std::max(most,
                    corner.z.error + std::abs(plane.dz_dx) * corner.x.error + std::abs(plane.dz_dy) * corner.y.error);
  }
  return most + plane.bend;
}

}  // namespace

std::optional<double> viewing_bound(const Trace& run, std::int32_t facet) {
  const Conventions& conventions = run.header().conventions;
  const Scene& scene = run.scene();
  if (facet < 0 || static_cast<std::size_t>(facet) >= scene.facets.size()) return std::nullopt;
  const Facet& shape = scene.facets[static_cast<std::size_t>(facet)];
  const bool by_plane = conventions.interpolation == Conventions::Interpolation::plane ||
                        conventions.interpolation == Conventions::Interpolation::plane_increments;
  if (conventions.positions != Conventions::Positions::exact || (by_plane && shape.corner_count > 3) ||
      conventions.coverage == Conventions::Coverage::round)
    return std::nullopt;
  const auto plane = oracle::seen_plane(scene, conventions.depth, facet);
  if (!plane) return std::nullopt;
  return conventions.number_format == NumberFormat::float32 ? bound_of<float>(scene, conventions.depth, shape, *plane)
                                                            : bound_of<double>(scene, conventions.depth, shape, *plane);
}

}  // namespace zstep::compare
