// Colours: what rays bring back (002, "Simple Ray Tracing"), and what becomes of a colour in shadow (004) and behind
// glass.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "traces/formulas/shading.hpp"
#include "traces/formulas/of_curves.hpp"
#include "traces/formulas/of_light.hpp"
#include "traces/formulas/of_rays.hpp"
#include "traces/formulas/of_shadows.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/math/whole.hpp"

namespace zstep::formulas {

/// Of a sum of colours, one more of which so much is seen: by its share of a pixel's area, or by the light that goes
/// its way.
template <class T>
T with_share(const T& sum, const T& share, const T& color) {
  return sum + share * color;
}

/// Of what came along a ray, the part that goes on along the one that cast it.
template <class T>
struct PartOfLight {
  T part, light;
};
/// What a face of this colour, 0 to 255, sends back along a ray: a part of its own light, of which so much is left
/// where the lamp does not shine, and parts of what came along the rays that were cast from it.
template <class T>
T light_back(const T& own_part, const T& color, const std::optional<T>& in_shadow_left,
             const std::optional<PartOfLight<T>>& mirrored, const std::optional<PartOfLight<T>>& through) {
  T light = color / T(255);
  if (in_shadow_left) light = light * *in_shadow_left;
  if (mirrored || through) light = own_part * light;
  if (mirrored) light = with_share(light, mirrored->part, mirrored->light);
  return through ? with_share(light, through->part, through->light) : light;
}

namespace detail {

using Light = std::array<double, 3>;
inline std::array<double, 3> channels(const Color& color) {
  return {static_cast<double>(color.red), static_cast<double>(color.green), static_cast<double>(color.blue)};
}
inline Light light_of(const RayEnd& end) { return {end.red, end.green, end.blue}; }

/// How dark a shadow is is the program's own where it is not nearly the formula's; but it is the same for all channels,
/// and no light is added. `full` without shadow, `rest` besides, `step` what the numbers are rounded to.
inline double shadow_factor(const std::array<double, 3>& recorded, const std::array<double, 3>& full,
                            const std::array<double, 3>& rest, double step) {
  const std::size_t largest = std::max_element(full.begin(), full.end()) - full.begin();
  if (!(full[largest] > 0)) return in_shadow;
  const double factor = (recorded[largest] - rest[largest]) / full[largest];
  constexpr double near = 0.02;
  if (std::abs(factor - in_shadow) <= std::max(near, step / full[largest])) return in_shadow;
  return std::clamp(factor, 0.0, 1.0);
}

/// What the light that comes back along a ray is made of: of the face that it meets the own colour, and by its material
/// what came along the rays that were cast from there.
struct LightBack {
  std::array<double, 3> color{};  ///< 0 to 255; where nothing is met, the background's
  double own_part = 1, mirror_part = 0, passes = 0;
  std::optional<Light> mirrored = {}, through = {};
  double left = 1;  ///< of the own light, where the lamp does not shine

  template <class T>
  T channel(std::size_t k) const {
    const auto part = [&](double share, const std::optional<Light>& light) {
      return light ? std::optional(PartOfLight<T>{T(share), T((*light)[k])}) : std::nullopt;
    };
    return formulas::light_back<T>(T(own_part), T(color[k]), left != 1 ? std::optional(T(left)) : std::nullopt,
                                   part(mirror_part, mirrored), part(passes, through));
  }
};
/// Nothing where one of the rays has not ended.
inline std::optional<LightBack> light_back(const RayEnd& e, const Situation& at) {
  const auto& tree = at.method().rays.tree;
  const std::size_t facet = e.nearest_facet;
  LightBack back{channels(at.scene.background)};
  if (e.nearest_facet < 0 || facet >= at.scene.facets.size()) return back;
  const Polygon& polygon = at.scene.polygons[at.scene.facets[facet].polygon];
  back.color = channels(polygon.color);
  bool dark = false;
  for (auto row = tree.rbegin(); row != tree.rend() && row->entry.ray > e.ray; ++row) {
    if (row->entry.parent != e.ray) continue;
    if (!row->end) return std::nullopt;
    if (row->entry.role == RayRole::shadow) dark = row->end->nearest_facet >= 0;
    else (row->entry.role == RayRole::reflected ? back.mirrored : back.through) = light_of(*row->end);
  }
  const Material& material = *polygon.material;
  back.passes = (1 - material.reflectance) * (1 - material.opacity);
  // Where rays go no deeper a polygon has its own colour alone.
  if (back.mirrored || back.through) back.own_part = (1 - material.reflectance) * material.opacity;
  // What cannot leave is mirrored, too.
  back.mirror_part = material.reflectance + (back.through ? 0 : back.passes);
  if (!dark) return back;
  LightBack own = back;
  own.mirrored = own.through = std::nullopt;
  std::array<double, 3> full{}, rest{};
  for (std::size_t k = 0; k < 3; ++k)
    full[k] = back.own_part * own.channel<double>(k), rest[k] = back.channel<double>(k) - full[k];
  back.left = shadow_factor({e.red, e.green, e.blue}, full, rest, 0);
  return back;
}

}  // namespace detail

template <class Out>
void derive(const RayEnd& e, const Situation& at, Out& out) {
  const RayBegin* ray = detail::ray_at_work(at);
  if (!ray || ray->ray != e.ray) return;
  // Of a shadow ray any hit will do; of others the nearest that was kept is the end. Boxes, planes and hits are at hand
  // of the ray cast last.
  if (ray == detail::ray_cast_last(at)) {
    if (at.records<RayPlane>()) out.is(&RayEnd::tests, static_cast<std::int32_t>(at.method().rays.planes_tested));
    if (ray->role != RayRole::shadow && at.records<RayHit>()) {
      const RayHit* kept = detail::kept_hit(at);
      out.is(&RayEnd::nearest_facet, kept ? kept->facet : -1);
      if (kept) out.is(&RayEnd::t, kept->t);
    }
  }
  // A program to which colours are nothing leaves them 0; how much of the light glass lets through is its own.
  const bool says_colors = e.red != 0 || e.green != 0 || e.blue != 0;
  if (ray->role == RayRole::shadow || !says_colors) return;
  const auto light = detail::light_back(e, at);
  if (!light) return;
  out.near(&RayEnd::red, light->template channel<Rounded>(0));
  out.near(&RayEnd::green, light->template channel<Rounded>(1));
  out.near(&RayEnd::blue, light->template channel<Rounded>(2));
}

namespace detail {

/// One byte of a colour: rounded to the nearest one, or cut off.
inline std::int32_t shade_of(std::int32_t recorded, double value) {
  if (std::abs(recorded - value) < 1) return recorded;
  constexpr double most = 1e6;  // a program may bring back any light
  return std::isnan(value) ? -1 : nearest_int(std::clamp(value, -most, most));
}

}  // namespace detail

/// A curve's ink, light on the way back along a ray, the shares of a pixel, or a polygon's colour where the light does
/// not reach it or as its attribute shades it.
template <class Out>
void derive(const ColorWrite& e, const Situation& at, Out& out) {
  const auto& tree = at.method().rays.tree;
  const auto& covered = at.method().sweep.covered;
  const auto& shadow = at.method().shadow;
  const auto& attribute = at.method().attribute;
  std::array<double, 3> shades{};
  if (at.method().horizon.here) {
    if (!at.records<HorizonMove>()) return;  // what is visible goes by the horizons
    const detail::DrawnOfCurve drawn = detail::drawn_of_curve(at, e);
    if (!drawn.known) return;
    out.rule(Rule::ink_on_curve, drawn.part.has_value());
    if (!drawn.part) return;
    shades = detail::channels(detail::ink_of_curve(at.scene.background, drawn.part->where));
  } else if (!tree.empty() && tree.front().end) {
    const RayEnd& end = *tree.front().end;
    out.rule(Rule::ray_paints_own, tree.front().entry.x == e.x && tree.front().entry.y == e.y);
    shades[0] = 255 * end.red, shades[1] = 255 * end.green, shades[2] = 255 * end.blue;
  } else if (!covered.empty() && covered.front().x == e.x && covered.front().y == e.y) {
    for (const CoverageAdd& share : covered) {
      const std::size_t owner = share.owner;
      const Color color =
          share.owner < 0 || owner >= at.scene.polygons.size() ? at.scene.background : at.scene.polygons[owner].color;
      for (std::size_t k = 0; k < 3; ++k)
        shades[k] = with_share<double>(shades[k], share.coverage, detail::channels(color)[k]);
    }
  } else if (shadow && shadow->x == e.x && shadow->y == e.y) {
    const std::size_t pixel = at.pixel(e.x, e.y);
    const std::size_t polygon = at.before.picture.polygon[pixel];
    if (polygon >= at.scene.polygons.size()) return;
    out.reads(Place{Place::In::frame, at.pixel(e.x, e.y)});
    const std::array<double, 3> recorded{static_cast<double>(e.r8), static_cast<double>(e.g8),
                                         static_cast<double>(e.b8)};
    shades = detail::channels(at.scene.polygons[polygon].color);
    const auto& told = at.method().light_share;
    const bool is_told = told && told->x == e.x && told->y == e.y;
    const auto found = is_told ? std::optional(told->share) : detail::share_of_compares(at, *shadow);
    if (!found) return;
    const double share = *found;
    std::array<double, 3> by_light = shades, besides = shades;
    for (std::size_t k = 0; k < 3; ++k) by_light[k] *= share, besides[k] *= 1 - share;
    const double left = share < 1 ? detail::shadow_factor(recorded, besides, by_light, 1) : in_shadow;
    for (double& shade : shades) shade *= kept_of_color(left, share);
    if (left != in_shadow)  // of which the byte that tells it leaves one digit open
      for (std::size_t k = 0; k < 3; ++k)
        if (std::abs(recorded[k] - shades[k]) < 2) shades[k] = recorded[k];
  } else if (attribute && attribute->x == e.x && attribute->y == e.y) {
    const Shading shading = shading_of(at.scene, at.header.conventions);
    std::span<const double> a = at.method().components;
    if (!shading.is_known()) return;
    if (shading.components() == 1) a = std::span(&attribute->attribute, 1);
    else if (at.method().component + 1 != shading.components()) return;
    for (std::int32_t k = 0; k < shading.components(); ++k) out.reads(Place{Place::In::attribute, k});
    const std::size_t polygon = at.before.picture.polygon[at.pixel(e.x, e.y)];
    if (polygon >= at.scene.polygons.size()) return;
    const std::int32_t number = index32(polygon);
    if (at_shade_edge(at.scene, shading, number, a)) return;
    out.reads(Place{Place::In::frame, at.pixel(e.x, e.y)});
    shades = shaded(at.scene, shading, number, a);
  } else {
    return;
  }
  out.is(&ColorWrite::r8, detail::shade_of(e.r8, shades[0]));
  out.is(&ColorWrite::g8, detail::shade_of(e.g8, shades[1]));
  out.is(&ColorWrite::b8, detail::shade_of(e.b8, shades[2]));
}

/// Glass: opacity times the polygon's colour, and the rest of what is behind it.
template <class Out>
void derive(const ColorBlend& e, const Situation& at, Out& out) {
  if (at.method().polygon != no_polygon) out.is(&ColorBlend::polygon, at.method().polygon);
  const std::size_t number = e.polygon;
  if (e.polygon < 0 || number >= at.scene.polygons.size()) return;
  const Polygon& polygon = at.scene.polygons[number];
  out.is(&ColorBlend::opacity, polygon.material->opacity);
  const Color under = color_at(at.before.picture, at.scene, static_cast<std::size_t>(at.pixel(e.x, e.y)));
  out.reads(Place{Place::In::frame, at.pixel(e.x, e.y)});
  if (const Fragment* fragment = at.fragment(e.x, e.y); fragment && fragment->nearer)
    out.rule(Rule::write_after_win, *fragment->nearer);
  const auto shade = [&](std::int32_t recorded, std::uint8_t top, std::uint8_t bottom) {
    return detail::shade_of(recorded, laid_over<double>(e.opacity, top, bottom));
  };
  out.is(&ColorBlend::r8, shade(e.r8, polygon.color.red, under.red));
  out.is(&ColorBlend::g8, shade(e.g8, polygon.color.green, under.green));
  out.is(&ColorBlend::b8, shade(e.b8, polygon.color.blue, under.blue));
}

}  // namespace zstep::formulas
