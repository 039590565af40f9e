#include "sim/cost/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scan_conversion/numbers.hpp"
#include "traces/error.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/oracle/exact_depth.hpp"

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
  corner.x = formulas::screen_x(x_p, w_x, width, scene.raster),
  corner.y = formulas::screen_y(y_p, w_y, height, scene.raster);
  corner.z = formulas::vertex_depth(formulas::depth_scale(camera, depth, number), z_v);
  return corner;
}

template <class T>
std::optional<double> bound_of(const Scene& scene, Conventions::Depth depth, const Facet& shape,
                               const oracle::SeenPlane& plane) {
  // What is off at the corners is off in between in the same measure at most: it goes linearly from one to the other.
  double most = 0;
  for (std::int32_t i = 0; i < shape.corner_count; ++i) {
    const std::int32_t number = scene.corners[shape.first_corner + i];
    const Corner<T> corner = viewed<T>(scene, depth, scene.points[number]);
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
  if (facet < 0 || facet >= std::ssize(scene.facets)) return std::nullopt;
  const Facet& shape = scene.facets[facet];
  const bool by_plane = conventions.interpolation == Conventions::Interpolation::plane ||
                        conventions.interpolation == Conventions::Interpolation::plane_increments;
  if (conventions.positions != Conventions::Positions::exact || (by_plane && shape.corner_count > 3) ||
      formulas::rounds(conventions.coverage))
    return std::nullopt;
  const auto plane = oracle::seen_plane(scene, conventions.depth, facet);
  if (!plane) return std::nullopt;
  return conventions.number_format == NumberFormat::float32 ? bound_of<float>(scene, conventions.depth, shape, *plane)
                                                            : bound_of<double>(scene, conventions.depth, shape, *plane);
}

}  // namespace zstep::compare
