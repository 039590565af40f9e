// A polygon before it reaches the raster: culled, edge-on, out of view, cut off, or simply beside the pixel.
#include <algorithm>

#include "algorithms/viewing/back_face.hpp"
#include "sim/answers/seen_point.hpp"
#include "sim/answers/why_not_parts.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/fill.hpp"
#include "traces/formulas/rounding.hpp"
#include "sim/words/rejects.hpp"

namespace zstep::answers {
namespace {

std::span<const std::int32_t> corners_of(const Scene& scene, std::int32_t facet) {
  const Facet& shape = scene.facets[facet];
  return std::span(scene.corners).subspan(shape.first_corner, shape.corner_count);
}

bool in_space(const Scene& scene) { return scene.camera.kind != Camera::Kind::screen; }

/// Where it was rejected after its mark.
void find_rejected(const Trace& trace, FacetThere& there) {
  const auto stop = trace.next(there.mark, [](const RecordedEvent& recorded) {
    return is_one_of<PolygonReject, PolygonBegin, PieceMake, EdgeTableInsert, EdgeTableSkip, ScanLineBegin>(recorded) ||
           description_of_kind(recorded.event.index()).after_polygons;
  });
  const auto reject = stop ? event_at<PolygonReject>(trace, *stop) : std::nullopt;
  if (reject) there.reject_step = *stop, there.reason = reject->reason;
}

/// Methods that reject a polygon when they come to it in a tree, after other marks, or without any (rays).
void find_rejected_elsewhere(Asked& q, std::vector<FacetThere>& facets) {
  const bool rays = records<RayBegin>(q.trace), tree = records<EyeSide>(q.trace);
  for (FacetThere& there : facets) {
    if (there.rejected()) continue;
    const auto corners = corners_of(q.scene, there.facet);
    const bool nothing = clipping::degenerate(q.scene, corners);
    if (!(rays && nothing) && !(tree && there.away)) continue;
    // The pieces of a tree are drawn, or not, in the tree's order: others may be drawn before.
    const std::int64_t from = rays ? last_mark(q.trace) : there.mark, all = q.trace.size() + 1;
    const std::int64_t end = rays ? next_of<RayBegin>(q.trace, from, all).value_or(all) : all;
    const auto rejects = q.trace.rejects();
    const auto reject = std::find_if(rejects.begin(), rejects.end(), [&](const RejectMark& mark) {
      return mark.polygon == q.polygon && mark.position > from && mark.position < end &&
             (rays || mark.reason == Reject::back_facing);
    });
    if (reject != rejects.end()) there.reject_step = reject->position, there.reason = reject->reason;
  }
}

std::string point(const glm::dvec3& p) { return fmt::format("({}, {}, {})", number(p.x), number(p.y), number(p.z)); }

/// The facing test that was recorded for it, 0 if none was.
std::int64_t facing_test_of(const Trace& trace, const FacetThere& there) {
  if (there.mark == 0) return 0;
  const std::int64_t end = there.rejected() ? there.reject_step : next_mark(trace, there.mark);
  return next_of<FacingTest>(trace, there.mark, end).value_or(0);
}

/// Why it counts as facing away, where it does.
void add_facing(Asked& q, Verdict& verdict, const FacetThere& there) {
  const auto corners = corners_of(q.scene, there.facet);
  const bool parallel = q.scene.camera.kind == Camera::Kind::orthographic;
  const glm::dvec3 p = q.scene.points[corners[0]], e = q.scene.camera.eye;
  const glm::dvec3 n = clipping::newell_normal(q.scene, corners);
  const double value = clipping::view_dot_normal(q.scene, corners);
  if (!(value > 0)) return;
  verdict.add_formula("{}\u00b7n = {}\u00b7{} = {} > 0: it faces away", parallel ? "(line of sight)" : "(p \u2212 e)",
                      point(parallel ? -e : p - e), point(n), number(value));
  if (!parallel)
    verdict.add_formula("p = {} its first corner, e = {} the eye, n = {} its normal", point(p), point(e), point(n));
  if (const std::int64_t test = facing_test_of(q.trace, there))
    verdict.add_step(test, q.polygon, "facing test: {} faces away", q.name);
}

/// What is said of what was dropped for a reason.
struct Dropped {
  Why kind;
  const char *as, *because;
};
constexpr ByEnum<Reject, Dropped, 4> dropped{
    Dropped{Why::culled, "facing away", "it faces away and was dropped"},
    Dropped{Why::edge_on, "seen edge-on", "it is seen edge-on and covers no area"},
    Dropped{Why::outside, "outside the view volume", "nothing of it lies in the view volume"},
    Dropped{Why::degenerate, "having no area", "it has no area, or coordinates that no raster can hold"}};

/// What speaks against the reason for which it was dropped.
RejectCheck check_of(const Asked& q, const FacetThere& there) {
  const std::int64_t step = facing_test_of(q.trace, there);
  const auto test = event_at<FacingTest>(q.trace, step);
  RejectCheck check = check_reject(q.scene, there.facet, there.reason, test ? &*test : nullptr);
  if (there.reason != Reject::back_facing && there.surely)
    check = {false, true,
             fmt::format("it covers the {} of pixel ({}, {})", seen_point(q.scene.raster), there.surely->x,
                         there.surely->y)};
  return check;
}

void add_beginning(const Asked& q, Verdict& verdict, const FacetThere& there) {
  verdict.add_step(there.mark, q.polygon, "work on {} begins", q.name);
}
void add_drop(const Asked& q, Verdict& verdict, const FacetThere& there) {
  verdict.add_step(there.reject_step, q.polygon, "{} is dropped", q.name);
}

/// Facing away, whether a step says so or not: a ray's plane test alone, a tree's side that is skipped, a recording
/// that ends before.
bool culled(const FacetThere& there) { return there.rejected() ? there.reason == Reject::back_facing : there.away; }

/// Facing away, and no step drops it.
const char* away_text(const Asked& q) {
  return records<RayBegin>(q.trace) ? "it faces away, and such are not met by rays from the eye"
                                    : "it faces away, and such are not drawn";
}

/// It was dropped for a reason that the scene or the trace's own numbers contradict, or that cannot be checked.
Verdict of_doubtful_reject(Asked& q, const FacetThere& there, const RejectCheck& check) {
  Verdict verdict =
      q.verdict(check.holds ? dropped[there.reason].kind : Why::contradicted, there.reject_step,
                "the trace drops it as {}{} {}", dropped[there.reason].as, check.holds ? ";" : ", but", check.text);
  add_beginning(q, verdict, there);
  if (const std::int64_t test = facing_test_of(q.trace, there)) {
    q.add_formulas(verdict, test);
    verdict.add_step(test, q.polygon, "facing test of {}", q.name);
  }
  add_drop(q, verdict, there);
  return verdict;
}

Verdict of_rejected(Asked& q, const FacetThere& there) {
  if (there.rejected())
    if (const RejectCheck check = check_of(q, there); !check.holds || !check.shown)
      return of_doubtful_reject(q, there, check);
  const Reject reason = culled(there) ? Reject::back_facing : there.reason;
  Verdict verdict =
      q.verdict(dropped[reason].kind, there.reject_step, there.rejected() ? dropped[reason].because : away_text(q));
  add_beginning(q, verdict, there);
  if (reason == Reject::back_facing) add_facing(q, verdict, there);
  if (reason == Reject::outside && there.mark > 0)
    if (const auto test = next_of<ClipTest>(q.trace, there.mark, there.reject_step)) {
      verdict.add_step(*test, q.polygon, "outcodes of its vertices");
      q.add_formulas(verdict, *test);
    }
  add_drop(q, verdict, there);
  return verdict;
}

/// Its part at the pixel lies before the near plane or beyond the far one.
Verdict of_cut(Asked& q, const FacetThere& there) {
  const Camera& camera = q.scene.camera;
  const double z = *there.cut_at;
  const bool before = z < camera.near, behind_eye = z <= 0 && camera.kind == Camera::Kind::perspective;
  const std::string reason = behind_eye ? "what would cover the pixel lies behind the eye and was cut off"
                             : before   ? "what would cover the pixel lies before the near plane and was cut off"
                                        : "what would cover the pixel lies beyond the far plane and was cut off";
  Verdict verdict = q.verdict(Why::clipped, 0, reason);
  add_beginning(q, verdict, there);
  verdict.add_formula("on the line of sight it is at z_v = {}; near = {}, far = {}", number(z), number(camera.near),
                      number(camera.far));
  if (there.mark == 0) return verdict;
  const auto is_cut = [&](const ClipVertex& e) { return !e.inside && (e.plane == ClipPlane::near) == before; };
  if (const auto cut = next_before<ClipVertex, EdgeTableInsert, PieceMake, PolygonReject>(
          q.trace, there.mark, next_mark(q.trace, there.mark), is_cut)) {
    verdict.step = cut->step;
    verdict.add_step(cut->step, q.polygon, "a vertex of {} lies outside the {} plane", q.name, before ? "near" : "far");
    q.add_formulas(verdict, cut->step);
  } else {
    verdict.step = there.reject_step;
    add_drop(q, verdict, there);
  }
  return verdict;
}

/// The nearer to being seen the higher.
int rank(const FacetThere& there) {
  if (there.covers() && !there.rejected() && !there.away) return 5;
  if (there.covers() && culled(there)) return 4;
  if (there.cut_at) return 3;
  if (there.at && (!there.rejected() || culled(there))) return 2;
  return 1;
}

}  // namespace

std::vector<FacetThere> facets_there(Asked& q) {
  std::vector<FacetThere> facets;
  const bool non_zero = formulas::fills_non_zero(q.trace.header().conventions);
  for (const std::int32_t facet : q.facets()) {
    FacetThere there;
    there.facet = facet;
    const auto corners = corners_of(q.scene, facet);
    there.away = in_space(q.scene) && q.trace.header().conventions.cull && !clipping::degenerate(q.scene, corners) &&
                 clipping::view_dot_normal(q.scene, corners) > 0;
    there.at = compare::facet_at(q.scene, facet, false, q.pixel.x, q.pixel.y, non_zero);
    if (there.covers() && there.at->candidate.sure()) there.surely = q.pixel;
    if (in_space(q.scene) && !there.covers())
      if (const auto z = compare::depth_on_sight(q.scene, facet, q.pixel.x, q.pixel.y, non_zero);
          z && (*z < q.scene.camera.near || *z > q.scene.camera.far))
        there.cut_at = z;
    facets.push_back(there);
  }
  for (const std::int64_t mark : marks_of(q.trace, q.polygon)) {
    const auto begin = event_at<PolygonBegin>(q.trace, mark);
    for (FacetThere& there : facets) {
      if (!begin || begin->facet != there.facet) continue;
      there.mark = mark;
      find_rejected(q.trace, there);
    }
  }
  find_rejected_elsewhere(q, facets);
  return facets;
}

bool never_begun(const Asked& q, const FacetThere& there) {
  // Where all pieces are made before any is drawn, a mark is of drawing, and what is hidden may have none.
  const bool by_pieces =
      q.trace.has(kind_of<PieceMake>) || q.trace.has(kind_of<TablesBegin>) || q.trace.has(kind_of<RayBegin>);
  return there.mark == 0 && !there.rejected() && !there.away && !q.trace.polygons().empty() && !by_pieces;
}

std::string beside_text(const Asked& q, const FacetThere& there) {
  if (!there.at) return fmt::format("no part of it is in view {}", q.where);
  const std::string far = number(there.at->candidate.edge);
  const bool fixed = bits_of(q.trace.header().conventions.number_format) > 0;
  const double rounding =
      fixed ? 2 / fixed_positions_a_pixel
            : formulas::rounding_of(q.trace.header()) * std::max(q.scene.raster.width, q.scene.raster.height);
  const bool on_it = there.at->candidate.edge <= rounding;
  const Header& header = q.trace.header();
  // Does a centre on an outline belong to the polygon on one side of it only?
  const bool declared = header.declares(Convention::coverage),
             half_open = declared && header.conventions.coverage == Conventions::Coverage::top_left;
  if (on_it && half_open)
    return fmt::format(
        "the pixel's {0} lies on a right or last edge of it, and by the half-open rule such a {0} is outside",
        seen_point(q.scene.raster));
  if (on_it && !declared)
    return fmt::format(
        "the pixel's {0} lies on its outline or within rounding of it, and the header does not declare "
        "which such {0}s are covered",
        seen_point(q.scene.raster));
  if (on_it || there.covers())
    return fmt::format("the pixel's {} lies so near its outline that rounding decides, and it came to lie outside",
                       seen_point(q.scene.raster));
  if (there.at->in_square)
    return fmt::format("it covers the pixel only in part: the {} lies {} pixels outside its outline",
                       seen_point(q.scene.raster), far);
  return fmt::format("it does not cover the pixel's {}, which lies {} pixels outside its outline",
                     seen_point(q.scene.raster), far);
}

namespace {

/// It does not cover the pixel's centre: by the steps of its triangles, where it has such, else by its outline.
Verdict not_covered(Asked& q, const FacetThere& there) {
  const auto left_out = left_out_by_triangles(q, there.mark);
  Verdict verdict = q.verdict(Why::not_covered, left_out ? left_out->step : there.mark,
                              left_out ? left_out->text : beside_text(q, there));
  add_beginning(q, verdict, there);
  if (left_out) {
    q.add_formulas(verdict, left_out->step);
    verdict.chain.push_back({left_out->step, q.polygon, fmt::format("the pixel is found to lie outside {}", q.name)});
  }
  return verdict;
}

}  // namespace

std::optional<Verdict> why_by_facets(Asked& q, const std::vector<FacetThere>& facets) {
  if (facets.empty())
    return q.verdict(Why::degenerate, 0, "it has fewer than three different corners, so there is no facet to draw");
  const auto best = std::min_element(facets.begin(), facets.end(), [](const FacetThere& one, const FacetThere& other) {
    if (rank(one) != rank(other)) return rank(one) > rank(other);
    return one.at && other.at && one.at->candidate.edge < other.at->candidate.edge;
  });
  if (rank(*best) == 5) {
    if (never_begun(q, *best)) return not_begun(q);
    // On its outline rounding decides, and the method's own arithmetic has.
    if (best->at->candidate.sure()) return std::nullopt;
    Verdict verdict = not_covered(q, *best);
    verdict.facet = best->facet;
    return verdict;
  }
  Verdict verdict;
  if (best->cut_at) {
    verdict = of_cut(q, *best);
  } else if (best->covers() || (best->rejected() && !culled(*best))) {
    verdict = of_rejected(q, *best);
  } else {
    verdict = not_covered(q, *best);
    if (best->at)
      verdict.add_formula("from ({}, {}) to its nearest edge: {} pixels", q.pixel.x, q.pixel.y,
                          number(best->at->candidate.edge));
    if (culled(*best)) {
      const RejectCheck check = best->rejected() ? check_of(q, *best) : RejectCheck{};
      verdict.sentence += check.holds && check.shown ? " Besides, it faces away and is not drawn."
                                                     : " Besides, the trace drops it as facing away.";
      if (!check.text.empty()) verdict.say(" ({})", check.text);
    }
    add_drop(q, verdict, *best);
  }
  verdict.facet = best->facet;
  return verdict;
}

}  // namespace zstep::answers
