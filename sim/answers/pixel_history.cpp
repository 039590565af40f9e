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
#include "sim/compare/facet_at.hpp"
#include "sim/viewer/words/explain.hpp"
#include "sim/viewer/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::answers {

namespace {

std::int32_t polygon_of_facet(const Scene& scene, std::int32_t facet) {
  const auto at = static_cast<std::size_t>(facet);
  return facet >= 0 && at < scene.facets.size() ? scene.facets[at].polygon : no_polygon;
}

/// Does the trace say of a compare what its two depths do not?
bool contradicts(const Visit& visit) {
  const bool compared = visit.outcome == Outcome::won || visit.outcome == Outcome::lost || visit.outcome == Outcome::tie;
  return compared && visit.z && visit.stored && (*visit.z < *visit.stored) != (visit.outcome == Outcome::won);
}

bool page_has(const Trace& trace, std::uint8_t kind) {
  const Page& page = trace.header().page;
  return std::any_of(page.begin(), page.end(), [&](const StepInfo& step) { return step.kind == kind; });
}

class History {
 public:
  History(const Trace& trace, const FacetsNear& facets, Trace::Pixel pixel)
      : trace_(trace), facets_(facets), pixel_(pixel), all_at_once_(page_has(trace, kind_of<TablesBegin>) && !page_has(trace, kind_of<PieceDraw>)) {}

  std::vector<Visit> all() {
    find_what_is_for_all_pixels();
    std::vector<std::pair<std::int64_t, Event>> touching;
    trace_.scan(pixel_, [&](std::int64_t step, const RecordedEvent& recorded) {
      touching.emplace_back(step, recorded.event);
      return true;
    });
    for (const auto& [step, event] : touching) {
      const auto passed = std::upper_bound(of_all_.begin(), of_all_.end(), step, [](std::int64_t at, const auto& change) { return at < change.first; });
      for (; next_of_all_ < passed - of_all_.begin(); ++next_of_all_) change_all(of_all_[static_cast<std::size_t>(next_of_all_)].second);
      if (pass_ == Pass::eye) look_at(step, event);  // else a pixel of another picture
    }
    find_there();
    add_behind();
    add_rejected();
    add_cut_off();
    std::stable_sort(visits_.begin(), visits_.end(), [](const Visit& a, const Visit& b) { return a.step < b.step; });
    find_who_came_over();
    return std::move(visits_);
  }

 private:
  /// Events that concern this pixel as they do all others.
  void find_what_is_for_all_pixels() {
    for (const std::uint8_t kind : {kind_of<BuffersClear>, kind_of<PassBegin>}) {
      if (!page_has(trace_, kind)) continue;
      trace_.scan(Trace::Among({}, kind), [&](std::int64_t step, const RecordedEvent& recorded) {
        of_all_.emplace_back(step, recorded.event);
        return true;
      });
    }
    std::stable_sort(of_all_.begin(), of_all_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }
  void change_all(const Event& event) {
    if (const auto* clear = std::get_if<BuffersClear>(&event)) depth_ = clear->z, polygon_ = no_polygon, after_rays_ = false;
    if (const auto* pass = std::get_if<PassBegin>(&event)) pass_ = pass->pass;
  }

  Visit& add(std::int64_t step, std::int32_t polygon, Outcome outcome) {
    Visit visit;
    visit.step = step, visit.polygon = polygon, visit.outcome = outcome;
    visit.takes = outcome == Outcome::won || outcome == Outcome::painted;
    visits_.push_back(std::move(visit));
    return visits_.back();
  }
  /// The polygon on which work began last.
  std::int32_t polygon_at(std::int64_t step) const {
    if (all_at_once_) {
      Replay replay(trace_);
      replay.go_to(step);
      return polygon_at_work(replay.state().machine);
    }
    const auto marks = trace_.polygons();
    const auto after = std::upper_bound(marks.begin(), marks.end(), step, [](std::int64_t at, const PolygonMark& mark) { return at < mark.position; });
    return after == marks.begin() ? no_polygon : (after - 1)->polygon;
  }

  void look_at(std::int64_t step, const Event& event) {
    if (const auto* compare = std::get_if<DepthCompare>(&event)) {
      const Outcome outcome = compare->nearer ? Outcome::won : compare->z == depth_ ? Outcome::tie : Outcome::lost;
      Visit& visit = add(step, polygon_at(step), outcome);
      visit.z = compare->z, visit.stored = depth_, visit.stored_polygon = polygon_;
      if (contradicts(visit)) visit.takes = false;  // until it is written
    } else if (const auto* depth = std::get_if<DepthWrite>(&event)) {
      depth_ = depth->z;
    } else if (const auto* write = std::get_if<PixelWrite>(&event)) {
      polygon_ = write->polygon;
      if (!visits_.empty() && contradicts(visits_.back())) visits_.back().takes = true;
    } else if (const auto* paint = std::get_if<PixelPaint>(&event)) {
      if (!after_rays_) {  // else it is the nearest of the hits, which stand there already
        Visit& visit = add(step, paint->polygon, Outcome::painted);
        visit.z = paint->z, visit.stored = depth_, visit.stored_polygon = polygon_;
      }
      depth_ = paint->z, polygon_ = paint->polygon;
    } else if (const auto* blend = std::get_if<ColorBlend>(&event)) {
      const bool shares = blend->opacity < 1 && !visits_.empty() && visits_.back().polygon == blend->polygon;
      if (shares) visits_.back().takes = false;  // it won the compare, and what lies behind shines through
      add(step, blend->polygon, Outcome::mixed).opacity = blend->opacity;
    } else if (std::holds_alternative<ColorWrite>(event)) {
      add(step, no_polygon, Outcome::colored);
    } else if (const auto* ray = std::get_if<RayBegin>(&event); ray && ray->role == RayRole::eye) {
      add_hits(step);
    }
  }

  /// What the eye's ray met, until it ends or casts others.
  void add_hits(std::int64_t begin) {
    after_rays_ = true;
    std::optional<double> kept;
    std::int32_t keeper = no_polygon;
    trace_.each(begin, trace_.size(), [&](std::int64_t step, const RecordedEvent& recorded) {
      if (is_one_of<RayEnd, RayBegin>(recorded)) return false;
      const auto* hit = std::get_if<RayHit>(&recorded.event);
      if (!hit || !hit->inside) return true;
      const std::int32_t polygon = polygon_of_facet(trace_.scene(), hit->facet);
      Visit& visit = add(step, polygon, hit->nearest ? Outcome::won : kept == hit->t ? Outcome::tie : Outcome::lost);
      visit.z = hit->t, visit.stored = kept, visit.stored_polygon = keeper;
      if (hit->nearest) kept = hit->t, keeper = polygon;
      return true;
    });
  }

  bool cut() const { return !trace_.warnings().empty(); }

  /// Polygons that cover the pixel's centre.
  void find_there() {
    const Scene& scene = trace_.scene();
    there_.assign(scene.polygons.size(), false), towards_ = away_ = there_;
    const bool matters = trace_.has(kind_of<PolygonReject>) || cut() || owner_by_interval_or_area() != nullptr;
    if (!matters || pixel_.x < 0 || pixel_.y < 0 || pixel_.x >= scene.raster.width || pixel_.y >= scene.raster.height) return;
    for (const std::int32_t facet : facets_.near(pixel_)) {
      const auto at = compare::facet_at(scene, facet, false, pixel_.x, pixel_.y);
      if (!at || !at->candidate.covers) continue;
      const bool away = trace_.header().conventions.cull && scene.camera.kind != Camera::Kind::screen && !compare::facet_at(scene, facet, true, pixel_.x, pixel_.y);
      const auto polygon = static_cast<std::size_t>(at->candidate.polygon);
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
    if (!page_has(trace_, kind_of<SpanWinner>) && !page_has(trace_, kind_of<AreaDecide>)) return nullptr;
    const auto last = std::find_if(visits_.rbegin(), visits_.rend(), [](const Visit& visit) { return visit.takes; });
    return last != visits_.rend() && last->outcome == Outcome::painted ? &*last : nullptr;
  }

  /// Those of them that came to no step at this pixel, as they were found to be behind on all of the interval or the area.
  void add_behind() {
    const Visit* const painted = owner_by_interval_or_area();
    if (!painted || !painted->z) return;
    const Visit owner = *painted;
    const bool areas = page_has(trace_, kind_of<AreaDecide>);
    const auto decided = areas ? previous_of<AreaDecide>(trace_, owner.step) : previous_of<SpanWinner>(trace_, owner.step);
    const std::string symbol = depth_symbol(trace_.scene(), trace_.header().conventions), other = polygon_label(trace_.scene(), owner.polygon);
    for (const auto& [polygon, z] : depths_) {
      if (polygon == owner.polygon) continue;
      const std::string name = polygon_label(trace_.scene(), polygon);
      Visit& visit = add(decided.value_or(owner.step), polygon, Outcome::behind);
      visit.z = z, visit.stored = owner.z, visit.stored_polygon = owner.polygon;
      visit.sentence = fmt::format("{} covers pixel ({}, {}), but {} was found to be in front {}.", name, pixel_.x, pixel_.y, other,
                                   areas ? "in the area around it" : "on the interval of the scan line around it");
      visit.formulas.push_back(difference(symbol, name, other, z, *owner.z));
    }
  }

  /// Those of them that were not drawn.
  void add_rejected() {
    if (!trace_.has(kind_of<PolygonReject>) || facets_there_.empty()) return;

    // A polygon is rejected after work on it begins, and before work on another does. A tree's back faces are rejected when their node is
    // come to, between pieces that are drawn.
    const bool tree = page_has(trace_, kind_of<EyeSide>);
    const auto marks = trace_.polygons();
    const auto listed = all_rejects();
    for (std::size_t i = 0; i < marks.size(); ++i) {
      if (!there_[static_cast<std::size_t>(marks[i].polygon)]) continue;
      const std::int64_t begin = marks[i].position, end = i + 1 < marks.size() ? marks[i + 1].position - 1 : trace_.size();
      for (const RejectMark& reject : listed ? rejects_among(*listed, begin, end) : rejects_within(begin, end)) {
        const bool by_node = tree && reject.reason == Reject::back_facing;
        if (reject.polygon == marks[i].polygon && !by_node && !is_of_another_facet(begin, reject.polygon)) add_rejected(reject);
      }
    }
    if (!marks.empty() && !tree) return;
    std::vector<bool> of_node = away_;  // of a polygon that was cut one piece speaks for all
    for (const RejectMark& reject : trace_.rejects()) {
      const auto polygon = static_cast<std::size_t>(reject.polygon);
      if (!tree && there_[polygon]) add_rejected(reject);
      if (tree && reject.reason == Reject::back_facing && of_node[polygon]) add_rejected(reject), of_node[polygon] = false;
    }
  }

  /// The trace's list of rejects; nothing where a damaged block keeps it from being made, which need not concern this pixel.
  std::optional<std::span<const RejectMark>> all_rejects() const {
    try {
      return trace_.rejects();
    } catch (const InputError&) {
      return std::nullopt;
    }
  }
  /// Those of them at steps from first to last.
  static std::vector<RejectMark> rejects_among(std::span<const RejectMark> all, std::int64_t first, std::int64_t last) {
    const auto from = std::lower_bound(all.begin(), all.end(), first, [](const RejectMark& mark, std::int64_t at) { return mark.position < at; });
    const auto end = std::upper_bound(from, all.end(), last, [](std::int64_t at, const RejectMark& mark) { return at < mark.position; });
    return {from, end};
  }
  /// The same, read from the steps themselves.
  std::vector<RejectMark> rejects_within(std::int64_t first, std::int64_t last) const {
    std::vector<RejectMark> found;
    for (auto at = next_of<PolygonReject>(trace_, first - 1, last + 1); at; at = next_of<PolygonReject>(trace_, *at, last + 1)) {
      const auto event = event_at<PolygonReject>(trace_, *at);
      found.push_back({*at, event->polygon, event->reason});
    }
    return found;
  }

  /// Work on this polygon began here with a facet that does not cover the pixel.
  bool is_of_another_facet(std::int64_t begin, std::int32_t polygon) const {
    const Event event = trace_.event(begin).event;
    const auto* work = std::get_if<PolygonBegin>(&event);
    return work && polygon_of_facet(trace_.scene(), work->facet) == polygon && !facets_there_.contains(work->facet);
  }

  /// Those of them whose turn did not come before the recording was cut off.
  void add_cut_off() {
    if (!cut() || trace_.size() == 0 || page_has(trace_, kind_of<LineBegin>) || page_has(trace_, kind_of<HorizonTest>)) return;
    // Each polygon is compared at each pixel that it covers; by other methods what is settled is not looked at again.
    const bool all_come = page_has(trace_, kind_of<DepthCompare>);
    const bool settled = std::any_of(visits_.begin(), visits_.end(), [](const Visit& visit) { return visit.outcome != Outcome::rejected; });
    if (settled && !all_come) return;
    std::vector<bool> came(there_.size());
    for (const Visit& visit : visits_)
      if (visit.polygon != no_polygon) came[static_cast<std::size_t>(visit.polygon)] = true;
    for (std::size_t polygon = 0; polygon < towards_.size(); ++polygon) {
      if (!towards_[polygon] || came[polygon]) continue;
      Visit& visit = add(trace_.size(), static_cast<std::int32_t>(polygon), Outcome::cut_off);
      visit.sentence = fmt::format("{} covers pixel ({}, {}), but the recording was cut off before its turn there.", polygon_label(trace_.scene(), visit.polygon), pixel_.x, pixel_.y);
    }
  }
  void add_rejected(const RejectMark& reject) {
    Visit& visit = add(reject.position, reject.polygon, Outcome::rejected);
    visit.reason = words_of<Reject>[static_cast<std::size_t>(reject.reason)];
    std::replace(visit.reason.begin(), visit.reason.end(), '_', '-');
  }

  void find_who_came_over() {
    Visit* holder = nullptr;
    auto next = of_all_.begin();
    const auto clear_until = [&](std::int64_t step) {
      for (; next != of_all_.end() && next->first < step; ++next) {
        if (!std::holds_alternative<BuffersClear>(next->second)) continue;
        if (holder) holder->wiped = next->first;
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
  bool all_at_once_;  ///< the method goes through all polygons line by line
  std::vector<std::pair<std::int64_t, Event>> of_all_;
  std::ptrdiff_t next_of_all_ = 0;  ///< of those, the first that is still to come
  Pass pass_ = Pass::eye;
  double depth_ = no_depth;  ///< what the pixel holds
  std::int32_t polygon_ = no_polygon;
  bool after_rays_ = false;
  std::vector<bool> there_, towards_, away_;  ///< by polygon: it covers the pixel; with a facet that may be drawn; with one that is culled
  std::set<std::int32_t> facets_there_;
  std::map<std::int32_t, double> depths_;  ///< of those that may be drawn and surely cover the centre, by polygon
  std::vector<Visit> visits_;
};

}  // namespace

std::vector<Visit> pixel_history(const Trace& trace, const FacetsNear& facets, Trace::Pixel pixel) { return History(trace, facets, pixel).all(); }
std::vector<Visit> pixel_history(const Trace& trace, Trace::Pixel pixel) { return pixel_history(trace, FacetsNear(trace), pixel); }

void tell(Replay& replay, Visit& visit) {
  if (!visit.sentence.empty()) return;
  replay.go_to(visit.step);
  const Explanation said = explain(replay.trace(), replay.state(), *replay.current());
  visit.sentence = said.sentence, visit.formulas = said.formulas;
  if (said.doubt) visit.formulas.push_back(*said.doubt);
}

std::string depth_text(double z) { return std::isinf(z) ? "inf" : fmt::format("{:.9g}", z); }

std::string contradiction_text(bool nearer, double z, double stored) {
  return fmt::format("the trace says {}, but {} < {} is {}", nearer ? "nearer" : "not nearer", depth_text(z), depth_text(stored), z < stored ? "true" : "false");
}

namespace {

/// Planes' depths at one pixel; what is within rounding of each other is as near.
std::string behind_text(double gap, double z, double stored) {
  if (std::abs(gap) <= 1e-9 * std::max({1.0, std::abs(z), std::abs(stored)})) return "as near; the first stays";
  return gap > 0 ? "behind by " + depth_text(gap) : fmt::format("its plane is nearer by {}, and yet it was found to be behind", depth_text(-gap));
}

}  // namespace

std::string outcome_text(const Trace& trace, const std::vector<Visit>& history, const Visit& visit) {
  std::string text;
  switch (visit.outcome) {
    case Outcome::won: text = "nearer"; break;
    case Outcome::lost: text = visit.z && visit.stored ? "behind by " + depth_text(*visit.z - *visit.stored) : "behind"; break;
    case Outcome::tie: text = "a tie: the first stays"; break;
    case Outcome::painted: text = "painted"; break;
    case Outcome::mixed:
      text = visit.opacity && *visit.opacity < 1 ? "mixed in, with opacity " + depth_text(*visit.opacity) : "the pixel's colour";
      break;
    case Outcome::colored: text = "the pixel's colour"; break;
    case Outcome::behind: text = behind_text(*visit.z - *visit.stored, *visit.z, *visit.stored); break;
    case Outcome::rejected: text = "not drawn: " + visit.reason; break;
    case Outcome::cut_off: text = "the recording was cut off before its turn"; break;
  }
  if (contradicts(visit)) text = contradiction_text(visit.outcome == Outcome::won, *visit.z, *visit.stored);
  if (visit.wiped) return fmt::format("{}; cleared at step {}", text, grouped(*visit.wiped));
  if (!visit.over) return text;
  const Visit& other = history[*visit.over];
  return fmt::format("{}; {} comes over it at step {}", text, polygon_label(trace.scene(), other.polygon), grouped(other.step));
}

}  // namespace zstep::answers
