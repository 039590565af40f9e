// What the light reaches (004, "shadow buffer"): where a pixel's point is in the light's picture, how far behind the
// depths there it may lie, and what share of the light its neighbours there give it.
//
// The bias that grows with a polygon's slope is OpenGL's polygon offset, factor * m + units, and Direct3D's
// SlopeScaledDepthBias. The share is percentage-closer filtering: W. Reeves, D. Salesin, R. Cook, "Rendering
// Antialiased Shadows with Depth Maps", SIGGRAPH 1987.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "traces/formulas/of_light.hpp"
#include "traces/formulas/vectors.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::formulas {

/// How far behind the shadow buffer a point may lie and still be lit: a share of its distance z_v from the light, and
/// so many times the greater slope of its polygon.
template <class T>
T light_bias(const T& z_v, const T& constant, const T& factor, const T& slope) {
  return z_v * constant + factor * slope;
}

/// What z_v of a plane gains from one pixel of a picture to the next one, which is `pixel` away on the projection
/// plane: at the point P at z_v, of the plane's normal N its part `n` that way, and N · P.
template <class T>
T slope_in_picture(const T& n, const T& n_p, const T& z_v, const T& d, const T& pixel) {
  return -(n * z_v * z_v * pixel) / (d * n_p);
}
/// A polygon that the light sees edge-on has any slope; no more than z_v is of use.
template <class T>
T slope_at_light(const T& n, const T& n_p, const T& z_v, const T& d, const T& pixel) {
  const double over = std::abs(value_of(n) * value_of(z_v) * value_of(pixel)), under = std::abs(value_of(d * n_p));
  if (over < under) return slope_in_picture(n, n_p, z_v, d, pixel);
  return over == 0 ? T(0.0) : z_v;
}
template <class T>
struct LightSlopes {
  T dz_dx, dz_dy;
  double greater() const { return std::max(std::abs(value_of(dz_dx)), std::abs(value_of(dz_dy))); }
};

/// Twice the area of a polygon as a vector: of all its facets.
template <class T>
Vector<T> normal_of_polygon(const Scene& scene, std::int32_t polygon) {
  Vector<T> sum{T(0.0), T(0.0), T(0.0)};
  auto facet = std::lower_bound(scene.facets.begin(), scene.facets.end(), polygon,
                                [](const Facet& one, std::int32_t wanted) { return one.polygon < wanted; });
  for (; facet != scene.facets.end() && facet->polygon == polygon; ++facet)
    sum = newell_normal(sum, facet->corner_count, [&](std::size_t i) {
      const glm::dvec3& corner = scene.points[scene.corners[facet->first_corner + i]];
      return Vector<T>{T(corner.x), T(corner.y), T(corner.z)};
    });
  return sum;
}
/// The slopes of a polygon in the light's picture, where its point in the light's view coordinates is `p`.
template <class T>
LightSlopes<T> light_slopes(const Vector<T>& normal, const Camera& lamp, const Raster& raster, const Vector<T>& p) {
  const auto turned = [&](int row) {
    return T(lamp.view[0][row]) * normal.x + T(lamp.view[1][row]) * normal.y + T(lamp.view[2][row]) * normal.z;
  };
  const Vector<T> n{turned(0), turned(1), turned(2)};
  const double width = 2 * lamp.window / raster.height, height = raster.y_up ? width : -width;
  const T n_p = dot(n, p), d(lamp.d);
  return {slope_at_light(n.x, n_p, p.z, d, T(width)), slope_at_light(n.y, n_p, p.z, d, T(height))};
}

/// How a run compares with the shadow buffer, by the options that its header declares.
struct ShadowOptions {
  bool declared = false;  ///< any of them
  double bias = 0, slope_bias = 0;
  std::int32_t across = 1;  ///< pixels of the shadow buffer, each way, that a point is compared with
};
/// What stands where an option is left out; the bias in 1/1000 of the distance.
inline constexpr std::string_view standard_bias = "10", standard_slope_bias = "0", standard_pcf = "1";
inline ShadowOptions shadow_options(const Conventions& conventions) {
  ShadowOptions found;
  const auto number = [&](const char* name, std::string_view standard) {
    const auto given = conventions.options.find(name);
    found.declared |= given != conventions.options.end();
    return std::strtod(given == conventions.options.end() ? std::string(standard).c_str() : given->second.c_str(),
                       nullptr);
  };
  found.bias = number("bias", standard_bias) / 1000;
  found.slope_bias = number("slope-bias", standard_slope_bias);
  constexpr double most = 99;
  found.across = static_cast<std::int32_t>(std::clamp(number("pcf", standard_pcf), 1.0, most));
  return found;
}

/// Calls use(column, row) for the neighbours of a pixel of the shadow buffer that are compared besides it: row by row,
/// `across` each way, those on the raster.
template <class Use>
void for_each_neighbour(double column, double row, std::int32_t across, const Raster& raster, Use&& use) {
  const std::int32_t reach = across / 2;
  const auto is_near = [&](double place, std::int32_t size) { return place >= -reach && place < size + reach; };
  if (!is_near(column, raster.width) || !is_near(row, raster.height)) return;
  const auto x = static_cast<std::int32_t>(column), y = static_cast<std::int32_t>(row);
  for (std::int32_t j = std::max(y - reach, 0); j <= std::min(y + reach, raster.height - 1); ++j)
    for (std::int32_t i = std::max(x - reach, 0); i <= std::min(x + reach, raster.width - 1); ++i)
      if (i != x || j != y) use(i, j);
}

namespace detail {

/// The point that the eye sees at a pixel, as the light sees it.
struct PointAtLight {
  Vector<Rounded> seen;  ///< in the light's view coordinates
  double lost = 1;       ///< there and back through two cameras some digits are lost
  std::int32_t polygon = no_polygon;
};
inline std::optional<PointAtLight> point_at_light(const Situation& at, std::int32_t x, std::int32_t y) {
  if (!at.camera || !at.lamp || at.on_screen() || !at.header.declares(Convention::depth)) return std::nullopt;
  const Camera &camera = *at.camera, &lamp = *at.lamp;
  const Raster& raster = at.scene.raster;
  const double z_v = view_depth(camera, at.header.conventions, at.stored(x, y));
  if (!std::isfinite(z_v)) return std::nullopt;
  const double w_x = camera.window * raster.width / raster.height;
  const double per_plane = camera.kind == Camera::Kind::orthographic ? 1 : z_v / camera.d;
  const glm::dvec4 point = glm::inverse(camera.view) *
                           glm::dvec4(window_x<double>(x, w_x, raster.width, raster) * per_plane,
                                      window_y<double>(y, camera.window, raster.height, raster) * per_plane, z_v, 1);
  const glm::dvec4 seen = lamp.view * point;
  if (!(seen.z > 0)) return std::nullopt;
  PointAtLight found;
  found.lost = 1 + std::abs(z_v / seen.z) + std::abs(seen.z / lamp.near);
  const double off = 8 * found.lost * std::max({std::abs(seen.x), std::abs(seen.y), seen.z});
  found.seen = {Rounded(seen.x, off), Rounded(seen.y, off), Rounded(seen.z, off)};
  found.polygon = at.before.picture.polygon[at.pixel(x, y)];
  return found;
}

inline LightSlopes<Rounded> slopes_at(const Situation& at, const PointAtLight& point) {
  const auto normal = normal_of_polygon<Rounded>(at.scene, point.polygon);
  return light_slopes(normal, *at.lamp, at.scene.raster, point.seen);
}

/// What the bias at a pixel is: as it was recorded, or by the options. Nothing where no option is declared: how large
/// it is is the program's own then.
inline std::optional<double> bias_at(const Situation& at, std::int32_t x, std::int32_t y, const PointAtLight& point) {
  const auto& told = at.method().shadow_bias;
  if (told && told->x == x && told->y == y) return told->bias;
  const ShadowOptions options = shadow_options(at.header.conventions);
  if (!options.declared || (options.slope_bias != 0 && point.polygon == no_polygon)) return std::nullopt;
  const double slope = options.slope_bias != 0 ? slopes_at(at, point).greater() : 0;
  return light_bias(point.seen.z.value, options.bias, options.slope_bias, slope);
}

/// Is the point lit by what the shadow buffer holds at a pixel? Nothing where rounding, or a bias that is not known,
/// may turn it.
inline std::optional<bool> lit_at(const Situation& at, std::int32_t x, std::int32_t y, const PointAtLight& point,
                                  double column, double row) {
  const Picture& light = at.before.light;
  if (light.depth.empty()) return std::nullopt;
  const std::optional<double> bias = bias_at(at, x, y, point);
  const bool on_raster = column >= 0 && column < light.width && row >= 0 && row < light.height;
  if (!on_raster) return bias ? std::optional(false) : std::nullopt;
  const std::size_t pixel = light.at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
  const double stored = view_depth(*at.lamp, at.header.conventions, light.depth[pixel]), z_v = point.seen.z.value;
  constexpr double some = 0.1;
  const double margin = rounding_of_float32 * z_v, least = bias.value_or(0), most = bias.value_or(some * z_v);
  if (z_v < at.lamp->near - margin) return bias ? std::optional(false) : std::nullopt;
  if (z_v > at.lamp->near && z_v - least < stored - margin) return true;
  if (z_v - most > stored + margin) return false;
  return std::nullopt;
}

/// The neighbour that is compared next, nothing where all have been.
struct NextNeighbour {
  std::int32_t x, y;
};
inline std::optional<NextNeighbour> next_neighbour(const Situation& at, const ShadowCompare& compare,
                                                   const PointAtLight& point, std::size_t done) {
  std::optional<NextNeighbour> next;
  if (point.seen.z.value < at.lamp->near) return next;
  for_each_neighbour(std::round(compare.x_light), std::round(compare.y_light),
                     shadow_options(at.header.conventions).across, at.scene.raster,
                     [&](std::int32_t x, std::int32_t y) {
                       if (done-- == 0) next = {x, y};
                     });
  return next;
}

/// How many of a point's compares say lit. What the run does not tell is compared here; beside the light's picture all
/// is dark.
inline std::optional<double> share_of_compares(const Situation& at, const ShadowCompare& compare) {
  const auto& neighbours = at.method().neighbours;
  double lit = compare.lit ? 1 : 0;
  for (const ShadowNeighbour& neighbour : neighbours) lit += neighbour.lit ? 1 : 0;
  const ShadowOptions options = shadow_options(at.header.conventions);
  if (!options.declared) return lit / (1 + static_cast<double>(neighbours.size()));
  const auto point = point_at_light(at, compare.x, compare.y);
  if (!point) return std::nullopt;
  for (std::size_t done = neighbours.size();; ++done) {
    const auto next = next_neighbour(at, compare, *point, done);
    if (!next) return lit / (options.across * options.across);
    const auto missing = lit_at(at, compare.x, compare.y, *point, next->x, next->y);
    if (!missing) return std::nullopt;
    lit += *missing ? 1 : 0;
  }
}

}  // namespace detail

/// How steep a pixel's polygon is as the light sees it, and what bias that makes.
template <class Out>
void derive(const ShadowBias& e, const Situation& at, Out& out) {
  const auto point = detail::point_at_light(at, e.x, e.y);
  if (!point) return;
  out.reads(at.depth_place(e.x, e.y));
  if (point->polygon != no_polygon) {  // of a run that never says who is seen no slope is known
    const auto slopes = detail::slopes_at(at, *point);
    out.near(&ShadowBias::dz_dx_light, slopes.dz_dx), out.near(&ShadowBias::dz_dy_light, slopes.dz_dy);
  }
  const ShadowOptions options = shadow_options(at.header.conventions);
  if (!options.declared) return;
  const Rounded steeper = std::max(std::abs(e.dz_dx_light), std::abs(e.dz_dy_light));
  out.near(&ShadowBias::bias, light_bias(point->seen.z, Rounded(options.bias), Rounded(options.slope_bias), steeper));
}

/// A pixel's point as the light sees it.
template <class Out>
void derive(const ShadowCompare& e, const Situation& at, Out& out) {
  const auto point = detail::point_at_light(at, e.x, e.y);
  if (!point) return;
  out.reads(at.depth_place(e.x, e.y));
  const Camera& lamp = *at.lamp;
  const Raster& raster = at.scene.raster;
  const double x_v = point->seen.x.value, y_v = point->seen.y.value, z_v = point->seen.z.value, lost = point->lost;
  const double w_x = lamp.window * raster.width / raster.height;
  const double x = screen_x<double>(projected<double>(lamp.d, x_v, z_v), w_x, raster.width, raster),
               y = screen_y<double>(projected<double>(lamp.d, y_v, z_v), lamp.window, raster.height, raster),
               z = buffer_depth(lamp, at.header.conventions, z_v);
  out.near(&ShadowCompare::x_light, Rounded(x, 8 * lost * (std::abs(x) + raster.width)));
  out.near(&ShadowCompare::y_light, Rounded(y, 8 * lost * (std::abs(y) + raster.height)));
  out.near(&ShadowCompare::z_light, Rounded(z, 8 * lost * (std::abs(z) + 1)));
  const auto lit = detail::lit_at(at, e.x, e.y, *point, std::round(e.x_light), std::round(e.y_light));
  if (lit) out.is(&ShadowCompare::lit, *lit);
}

/// The neighbours of the pixel that the point was compared with have their turn one by one.
template <class Out>
void derive(const ShadowNeighbour& e, const Situation& at, Out& out) {
  const auto& compare = at.method().shadow;
  if (!compare) return;
  out.is(&ShadowNeighbour::x, compare->x), out.is(&ShadowNeighbour::y, compare->y);
  const auto point = detail::point_at_light(at, compare->x, compare->y);
  if (!point) return;
  if (shadow_options(at.header.conventions).declared) {
    const auto next = detail::next_neighbour(at, *compare, *point, at.method().neighbours.size());
    out.is(&ShadowNeighbour::x_shadow, next ? next->x : -1), out.is(&ShadowNeighbour::y_shadow, next ? next->y : -1);
  }
  const auto lit = detail::lit_at(at, compare->x, compare->y, *point, e.x_shadow, e.y_shadow);
  if (lit) out.is(&ShadowNeighbour::lit, *lit);
}

/// Outcomes are averaged, not depths.
template <class Out>
void derive(const LightShare&, const Situation& at, Out& out) {
  const auto& compare = at.method().shadow;
  if (!compare) return;
  out.is(&LightShare::x, compare->x), out.is(&LightShare::y, compare->y);
  if (const auto share = detail::share_of_compares(at, *compare)) out.near(&LightShare::share, Rounded(*share));
}

}  // namespace zstep::formulas
