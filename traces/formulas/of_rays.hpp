// Rays: the plane of a facet and the point on it (002, "Simple Ray Tracing").
#pragma once

#include <algorithm>
#include <cmath>

#include "traces/formulas/vectors.hpp"

namespace zstep::formulas {

namespace detail {

/// The ray at work: X = X_0 + t dX.
inline const RayBegin* ray_at_work(const Situation& at) {
  const RayWork& rays = at.method().rays;
  if (!rays.ray) return nullptr;
  // Rays are numbered in the order of work, and one pixel may have tens of thousands.
  const auto found = std::lower_bound(rays.tree.begin(), rays.tree.end(), *rays.ray,
                                      [](const RayRow& row, std::int32_t ray) { return row.entry.ray < ray; });
  return found != rays.tree.end() && found->entry.ray == *rays.ray ? &found->entry : nullptr;
}

}  // namespace detail

template <class Out>
void derive(const BoxTest& e, const Situation&, Out& out) {
  if (e.hit) out.rule(Rule::box_entered, e.t_enter <= e.t_leave);
}

template <class Out>
void derive(const RayPlane& e, const Situation&, Out& out) {
  if (std::isnan(e.t)) return;  // it runs along the plane, within a tolerance of the program's own
  out.gives(&RayPlane::t,
            out.number("numerator", e.numerator, Place{}) / out.number("denominator", e.denominator, Place{}));
}

template <class Out>
void derive(const RayHit& e, const Situation& at, Out& out) {
  if (const auto& plane = at.method().rays.plane_test; plane && plane->facet == e.facet)
    out.gives(&RayHit::t, out.number("t of the plane", plane->t, Place{Place::In::ray, 0, "t"}));
  const RayBegin* ray = detail::ray_at_work(at);
  if (!ray) return;
  const Place place{Place::In::ray, 0};
  const auto t = out.number("t", e.t, Place{});
  const auto along = [&](std::string_view start, double from, std::string_view direction, double step) {
    return out.number(start, from, place[start]) + t * out.number(direction, step, place[direction]);
  };
  out.gives(&RayHit::x_hit, along("x_0", ray->x_0, "dir_x", ray->dir_x));
  out.gives(&RayHit::y_hit, along("y_0", ray->y_0, "dir_y", ray->dir_y));
  out.gives(&RayHit::z_hit, along("z_0", ray->z_0, "dir_z", ray->dir_z));
  out.rule(Rule::kept_inside, e.inside || !e.nearest);
}

template <class Out>
void derive(const RayEnd& e, const Situation& at, Out& out) {
  // Of a shadow ray any hit will do; of others the nearest that was kept is the end. Only the hits of the ray that was
  // cast last are at hand.
  const RayBegin* ray = detail::ray_at_work(at);
  if (!ray || ray->ray != e.ray || at.method().rays.tree.back().entry.ray != e.ray || ray->role == RayRole::shadow ||
      !at.records<RayHit>())
    return;
  const RayHit* kept = nullptr;
  for (const RayHit& hit : at.method().rays.hits)
    if (hit.nearest) kept = &hit;
  if (kept) out.is(&RayEnd::nearest_facet, kept->facet);
  if (kept) out.is(&RayEnd::t, kept->t);
}

}  // namespace zstep::formulas
