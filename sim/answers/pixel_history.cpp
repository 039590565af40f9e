#include "sim/answers/pixel_history.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

#include <fmt/format.h>

#include "sim/compare/truth.hpp"
#include "sim/viewer/words/explain.hpp"
#include "sim/viewer/words/numbers.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::answers {

namespace {

std::int32_t polygon_of_facet(const Scene& scene, std::int32_t facet) {
  const auto at = static_cast<std::size_t>(facet);
  return facet >= 0 && at < scene.facets.size() ? scene.facets[at].polygon : no_polygon;
}

/// Of a method that goes through all polygons at once, the one whose span is being filled.
std::int32_t polygon_at_work(const Machine& machine) {
  const auto edge = machine.span ? static_cast<std::size_t>(machine.span->left_edge) : machine.edge_table.size();
  return edge < machine.edge_table.size() ? machine.edge_table[edge].entry.polygon : machine.polygon;
}

class History {
 public:
  History(const Trace& trace, Trace::Pixel pixel) : trace_(trace), pixel_(pixel), replay_(trace) {}

  std::vector<Visit> all() {
    const auto touches = [this](const RecordedEvent& recorded) {
      const auto at = pixel_of(recorded.event);
      return at && at->x == pixel_.x && at->y == pixel_.y;
    };
    for (auto step = trace_.next(0, touches, pixel_); step; step = trace_.next(*step, touches, pixel_)) look_at(*step);
    add_rejected();
    std::stable_sort(visits_.begin(), visits_.end(), [](const Visit& a, const Visit& b) { return a.step < b.step; });
    find_who_came_over();
    return std::move(visits_);
  }

 private:
  /// A visit with what the words say of its step; the replay stands there afterwards.
  Visit told(std::int64_t step, std::int32_t polygon, Outcome outcome) {
    replay_.go_to(step);
    const Explanation said = explain(trace_, replay_.state(), *replay_.current());
    Visit visit;
    visit.step = step, visit.polygon = polygon, visit.outcome = outcome;
    visit.takes = outcome == Outcome::won || outcome == Outcome::painted;
    visit.sentence = said.sentence, visit.formulas = said.formulas;
    return visit;
  }
  /// The same with the depth that the fragment at work was held against.
  Visit told_of_fragment(std::int64_t step, std::int32_t polygon, Outcome outcome) {
    Visit visit = told(step, polygon, outcome);
    const auto& fragment = replay_.state().machine.fragment;
    if (fragment && fragment->x == pixel_.x && fragment->y == pixel_.y) {
      visit.z = fragment->z;
      visit.stored = fragment->stored;
      visit.stored_polygon = fragment->stored_polygon;
    }
    return visit;
  }

  void look_at(std::int64_t step) {
    const Event event = trace_.event(step).event;
    if (const auto* compare = std::get_if<DepthCompare>(&event)) {
      Visit visit = told_of_fragment(step, no_polygon, compare->nearer ? Outcome::won : Outcome::lost);
      if (replay_.state().machine.pass == Pass::light) return;  // a pixel of another picture
      visit.polygon = polygon_at_work(replay_.state().machine);
      visit.z = compare->z;
      if (!compare->nearer && visit.stored == compare->z) visit.outcome = Outcome::tie;
      visits_.push_back(std::move(visit));
    } else if (const auto* paint = std::get_if<PixelPaint>(&event)) {
      if (after_rays_) return;  // the nearest of the hits, which stand there already
      visits_.push_back(told_of_fragment(step, paint->polygon, Outcome::painted));
      visits_.back().z = paint->z;
    } else if (const auto* blend = std::get_if<ColorBlend>(&event)) {
      const bool shares = blend->opacity < 1 && !visits_.empty() && visits_.back().polygon == blend->polygon;
      if (shares) visits_.back().takes = false;  // it won the compare, and what lies behind shines through
      visits_.push_back(told(step, blend->polygon, Outcome::mixed));
      visits_.back().opacity = blend->opacity;
    } else if (std::holds_alternative<ColorWrite>(event)) {
      visits_.push_back(told(step, no_polygon, Outcome::colored));
    } else if (const auto* ray = std::get_if<RayBegin>(&event); ray && ray->role == RayRole::eye) {
      add_hits(step);
    }
  }

  /// What the eye's ray met, until it ends or casts others.
  void add_hits(std::int64_t begin) {
    after_rays_ = true;
    std::optional<double> kept;
    std::int32_t keeper = no_polygon;
    for (std::int64_t step = begin + 1; step <= trace_.size(); ++step) {
      const Event event = trace_.event(step).event;
      if (std::holds_alternative<RayEnd>(event) || std::holds_alternative<RayBegin>(event)) return;
      const auto* hit = std::get_if<RayHit>(&event);
      if (!hit || !hit->inside) continue;
      const std::int32_t polygon = polygon_of_facet(trace_.scene(), hit->facet);
      Visit visit = told(step, polygon, hit->nearest ? Outcome::won : kept == hit->t ? Outcome::tie : Outcome::lost);
      visit.z = hit->t, visit.stored = kept, visit.stored_polygon = keeper;
      visits_.push_back(std::move(visit));
      if (hit->nearest) kept = hit->t, keeper = polygon;
    }
  }

  /// Polygons that cover the pixel's centre and were not drawn.
  void add_rejected() {
    const Scene& scene = trace_.scene();
    const Page& page = trace_.header().page;
    const bool rejects = std::any_of(page.begin(), page.end(), [](const StepInfo& step) { return step.kind == kind_of<PolygonReject>; });
    if (!rejects || pixel_.x < 0 || pixel_.y < 0 || pixel_.x >= scene.raster.width || pixel_.y >= scene.raster.height) return;
    std::vector<std::uint8_t> wanted(static_cast<std::size_t>(scene.raster.width) * static_cast<std::size_t>(scene.raster.height), 0);
    wanted[static_cast<std::size_t>(pixel_.y) * static_cast<std::size_t>(scene.raster.width) + static_cast<std::size_t>(pixel_.x)] = 1;
    const compare::Truth truth(scene, false, wanted);
    std::set<std::int32_t> polygons, facets;
    for (const compare::Candidate& candidate : truth.at(pixel_.x, pixel_.y))
      if (candidate.covers) polygons.insert(candidate.polygon), facets.insert(candidate.facet);
    if (polygons.empty()) return;

    const auto of_them = [&](const RecordedEvent& recorded) {
      const auto* reject = std::get_if<PolygonReject>(&recorded.event);
      return reject && polygons.contains(reject->polygon);
    };
    for (auto step = trace_.next(0, of_them); step; step = trace_.next(*step, of_them)) {
      const PolygonReject reject = std::get<PolygonReject>(trace_.event(*step).event);
      const std::int32_t polygon = reject.polygon;
      Visit visit = told(*step, polygon, Outcome::rejected);
      visit.reason = words_of<Reject>[static_cast<std::size_t>(reject.reason)];
      std::replace(visit.reason.begin(), visit.reason.end(), '_', '-');
      const Machine& machine = replay_.state().machine;
      const bool another_facet = machine.facet >= 0 && polygon_of_facet(scene, machine.facet) == polygon && !facets.contains(machine.facet);
      if (!another_facet) visits_.push_back(std::move(visit));
    }
  }

  void find_who_came_over() {
    std::optional<std::size_t> holder;
    for (std::size_t i = 0; i < visits_.size(); ++i) {
      if (!visits_[i].takes) continue;
      if (holder) visits_[*holder].over = i;
      holder = i;
    }
  }

  const Trace& trace_;
  Trace::Pixel pixel_;
  Replay replay_;
  bool after_rays_ = false;
  std::vector<Visit> visits_;
};

}  // namespace

std::vector<Visit> pixel_history(const Trace& trace, Trace::Pixel pixel) { return History(trace, pixel).all(); }

std::string depth_text(double z) { return std::isinf(z) ? "inf" : fmt::format("{:.9g}", z); }

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
    case Outcome::rejected: text = "not drawn: " + visit.reason; break;
  }
  if (!visit.over) return text;
  const Visit& other = history[*visit.over];
  return fmt::format("{}; {} comes over it at step {}", text, polygon_label(trace.scene(), other.polygon), grouped(other.step));
}

}  // namespace zstep::answers
