// Rays: was the polygon's plane tested along the pixel's ray, was the point inside, was it the nearest; and if it was
// never tested, which box or cell kept it from the ray.
#include <algorithm>
#include <cmath>

#include "sim/answers/why_not_parts.hpp"

namespace zstep::answers {
namespace {

/// What the eye's ray through the pixel did.
struct Ray {
  std::vector<Found<RayPlane>> planes;  ///< of the polygon's facets
  std::vector<Found<RayHit>> hits;      ///< of the polygon's facets
  std::vector<Found<RayHit>> kept;      ///< whose ever, each nearer than all before
  std::vector<Found<RayHit>> passed;    ///< whose ever, inside and not kept
  std::vector<Found<BoxTest>> boxes;
  std::vector<Found<CellVisit>> cells;

  std::int32_t last_facet() const { return kept.empty() ? -1 : kept.back().event.facet; }
};

std::optional<Ray> follow(const Asked& q) {
  const auto begin = q.trace.next<RayBegin>(
      0, [](const RayBegin& ray) { return ray.role == RayRole::eye; }, q.pixel);
  if (!begin) return std::nullopt;
  Ray ray;
  q.trace.each(*begin, q.trace.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
    const auto is_own = [&](std::int32_t facet) { return polygon_of_facet(q.scene, facet) == q.polygon; };
    const auto add = [&]<class E>(const E& event, std::vector<Found<E>>& to) { to.push_back({step, event}); };
    if (const auto* plane = get_if<RayPlane>(&recorded.event); plane && is_own(plane->facet)) add(*plane, ray.planes);
    if (const auto* box = get_if<BoxTest>(&recorded.event)) add(*box, ray.boxes);
    if (const auto* cell = get_if<CellVisit>(&recorded.event)) add(*cell, ray.cells);
    if (const auto* hit = get_if<RayHit>(&recorded.event)) {
      if (hit->nearest || hit->inside) add(*hit, hit->nearest ? ray.kept : ray.passed);
      if (is_own(hit->facet)) add(*hit, ray.hits);
    }
    return !is_one_of<RayEnd, RayBegin>(recorded);
  });
  return ray;
}

void add_hit(const Asked& q, Verdict& verdict, const Found<RayHit>& hit) {
  const std::int32_t polygon = polygon_of_facet(q.scene, hit.event.facet);
  verdict.add_step(hit.step, polygon, "the ray meets {} at t = {}{}", q.label(polygon), told(hit.event.t),
                   hit.event.nearest ? ", the nearest so far" : "");
}

/// It was met inside its outline, and another is nearer.
Verdict why_behind(Asked& q, const Ray& ray, const Found<RayHit>& mine) {
  const Found<RayHit>* other = nullptr;  // the next that was kept after it, or the last before it
  for (const Found<RayHit>& hit : ray.kept)
    if (mine.event.nearest ? !other && hit.step > mine.step : hit.step < mine.step) other = &hit;
  if (!other) return not_recorded(q);
  const std::int32_t who = polygon_of_facet(q.scene, other->event.facet);
  const double t = mine.event.t, its = other->event.t, behind = q.trace.header().comparison.behind(t, its);
  const std::string gap = told(t - its), name = q.label(who);
  const std::int64_t both_met = std::max(mine.step, other->step);
  Verdict verdict =
      t == its ? q.verdict(Why::tie, both_met, "the ray meets it at exactly the same t as {}, which {}", name,
                           kept_in_tie(q.trace.header(), other->event.facet < mine.event.facet, "is kept"))
      : behind < 0  // and yet the other is kept
          ? q.verdict(Why::contradicted, both_met,
                      "the ray meets it at step {} at t = {}, nearer than {} at t = {}, but the trace keeps {}",
                      grouped(mine.step), told(t), name, told(its), name)
          : mine.event.nearest
                ? q.verdict(Why::overwritten, other->step,
                            "it was the nearest on the ray from step {} on, until {} was met at step {}, nearer by "
                            "\u0394t = {}",
                            grouped(mine.step), name, grouped(other->step), gap)
                : q.verdict(Why::lost, mine.step, "the ray meets it at step {}, but {} is nearer by \u0394t = {}",
                            grouped(mine.step), name, gap);
  verdict.other = who, verdict.facet = mine.event.facet, verdict.gap = behind;
  verdict.add_formula("{}", difference("t", q.name, name, t, its));
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
  const auto hold = next_that<BoxHold>(q.trace, 0, rays, [&](const BoxHold& held) { return held.facet == facet; });
  std::int32_t box = hold ? hold->event.box : -1;
  while (box >= 0 && boxes.size() < 128) {
    boxes.push_back(box);
    const auto made = numbered(q.trace, 0, rays, &BoxMake::box, box);
    box = made ? event_at<BoxMake>(q.trace, *made)->parent : -1;
  }
  return boxes;
}

/// How many cells hold a facet. The run lists them one after another.
std::size_t cells_around(const Asked& q, std::int32_t facet, std::int64_t rays) {
  const auto of_it = [&](const CellHold& held) { return held.facet == facet; };
  const auto first = next_that<CellHold>(q.trace, 0, rays, of_it);
  std::size_t cells = 0;
  for (std::int64_t step = first ? first->step : rays; step < rays; ++step, ++cells)
    if (const auto held = event_at<CellHold>(q.trace, step); !held || !of_it(*held)) break;
  return cells;
}

/// What kept a facet that was never tested from the ray.
struct Barrier {
  std::int64_t step = 0;
  bool missed = false;    ///< the ray does not go through there at all; else something nearer was known
  double t = 0;           ///< where the ray would have entered
  std::string what, did;  ///< and the ray there
};
std::optional<Barrier> barrier_before(const Asked& q, const Ray& ray, std::int32_t facet) {
  if (ray.boxes.empty() && ray.cells.empty()) return std::nullopt;
  const std::int64_t rays = first_ray(q);
  const std::vector<std::int32_t> around = boxes_around(q, facet, rays);
  std::optional<Barrier> barrier;
  for (auto box = around.rbegin(); box != around.rend(); ++box)  // from the outermost
    for (const Found<BoxTest>& test : ray.boxes) {
      if (test.event.box != *box) continue;
      barrier = Barrier{test.step, !(test.event.t_enter <= test.event.t_leave), test.event.t_enter,
                        fmt::format("box {}", *box),
                        fmt::format("the ray is held against box {}, which holds {}", *box, q.name)};
      if (!test.event.hit) return barrier;
    }
  if (barrier) return barrier;  // it was met, and another was found before its inside was looked at
  const std::size_t cells = cells_around(q, facet, rays);
  if (cells == 0 || ray.cells.empty()) return std::nullopt;
  const Found<CellVisit>& last = ray.cells.back();
  return Barrier{
      last.step, ray.kept.empty(), last.event.t_leave,
      cells == 1 ? "each of the 1 cell that holds it" : fmt::format("each of the {} cells that hold it", cells),
      "the last cell that the ray enters"};
}

Verdict why_unreached(Asked& q, const Ray& ray, const Barrier& barrier, std::int32_t facet) {
  if (ray.kept.empty()) return not_recorded(q);
  const Found<RayHit>& other = ray.kept.back();
  const std::int32_t who = polygon_of_facet(q.scene, other.event.facet);
  Verdict verdict = q.verdict(Why::unreached, barrier.step,
                              "the ray met {} at t = {} and would enter {} only beyond that, so it was never tested",
                              q.label(who), told(other.event.t), barrier.what);
  verdict.other = who, verdict.facet = facet;
  verdict.add_formula("t kept = {}, t where {} begins \u2265 {}", told(other.event.t), barrier.what, told(barrier.t));
  q.add_formulas(verdict, barrier.step);
  verdict.add_step(barrier.step, q.polygon, "{}", barrier.did);
  add_hit(q, verdict, other);
  return verdict;
}

template <class E>
const Found<E>* of_facet(const std::vector<Found<E>>& all, std::int32_t facet) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.event.facet == facet; });
  return found != all.end() ? &*found : nullptr;
}

/// Beside the pixel, turned away, or cut off: what of it the ray recorded.
void tell_ray(Asked& q, Verdict& verdict, const Ray& ray) {
  const auto* plane = of_facet(ray.planes, verdict.facet);
  const auto* hit = of_facet(ray.hits, verdict.facet);
  if (plane) {
    verdict.add_step(plane->step, q.polygon, "the ray and the plane of {}: t = {}", q.name, number(plane->event.t));
    if (verdict.kind != Why::not_covered || !hit) verdict.step = plane->step;
    q.add_formulas(verdict, plane->step);
    if (verdict.kind == Why::culled)
      verdict.add_formula("A dX + B dY + C dZ = {} > 0: (A, B, C), which is n made 1 long, points the way the ray goes",
                          number(plane->event.denominator));
  }
  if (hit && verdict.kind == Why::not_covered) {
    verdict.step = hit->step;
    q.add_formulas(verdict, hit->step);
    verdict.add_step(hit->step, q.polygon, "the point on the plane lies outside {}", q.name);
  }
  if (plane || verdict.kind != Why::not_covered) return;
  const auto barrier = barrier_before(q, ray, verdict.facet);
  if (!barrier) return;
  verdict.step = barrier->step;
  if (barrier->missed) verdict.kind = Why::box_missed;
  if (barrier->missed) verdict.say(" The ray misses {}, so it was never tested.", barrier->what);
  else verdict.say(" It was not tested, as something nearer was met before {}.", barrier->what);
  q.add_formulas(verdict, barrier->step);
  verdict.add_step(barrier->step, q.polygon, "{}", barrier->did);
}

/// Its hit is the one that the ray kept.
Verdict why_kept(Asked& q, const Ray& ray, const Visit* painted) {
  const Found<RayHit>& hit = ray.kept.back();
  const Found<RayHit>* nearer = nullptr;
  for (const Found<RayHit>& other : ray.passed)
    if (q.trace.header().comparison.behind(other.event.t, hit.event.t) < 0) nearer = &other;
  const std::string how =
      nearer ? fmt::format("the trace keeps it at t = {}, though the ray meets {} at t = {}", told(hit.event.t),
                           q.label(polygon_of_facet(q.scene, nearer->event.facet)), told(nearer->event.t))
             : fmt::format("the ray meets it first, at t = {}", told(hit.event.t));
  // A recording may end before it is painted.
  Verdict verdict = seen(q, painted ? painted->written : hit.step, how);
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
    verdict = seen(q, painted.written, fmt::format("{} paints it there, though the ray {}", step, meets));
  } else {
    verdict = q.verdict(Why::contradicted, painted.written, "the ray {}, but {} paints {} there", meets, step, other);
    verdict.other = painted.shows;
    verdict.add_step(painted.written, painted.shows, "the pixel becomes {}", other);
  }
  if (kept != no_polygon) add_hit(q, verdict, ray.kept.back());
  return verdict;
}

}  // namespace

bool of_rays(const Trace& trace) { return trace.has(kind_of<RayBegin>); }

Verdict why_by_rays(Asked& q, const std::vector<FacetThere>& facets) {
  const auto ray = follow(q);
  if (!ray) return why_by_facets(q, facets).value_or(not_recorded(q));
  // What is painted after the ray is what is seen; mostly that is what it kept.
  const std::vector<Visit> visits = visits_of(q.trace, q.pixel);
  const Visit* painted = holder(visits, q.trace.size() + 1);
  const std::int32_t kept = polygon_of_facet(q.scene, ray->last_facet());
  if (painted && painted->shows != kept && (painted->shows == q.polygon || kept == q.polygon))
    return why_painted_otherwise(q, *ray, *painted, kept);
  if (kept == q.polygon) return why_kept(q, *ray, painted);
  const Found<RayHit>* mine = nullptr;
  for (const Found<RayHit>& hit : ray->hits)
    if (hit.event.inside && (!mine || hit.event.t < mine->event.t)) mine = &hit;
  if (mine) return why_behind(q, *ray, *mine);

  if (auto verdict = why_by_facets(q, facets)) {
    tell_ray(q, *verdict, *ray);
    if (!ray->kept.empty()) verdict->other = kept, add_hit(q, *verdict, ray->kept.back());
    return *verdict;
  }
  for (const FacetThere& there : facets)
    if (there.covers() && !there.rejected())
      if (const auto barrier = barrier_before(q, *ray, there.facet))
        return why_unreached(q, *ray, *barrier, there.facet);
  return not_recorded(q);
}

}  // namespace zstep::answers
