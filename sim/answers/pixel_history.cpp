#include "sim/answers/pixel_history.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <variant>

#include <fmt/format.h>

#include "sim/answers/why_not_parts.hpp"
#include "sim/truth/sight.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/rejects.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/fill.hpp"
#include "traces/scene.hpp"

namespace zstep::answers {

namespace {

/// Does the trace say of a compare what its two depths do not?
bool contradicts(const Trace& trace, const Visit& visit) {
  return visit.compared() && visit.z && visit.stored &&
         is_nearer(trace, *visit.z, *visit.stored) != (visit.outcome == Outcome::won);
}

class History {
 public:
  History(const Trace& trace, const FacetsNear& facets, Trace::Pixel pixel)
      : trace_(trace), facets_(facets), pixel_(pixel) {}

  std::vector<Visit> all() {
    if (records<RayBegin>(trace_)) add_hits();
    for (Visit& visit : visits_of(trace_, pixel_, 0)) add(std::move(visit));
    find_there();
    add_behind();
    add_rejected();
    add_cut_off();
    std::stable_sort(visits_.begin(), visits_.end(), [](const Visit& a, const Visit& b) { return a.step < b.step; });
    find_who_came_over();
    return std::move(visits_);
  }

 private:
  Visit& add(std::int64_t step, std::int32_t polygon, Outcome outcome) {
    Visit visit;
    visit.step = step, visit.polygon = polygon, visit.outcome = outcome;
    visits_.push_back(std::move(visit));
    return visits_.back();
  }
  void add(Visit&& visit) {
    // The hit that the ray kept is a visit already; only a paint that contradicts it is another one.
    const bool colours = visit.outcome == Outcome::mixed || visit.outcome == Outcome::colored;
    if (keeper_ && !colours && visit.shows == *keeper_) return;
    visit.remark = remark(visit);
    // What was mixed in after a compare stands apart from it.
    const bool compared_first = visit.outcome == Outcome::mixed && visit.step != visit.blended;
    if (compared_first) visit.outcome = Outcome::won;
    visits_.push_back(visit);
    if (compared_first) add(visit.blended, visit.polygon, Outcome::mixed).opacity = visit.opacity;
  }

  /// How the steps depart from the rule: another polygon or another depth is written, none at all, or one that is not
  /// nearer.
  std::string remark(const Visit& visit) const {
    std::string text;
    const auto also = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
    const bool compared = visit.compared();
    if (compared && !visit.nearer() && visit.takes)
      also(fmt::format("written all the same at step {}", grouped(visit.written)));
    if (compared && visit.polygon == no_polygon) also("the trace does not say whose");
    if (visit.takes && visit.polygon != visit.shows)
      also(fmt::format("step {} writes {}", grouped(visit.written), polygon_label(trace_.scene(), visit.shows)));
    if (compared && visit.nearer() && !visit.takes && trace_.size() > visit.step) also("not written");
    if (visit.outcome == Outcome::written && !visit.takes) also("its depth alone");
    if (lacks_depth(visit)) also("its depth was not written");
    if (keeps_other_depth(visit)) also("the depth written is " + depth_text(*visit.kept));
    return text;
  }

  /// What the eye's ray met, until it ends or casts others.
  void add_hits() {
    const auto begin = trace_.next<RayBegin>(
        0, [](const RayBegin& ray) { return ray.role == RayRole::eye; }, pixel_);
    if (!begin) return;
    std::optional<double> kept;
    keeper_ = no_polygon;
    trace_.each(*begin, trace_.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
      if (is_one_of<RayEnd, RayBegin>(recorded)) return false;
      const auto* hit = get_if<RayHit>(&recorded.event);
      if (!hit || !hit->inside) return true;
      const std::int32_t polygon = polygon_of_facet(trace_.scene(), hit->facet);
      Visit& visit = add(step, polygon, hit->nearest ? Outcome::won : kept == hit->t ? Outcome::tie : Outcome::lost);
      visit.z = hit->t, visit.stored = kept, visit.stored_polygon = *keeper_;
      visit.takes = hit->nearest, visit.shows = polygon;
      if (hit->nearest) kept = hit->t, keeper_ = polygon;
      return true;
    });
  }

  bool cut() const { return !trace_.whole(); }
  const std::vector<bool>& begun() const { return facets_.begun(); }

  /// Polygons that cover the pixel's centre.
  void find_there() {
    const Scene& scene = trace_.scene();
    there_.assign(scene.polygons.size(), false), towards_ = away_ = there_;
    const bool matters =
        trace_.has(kind_of<PolygonReject>) || cut() || !begun().empty() || owner_by_interval_or_area() != nullptr;
    if (!matters || pixel_.x < 0 || pixel_.y < 0 || pixel_.x >= scene.raster.width || pixel_.y >= scene.raster.height)
      return;
    const bool non_zero = formulas::fills_non_zero(trace_.header().conventions);
    for (const std::int32_t facet : facets_.near(pixel_)) {
      const auto at = compare::facet_at(scene, facet, false, pixel_.x, pixel_.y, non_zero);
      if (!at || !at->candidate.covers) continue;
      const bool away = trace_.header().conventions.cull && scene.camera.kind != Camera::Kind::screen &&
                        !compare::facet_at(scene, facet, true, pixel_.x, pixel_.y, non_zero);
      const std::size_t polygon = at->candidate.polygon;
      there_[polygon] = true, (away ? away_ : towards_)[polygon] = true;
      facets_there_.insert(facet);
      if (away || !at->candidate.sure()) continue;
      const double z = buffer_depth(scene.camera, trace_.header().conventions, at->candidate.z);
      const auto [known, is_new] = depths_.try_emplace(at->candidate.polygon, z);
      if (!is_new) known->second = std::min(known->second, z);
    }
  }

  /// The visit that painted the pixel last, by a method that decides for more than one pixel at once.
  const Visit* owner_by_interval_or_area() const {
    const Page& page = trace_.header().page;
    if (std::none_of(page.begin(), page.end(),
                     [](const StepInfo& step) { return !description_of_kind(step.kind).gives_around.empty(); }))
      return nullptr;
    const auto last = std::find_if(visits_.rbegin(), visits_.rend(), [](const Visit& visit) { return visit.takes; });
    return last != visits_.rend() && last->outcome == Outcome::painted ? &*last : nullptr;
  }

  /// Of these, the polygons without a step at this pixel: they were found to be behind on the whole interval or area.
  void add_behind() {
    const Visit* const painted = owner_by_interval_or_area();
    if (!painted || !painted->z) return;
    const Visit owner = *painted;
    const auto decided = trace_.previous(owner.step, [](const RecordedEvent& recorded) {
      return !description_of_kind(recorded.event.index()).gives_around.empty();
    });
    const std::string_view around =
        decided ? description_of_kind(trace_.event(*decided).event.index()).gives_around : "there";
    const std::string symbol = depth_symbol(trace_.scene(), trace_.header().conventions),
                      other = polygon_label(trace_.scene(), owner.polygon);
    for (const auto& [polygon, z] : depths_) {
      if (polygon == owner.polygon) continue;
      const std::string name = polygon_label(trace_.scene(), polygon);
      Visit& visit = add(decided.value_or(owner.step), polygon, Outcome::behind);
      visit.z = z, visit.stored = owner.z, visit.stored_polygon = owner.polygon;
      visit.sentence = fmt::format("{} covers pixel ({}, {}), but {} was found to be in front {}.", name, pixel_.x,
                                   pixel_.y, other, around);
      visit.formulas.push_back(difference(symbol, name, other, z, *owner.z));
    }
  }

  /// Of these, the polygons that were not drawn.
  void add_rejected() {
    if (!trace_.has(kind_of<PolygonReject>) || facets_there_.empty()) return;

    // A polygon is rejected after work on it begins, and before work on another does. A BSP tree
    // rejects back faces when it comes to their node, between the pieces that it draws.
    const bool tree = records<EyeSide>(trace_);
    const auto marks = trace_.polygons();
    const auto listed = all_rejects();
    for (std::size_t i = 0; i < marks.size(); ++i) {
      if (!there_[marks[i].polygon]) continue;
      const std::int64_t begin = marks[i].position,
                         end = i + 1 < marks.size() ? marks[i + 1].position - 1 : trace_.size();
      for (const RejectMark& reject : listed ? rejects_among(*listed, begin, end) : rejects_within(begin, end)) {
        const bool by_node = tree && reject.reason == Reject::back_facing;
        if (reject.polygon == marks[i].polygon && !by_node && !is_of_another_facet(begin, reject.polygon))
          add_rejected(reject);
      }
    }
    if (!marks.empty() && !tree) return;
    std::vector<bool> of_node = away_;  // one piece of a polygon that was cut is enough
    for (const RejectMark& reject : trace_.rejects()) {
      const std::size_t polygon = reject.polygon;
      if (!tree && there_[polygon]) add_rejected(reject);
      if (tree && reject.reason == Reject::back_facing && of_node[polygon])
        add_rejected(reject), of_node[polygon] = false;
    }
  }

  /// The trace's list of rejects; none if a damaged block prevents it. The damage need not concern this pixel.
  std::optional<std::span<const RejectMark>> all_rejects() const {
    try {
      return trace_.rejects();
    } catch (const InputError&) {
      return std::nullopt;
    }
  }
  /// The rejects at steps from first to last.
  static std::vector<RejectMark> rejects_among(std::span<const RejectMark> all, std::int64_t first, std::int64_t last) {
    const auto from = std::lower_bound(all.begin(), all.end(), first,
                                       [](const RejectMark& mark, std::int64_t at) { return mark.position < at; });
    const auto end = std::upper_bound(from, all.end(), last,
                                      [](std::int64_t at, const RejectMark& mark) { return at < mark.position; });
    return {from, end};
  }
  /// The same, read from the steps themselves.
  std::vector<RejectMark> rejects_within(std::int64_t first, std::int64_t last) const {
    std::vector<RejectMark> found;
    for (auto at = next_of<PolygonReject>(trace_, first - 1, last + 1); at;
         at = next_of<PolygonReject>(trace_, *at, last + 1)) {
      const auto event = event_at<PolygonReject>(trace_, *at);
      found.push_back({*at, event->polygon, event->reason});
    }
    return found;
  }

  /// Work on this polygon began here with a facet that does not cover the pixel.
  bool is_of_another_facet(std::int64_t begin, std::int32_t polygon) const {
    const Event event = trace_.event(begin).event;
    const auto* work = get_if<PolygonBegin>(&event);
    return work && polygon_of_facet(trace_.scene(), work->facet) == polygon && !facets_there_.contains(work->facet);
  }

  /// Of these, the polygons whose turn had not come when the recording was cut off.
  void add_cut_off() {
    const bool fills = records(trace_.header(), AtPixel::colors | AtPixel::verdict);
    if ((!cut() && begun().empty()) || trace_.size() == 0 || !fills) return;  // others draw lines alone
    // Where depths are compared, each polygon comes to every pixel that it covers. Other methods leave alone what is
    // settled.
    const bool all_come = records(trace_.header(), AtPixel::verdict);
    const bool settled = std::any_of(visits_.begin(), visits_.end(), [](const Visit& visit) {
      return visit.outcome != Outcome::rejected && visit.outcome != Outcome::interpolated;
    });
    if (settled && !all_come) return;
    std::vector<bool> came(there_.size());
    for (const Visit& visit : visits_)
      if (visit.polygon != no_polygon) came[visit.polygon] = true;
    for (std::size_t polygon = 0; polygon < towards_.size(); ++polygon) {
      if (!towards_[polygon] || came[polygon] || (!cut() && begun()[polygon])) continue;
      Visit& visit = add(trace_.size(), index32(polygon), Outcome::cut_off);
      visit.reason = cut() ? "the recording was cut off before its turn"
                           : fmt::format("the trace ends at step {}, before work on it begins", grouped(trace_.size()));
      visit.sentence = fmt::format("{} covers pixel ({}, {}), but {}{}.", polygon_label(trace_.scene(), visit.polygon),
                                   pixel_.x, pixel_.y, visit.reason, cut() ? " there" : "");
    }
  }
  void add_rejected(const RejectMark& reject) {
    Visit& visit = add(reject.position, reject.polygon, Outcome::rejected);
    visit.reason = word_of(reject.reason);
    std::replace(visit.reason.begin(), visit.reason.end(), '_', '-');
    for (const std::int32_t facet : facets_there_)
      if (const RejectCheck check = check_reject(trace_.scene(), facet, reject.reason, nullptr);
          polygon_of_facet(trace_.scene(), facet) == reject.polygon && !check.holds)
        visit.remark = "but " + check.text;
  }

  void find_who_came_over() {
    Visit* holder = nullptr;
    const auto clears = trace_.clears();
    auto next = std::upper_bound(clears.begin(), clears.end(), begin_of_eye_pass(trace_));
    const auto clear_until = [&](std::int64_t step) {
      for (; next != clears.end() && *next < step; ++next) {
        if (holder) holder->wiped = *next;
        holder = nullptr;
      }
    };
    for (std::size_t i = 0; i < visits_.size(); ++i) {
      clear_until(visits_[i].step);
      if (!visits_[i].takes) continue;
      if (holder) holder->over = i;
      holder = &visits_[i];
    }
    clear_until(trace_.size() + 1);
  }

  const Trace& trace_;
  const FacetsNear& facets_;
  Trace::Pixel pixel_;
  std::optional<std::int32_t> keeper_;  ///< of the eye's ray, whose hit is kept; none where no ray is recorded
  std::vector<bool> there_, towards_,
      away_;  ///< by polygon: it covers the pixel; with a facet that may be drawn; with one that is culled
  std::set<std::int32_t> facets_there_;
  std::map<std::int32_t, double> depths_;  ///< of those that may be drawn and surely cover the centre, by polygon
  std::vector<Visit> visits_;
};

}  // namespace

std::vector<Visit> pixel_history(const Trace& trace, const FacetsNear& facets, Trace::Pixel pixel) {
  return History(trace, facets, pixel).all();
}
std::vector<Visit> pixel_history(const Trace& trace, Trace::Pixel pixel) {
  return pixel_history(trace, FacetsNear(trace), pixel);
}

void tell(Replay& replay, Visit& visit) {
  if (!visit.sentence.empty()) return;
  replay.go_to(visit.step);
  const Explanation said = explain(replay.trace(), replay.state(), *replay.current());
  visit.sentence = said.sentence, visit.formulas = said.formulas, visit.owned = said.owned;
  if (!said.besides.empty()) visit.formulas.push_back(said.besides);
}

std::string depth_text(double z) { return std::isinf(z) ? number(z) : fmt::format("{:.9g}", z); }

std::string contradiction_text(const Trace& trace, bool nearer, double z, double stored) {
  // Along a ray t is compared, and the smaller is nearer whatever depths there are.
  const std::string open = records<RayHit>(trace) ? "" : undeclared_text(trace.header(), z == stored);
  return fmt::format("the trace says {}, but {} {} {} is {}{}", nearer ? "nearer" : "not nearer", depth_text(z),
                     trace.header().comparison.sign(), depth_text(stored),
                     is_nearer(trace, z, stored) ? "true" : "false", open.empty() ? "" : " (" + open + ")");
}

namespace {

/// Planes' depths at one pixel; what is within rounding of each other is as near.
std::string behind_text(double gap, double z, double stored) {
  if (std::abs(gap) <= 1e-9 * std::max({1.0, std::abs(z), std::abs(stored)})) return "as near; the first stays";
  return gap > 0 ? "behind by " + depth_text(gap)
                 : fmt::format("its plane is nearer by {}, and yet it was found to be behind", depth_text(-gap));
}

/// Of its own numbers alone.
std::string own_outcome(const Trace& trace, const Visit& visit) {
  const bool known = visit.z && visit.stored;
  switch (visit.outcome) {
    case Outcome::won:
      return "nearer";
    case Outcome::lost:
      return known ? "behind by " + depth_text(trace.header().comparison.behind(*visit.z, *visit.stored)) : "behind";
    case Outcome::tie:
      return keeps_first(trace.header()) ? "a tie: the first stays" : "a tie: the trace says not nearer";
    case Outcome::written:
    case Outcome::painted:
      return "painted";
    case Outcome::mixed:
      if (visit.opacity < 1) return "mixed in, with opacity " + depth_text(visit.opacity);
      [[fallthrough]];
    case Outcome::colored:
      return "the pixel's colour";
    case Outcome::interpolated:
      return "interpolated; no compare of it is recorded";
    case Outcome::behind:
      return behind_text(*visit.z - *visit.stored, *visit.z, *visit.stored);
    case Outcome::rejected:
      return "not drawn: " + visit.reason;
    case Outcome::cut_off:
      break;
  }
  return visit.reason;
}

}  // namespace

std::string outcome_text(const Trace& trace, const std::vector<Visit>& history, const Visit& visit) {
  std::string text = own_outcome(trace, visit);
  if (contradicts(trace, visit))
    text = contradiction_text(trace, visit.outcome == Outcome::won, *visit.z, *visit.stored);
  if (!visit.remark.empty()) text += "; " + visit.remark;
  if (visit.wiped) return fmt::format("{}; cleared at step {}", text, grouped(*visit.wiped));
  if (!visit.over) return text;
  const Visit& other = history[*visit.over];
  const std::int64_t taken = other.written == 0 ? other.step : std::min(other.step, other.written);
  if (other.shows == visit.shows) return fmt::format("{}; written once more after step {}", text, grouped(other.step));
  return fmt::format("{}; {} comes over it at step {}", text, polygon_label(trace.scene(), other.shows),
                     grouped(taken));
}

}  // namespace zstep::answers
