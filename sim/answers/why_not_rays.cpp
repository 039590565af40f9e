// Rays: was the polygon's plane tested along the pixel's ray, was the point inside, was it the nearest; and if it was
// never tested, which box or cell kept it from the ray.
#include <algorithm>
#include <cmath>

#include "sim/answers/why_not_parts.hpp"

namespace zstep::answers {
namespace {

template <class E>
struct At {
  std::int64_t step = 0;
  E event{};
};

/// What the eye's ray through the pixel did.
struct Ray {
  std::int64_t begin = 0, end = 0;
  std::vector<At<RayPlane>> planes;  ///< of the polygon's facets
  std::vector<At<RayHit>> hits;      ///< of the polygon's facets
  std::vector<At<RayHit>> kept;      ///< whose ever, each nearer than all before
  std::vector<At<RayHit>> passed;    ///< whose ever, inside and not kept
  std::vector<At<BoxTest>> boxes;
  std::vector<At<CellVisit>> cells;

  const At<RayHit>* kept_before(std::int64_t step) const {
    const At<RayHit>* last = nullptr;
    for (const At<RayHit>& hit : kept)
      if (hit.step < step) last = &hit;
    return last;
  }
};

std::optional<Ray> follow(const Asked& q) {
  const auto through = [&](const RecordedEvent& recorded) {
    const auto* ray = get_if<RayBegin>(&recorded.event);
    return ray && ray->role == RayRole::eye && ray->x == q.pixel.x && ray->y == q.pixel.y;
  };
  const auto begin = q.trace.next(0, through, q.pixel);
  if (!begin) return std::nullopt;
  Ray ray;
  ray.begin = *begin;
  for (ray.end = *begin + 1; ray.end <= q.trace.size(); ++ray.end) {
    const std::int64_t step = ray.end;
    const Event& event = q.trace.event(step).event;
    if (holds<RayEnd>(event) || holds<RayBegin>(event)) break;
    if (const auto* plane = get_if<RayPlane>(&event); plane && polygon_of_facet(q.scene, plane->facet) == q.polygon)
      ray.planes.push_back({step, *plane});
    if (const auto* box = get_if<BoxTest>(&event)) ray.boxes.push_back({step, *box});
    if (const auto* cell = get_if<CellVisit>(&event)) ray.cells.push_back({step, *cell});
    if (const auto* hit = get_if<RayHit>(&event)) {
      if (hit->nearest) ray.kept.push_back({step, *hit});
      else if (hit->inside) ray.passed.push_back({step, *hit});
      if (polygon_of_facet(q.scene, hit->facet) == q.polygon) ray.hits.push_back({step, *hit});
    }
  }
  return ray;
}

void add_gap_along_ray(const Asked& q, Verdict& verdict, double t, double other) {
  verdict.gap = q.trace.header().comparison.behind(t, other);
  verdict.formulas.push_back(difference("t", q.name, q.label(verdict.other), t, other));
}

void add_hit(const Asked& q, Verdict& verdict, const At<RayHit>& hit) {
  const std::int32_t polygon = polygon_of_facet(q.scene, hit.event.facet);
  verdict.chain.push_back({hit.step, polygon,
                           fmt::format("the ray meets {} at t = {}{}", q.label(polygon), told(hit.event.t),
                                       hit.event.nearest ? ", the nearest so far" : "")});
}

/// It was met inside its outline, and another is nearer.
Verdict why_behind(Asked& q, const Ray& ray, const At<RayHit>& mine) {
  const At<RayHit>* other = nullptr;
  if (mine.event.nearest) {
    for (const At<RayHit>& hit : ray.kept)
      if (!other && hit.step > mine.step) other = &hit;
  } else {
    other = ray.kept_before(mine.step);
  }
  if (!other) return not_recorded(q);
  const std::int32_t who = polygon_of_facet(q.scene, other->event.facet);
  const bool tie = mine.event.t == other->event.t;
  const std::string gap = told(mine.event.t - other->event.t), name = q.label(who);
  const bool nearer =
      q.trace.header().comparison.behind(mine.event.t, other->event.t) < 0;  // and yet the other is kept
  Verdict verdict =
      tie ? q.verdict(Why::tie, std::max(mine.step, other->step),
                      fmt::format("the ray meets it at exactly the same t as {}, which {}", name,
                                  kept_in_tie(q.trace.header(), other->event.facet < mine.event.facet, "is kept")))
      : nearer
          ? q.verdict(
                Why::contradicted, std::max(mine.step, other->step),
                fmt::format("the ray meets it at step {} at t = {}, nearer than {} at t = {}, but the trace keeps {}",
                            grouped(mine.step), told(mine.event.t), name, told(other->event.t), name))
      : mine.event.nearest ? q.verdict(Why::overwritten, other->step,
                                       fmt::format("it was the nearest on the ray from step {} on, until {} was met at "
                                                   "step {}, nearer by \u0394t = {}",
                                                   grouped(mine.step), name, grouped(other->step), gap))
                           : q.verdict(Why::lost, mine.step,
                                       fmt::format("the ray meets it at step {}, but {} is nearer by \u0394t = {}",
                                                   grouped(mine.step), name, gap));
  verdict.other = who, verdict.facet = mine.event.facet;
  add_gap_along_ray(q, verdict, mine.event.t, other->event.t);
  q.add_formulas(verdict, mine.step);
  add_hit(q, verdict, mine);
  add_hit(q, verdict, *other);
  return verdict;
}

/// Boxes and cells are made before the first ray.
std::int64_t first_ray(const Asked& q) {
  return next_of<RayBegin>(q.trace, 0, q.trace.size() + 1).value_or(q.trace.size() + 1);
}

/// The boxes around a facet, the innermost first.
std::vector<std::int32_t> boxes_around(const Asked& q, std::int32_t facet, std::int64_t rays) {
  std::vector<std::int32_t> boxes;
  const auto hold = next_within(q.trace, 0, rays, [facet](const RecordedEvent& recorded) {
    const auto* held = get_if<BoxHold>(&recorded.event);
    return held && held->facet == facet;
  });
  std::int32_t box = hold ? event_at<BoxHold>(q.trace, *hold)->box : -1;
  while (box >= 0 && boxes.size() < 128) {
    boxes.push_back(box);
    const auto made = numbered(q.trace, 0, rays, &BoxMake::box, box);
    box = made ? event_at<BoxMake>(q.trace, *made)->parent : -1;
  }
  return boxes;
}

std::vector<CellHold> cells_around(const Asked& q, std::int32_t facet, std::int64_t rays) {
  const auto of_it = [facet](const RecordedEvent& recorded) {
    const auto* held = get_if<CellHold>(&recorded.event);
    return held && held->facet == facet;
  };
  std::vector<CellHold> cells;
  if (const auto first = next_within(q.trace, 0, rays, of_it))  // those of one facet stand side by side
    for (std::int64_t step = *first; step < rays && of_it(q.trace.event(step)); ++step)
      cells.push_back(*event_at<CellHold>(q.trace, step));
  return cells;
}

/// What kept a facet that was never tested from the ray.
struct Barrier {
  std::int64_t step = 0;
  bool missed = false;  ///< the ray does not go through there at all; else something nearer was known
  double t = 0;         ///< where the ray would have entered
  std::string what;
};
std::optional<Barrier> barrier_before(const Asked& q, const Ray& ray, std::int32_t facet) {
  if (ray.boxes.empty() && ray.cells.empty()) return std::nullopt;
  const std::int64_t rays = first_ray(q);
  const std::vector<std::int32_t> around = boxes_around(q, facet, rays);
  std::optional<Barrier> barrier;
  for (auto box = around.rbegin(); box != around.rend(); ++box)  // from the outermost
    for (const At<BoxTest>& test : ray.boxes) {
      if (test.event.box != *box) continue;
      barrier = Barrier{test.step, !(test.event.t_enter <= test.event.t_leave), test.event.t_enter,
                        fmt::format("box {}", *box)};
      if (!test.event.hit) return barrier;
    }
  if (barrier) return barrier;  // it was met, and another was found before its inside was looked at
  const std::vector<CellHold> cells = cells_around(q, facet, rays);
  if (cells.empty() || ray.cells.empty()) return std::nullopt;
  const At<CellVisit>& last = ray.cells.back();
  return Barrier{last.step, ray.kept.empty(), last.event.t_leave,
                 fmt::format("each of the {} cell{} that hold{} it", cells.size(), cells.size() == 1 ? "" : "s",
                             cells.size() == 1 ? "s" : "")};
}

Verdict why_unreached(Asked& q, const Ray& ray, const Barrier& barrier, std::int32_t facet) {
  if (ray.kept.empty()) return not_recorded(q);
  const At<RayHit>& other = ray.kept.back();
  const std::int32_t who = polygon_of_facet(q.scene, other.event.facet);
  Verdict verdict =
      q.verdict(Why::unreached, barrier.step,
                fmt::format("the ray met {} at t = {} and would enter {} only beyond that, so it was never tested",
                            q.label(who), told(other.event.t), barrier.what));
  verdict.other = who, verdict.facet = facet;
  verdict.formulas.push_back(
      fmt::format("t kept = {}, t where {} begins \u2265 {}", told(other.event.t), barrier.what, told(barrier.t)));
  q.add_formulas(verdict, barrier.step);
  verdict.chain.push_back({barrier.step, q.polygon,
                           barrier.what.starts_with("box")
                               ? fmt::format("the ray is held against {}, which holds {}", barrier.what, q.name)
                               : "the last cell that the ray enters"});
  add_hit(q, verdict, other);
  return verdict;
}

/// Beside the pixel, turned away, or cut off: what of it the ray recorded.
void tell_ray(Asked& q, Verdict& verdict, const Ray& ray) {
  const auto of_facet = [&](const auto& all) {
    for (const auto& one : all)
      if (one.event.facet == verdict.facet) return &one;
    return static_cast<decltype(&all[0])>(nullptr);
  };
  const At<RayPlane>* plane = ray.planes.empty() ? nullptr : of_facet(ray.planes);
  const At<RayHit>* hit = ray.hits.empty() ? nullptr : of_facet(ray.hits);
  if (plane) {
    verdict.chain.push_back(
        {plane->step, q.polygon, fmt::format("the ray and the plane of {}: t = {}", q.name, number(plane->event.t))});
    if (verdict.kind != Why::not_covered || !hit) verdict.step = plane->step;
    q.add_formulas(verdict, plane->step);
    if (verdict.kind == Why::culled)
      verdict.formulas.push_back(
          fmt::format("A dX + B dY + C dZ = {} > 0: (A, B, C), which is n made 1 long, points the way the ray goes",
                      number(plane->event.denominator)));
  }
  if (hit && verdict.kind == Why::not_covered) {
    verdict.step = hit->step;
    q.add_formulas(verdict, hit->step);
    verdict.chain.push_back({hit->step, q.polygon, fmt::format("the point on the plane lies outside {}", q.name)});
  }
  if (plane || verdict.kind != Why::not_covered) return;
  const auto barrier = barrier_before(q, ray, verdict.facet);
  if (!barrier) return;
  if (barrier->missed) verdict.kind = Why::box_missed;
  verdict.step = barrier->step;
  verdict.sentence += barrier->missed
                          ? fmt::format(" The ray misses {}, so it was never tested.", barrier->what)
                          : fmt::format(" It was not tested, as something nearer was met before {}.", barrier->what);
  q.add_formulas(verdict, barrier->step);
  verdict.chain.push_back({barrier->step, q.polygon,
                           barrier->what.starts_with("box")
                               ? fmt::format("the ray is held against {}, which holds {}", barrier->what, q.name)
                               : "the last cell that the ray enters"});
}

/// Its hit is the one that the ray kept.
Verdict why_kept(Asked& q, const Ray& ray, const Visit* painted) {
  const At<RayHit>& hit = ray.kept.back();
  const At<RayHit>* nearer = nullptr;
  for (const At<RayHit>& other : ray.passed)
    if (q.trace.header().comparison.behind(other.event.t, hit.event.t) < 0) nearer = &other;
  const std::string how =
      nearer ? fmt::format("the trace keeps it at t = {}, though the ray meets {} at t = {}", told(hit.event.t),
                           q.label(polygon_of_facet(q.scene, nearer->event.facet)), told(nearer->event.t))
             : fmt::format("the ray meets it first, at t = {}", told(hit.event.t));
  // A recording may end before it is painted.
  Verdict verdict =
      seen(q, painted ? painted->written : hit.step, how, painted ? fmt::format("the pixel becomes {}", q.name) : "");
  if (!painted) verdict.chain.clear();
  verdict.facet = hit.event.facet;
  q.add_formulas(verdict, hit.step);
  add_hit(q, verdict, hit);
  if (nearer) add_hit(q, verdict, *nearer);
  return verdict;
}

/// The ray kept one and the pixel was given to another; it is one of the two.
Verdict why_painted_otherwise(Asked& q, const Ray& ray, const Visit& painted, std::int32_t kept) {
  const std::string step = "step " + grouped(painted.written), other = q.label(painted.shows);
  const std::string meets =
      kept == no_polygon
          ? "meets nothing"
          : fmt::format("keeps {} at t = {}", kept == q.polygon ? "it" : q.label(kept), told(ray.kept.back().event.t));
  Verdict verdict;
  if (painted.shows == q.polygon) {
    verdict = seen(q, painted.written, fmt::format("{} paints it there, though the ray {}", step, meets),
                   fmt::format("the pixel becomes {}", q.name));
  } else {
    verdict = q.verdict(Why::contradicted, painted.written,
                        fmt::format("the ray {}, but {} paints {} there", meets, step, other));
    verdict.other = painted.shows;
    verdict.chain.push_back({painted.written, painted.shows, fmt::format("the pixel becomes {}", other)});
  }
  if (kept != no_polygon) add_hit(q, verdict, ray.kept.back());
  return verdict;
}

}  // namespace

bool of_rays(const Trace& trace) { return trace.has(kind_of<RayBegin>); }

Verdict why_by_rays(Asked& q, const std::vector<FacetThere>& facets) {
  const auto ray = follow(q);
  if (!ray) {
    const auto verdict = why_by_facets(q, facets);
    return verdict ? *verdict : not_recorded(q);
  }
  // What is painted after the ray is what is seen; mostly that is what it kept.
  const std::vector<Visit> visits = visits_of(q.trace, q.pixel);
  const Visit* painted = holder(visits, q.trace.size() + 1);
  const std::int32_t kept = ray->kept.empty() ? no_polygon : polygon_of_facet(q.scene, ray->kept.back().event.facet);
  if (painted && painted->shows != kept && (painted->shows == q.polygon || kept == q.polygon))
    return why_painted_otherwise(q, *ray, *painted, kept);
  if (kept == q.polygon) return why_kept(q, *ray, painted);
  const At<RayHit>* mine = nullptr;
  for (const At<RayHit>& hit : ray->hits)
    if (hit.event.inside && (!mine || hit.event.t < mine->event.t)) mine = &hit;
  if (mine) return why_behind(q, *ray, *mine);

  auto verdict = why_by_facets(q, facets);
  if (verdict) {
    tell_ray(q, *verdict, *ray);
    if (!ray->kept.empty())
      verdict->other = polygon_of_facet(q.scene, ray->kept.back().event.facet), add_hit(q, *verdict, ray->kept.back());
    return *verdict;
  }
  for (const FacetThere& there : facets)
    if (there.covers() && !there.rejected())
      if (const auto barrier = barrier_before(q, *ray, there.facet))
        return why_unreached(q, *ray, *barrier, there.facet);
  return not_recorded(q);
}

}  // namespace zstep::answers
