// Mistakes with rays: which of the points that a ray meets is kept, and which boxes it is thought to meet (002).
#pragma once

#include "traces/formulas/of_rays.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

inline void suppose(const BoxTest& e, const Situation& at, Supposed& out) {
  const RayBegin* ray = formulas::detail::ray_cast_last(at);
  const auto box = static_cast<std::size_t>(e.box);
  if (!ray || e.box < 0 || box >= at.method().boxes.size()) return;
  const std::array<double, 3> way = formulas::detail::way_of(*ray);
  if (std::find(way.begin(), way.end(), 0.0) == way.end()) return;
  const formulas::detail::Passage passage = formulas::detail::passage_of(*ray, at.method().boxes[box].entry);
  const formulas::detail::Reach reach = formulas::detail::reach_of(at, *ray);
  const RayHit* kept = formulas::detail::kept_hit(at);
  const bool met = passage.enter.value < passage.leave.value && passage.leave.value > reach.least &&
                   passage.enter.value < (kept ? kept->t : reach.most);
  if (met) out.says(box_misses_at_0, !e.hit, e.hit, "t_enter t_leave hit");
}

inline void suppose(const RayHit& e, const Situation& at, Supposed& out) {
  const RayBegin* ray = formulas::detail::ray_at_work(at);
  if (!ray || formulas::detail::ray_cast_last(at) != ray) return;
  const formulas::detail::Reach reach = formulas::detail::reach_of(at, *ray);
  const RayHit* kept = formulas::detail::kept_hit(at);
  const bool nearer = !kept || e.t < kept->t;
  if (e.t < reach.least) {
    const bool kept_on = e.nearest == (e.inside && nearer);
    if (kept_on) out.says(negative_t, true, false, "nearest");
    else out.rules_out(negative_t);
  }
  if (!e.inside || e.t < reach.least || e.t > reach.most || (kept && e.t == kept->t)) return;
  out.says(nearest_by_index, e.nearest, e.nearest == nearer, "nearest");
}

}  // namespace zstep::mistakes
