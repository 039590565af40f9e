// A polygon on the whole picture: where it is seen, or why nowhere.

#include "sim/answers/why_not.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include "sim/answers/seen_point.hpp"
#include "sim/answers/why_not_parts.hpp"
#include "sim/words/owners.hpp"
#include "traces/formulas/fill.hpp"
#include "traces/replay/replay.hpp"
#include "traces/scene.hpp"

namespace zstep::answers {

bool does_not_cover(Why kind) { return kind >= Why::outside && kind <= Why::box_missed; }

Asked::Asked(const Trace& asked, Replay* at_hand, std::int32_t of, Trace::Pixel at)
    : trace(asked),
      scene(asked.scene()),
      polygon(of),
      pixel(at),
      name(polygon_label(scene, of)),
      where(fmt::format("at pixel ({}, {})", at.x, at.y)),
      z(depth_symbol(scene, asked.header().conventions)),
      at_hand_(at_hand) {
  if (of < 0 || of >= std::ssize(scene.polygons)) throw std::out_of_range("why_not: no such polygon");
  const Raster& raster = scene.raster;
  if (at.x < 0 || at.y < 0 || at.x >= raster.width || at.y >= raster.height)
    throw std::out_of_range("why_not: no such pixel");
}

std::vector<std::int32_t> Asked::facets() const {
  std::vector<std::int32_t> found;
  for (std::size_t k = 0; k < scene.facets.size(); ++k)
    if (scene.facets[k].polygon == polygon) found.push_back(index32(k));
  return found;
}

Verdict Asked::verdict(Why kind, std::int64_t step, const std::string& reason) const {
  Verdict verdict;
  verdict.kind = kind, verdict.step = step;
  if (!anywhere_) verdict.pixel = pixel;
  const char* const is = kind == Why::seen    ? "what is seen"
                         : kind == Why::mixed ? "a part of what is seen"
                                              : "not seen";
  verdict.sentence = fmt::format("{} is {} {}: {}.", name, is, where, reason);
  return verdict;
}

const State& Asked::state_at(std::int64_t step) {
  if (replay() == nullptr) own_.emplace(trace);
  replay()->go_to(step);
  return replay()->state();
}

void Asked::add_formulas(Verdict& verdict, std::int64_t step, std::int32_t of, const Visit* visit) {
  if (step < 1) return;
  if (visit && visit->compared() && !visit->stored) return;  // the stored depth is not known
  std::optional<HeldBefore> before;
  if (visit) before = {visit->stored.value_or(trace.header().empty_depth()), visit->stored_polygon};
  const std::optional<State> nearby = state_nearby(trace, step, of, before);
  const Explanation said = explain(trace, nearby ? *nearby : state_at(step), trace.event(step));
  verdict.formulas.insert(verdict.formulas.end(), said.formulas.begin(), said.formulas.end());
  for (const words::Owned& one : said.owned) words::add_owned(verdict.owned, one);
  if (said.doubt) verdict.add_formula("{}", *said.doubt);
}

std::optional<std::int64_t> next_color(const Asked& q, std::int64_t from, std::int64_t end) {
  const std::int64_t until = end > 0 ? end - 1 : q.trace.size();
  return q.trace.next(from, is_one_of<ColorWrite>, Trace::Among(q.pixel, kind_of<ColorWrite>, until));
}

Verdict not_recorded(const Asked& q) {
  return q.verdict(Why::not_recorded, 0,
                   q.trace.whole() ? "it covers the pixel, but the trace records no step of it there"
                                   : "it covers the pixel, but the recording was cut off before its turn there");
}

Verdict not_begun(const Asked& q) {
  if (!q.trace.whole()) return not_recorded(q);
  return q.verdict(Why::not_recorded, 0, "the trace ends at step {}, before work on {} begins", grouped(q.trace.size()),
                   q.name);
}

Verdict seen(Asked& q, std::int64_t step, const std::string& how, const std::string& what) {
  Verdict verdict = q.verdict(Why::seen, step, how);
  verdict.other = q.polygon;
  verdict.add_step(step, q.polygon, "{}", what.empty() ? "the pixel becomes " + q.name : what);
  return verdict;
}

namespace {

/// Without links to steps that are not recorded, and in order.
Verdict tidied(Verdict verdict) {
  std::erase_if(verdict.chain, [](const Link& link) { return link.step < 1; });
  std::stable_sort(verdict.chain.begin(), verdict.chain.end(),
                   [](const Link& a, const Link& b) { return a.step < b.step; });
  return verdict;
}

}  // namespace

Verdict why_not(const Trace& trace, std::int32_t polygon, Trace::Pixel pixel, Replay* replay) {
  Asked q(trace, replay, polygon, pixel);
  Verdict verdict;
  if (of_curves(trace)) {
    verdict = why_by_curves(q);
  } else if (of_lines(trace)) {
    verdict = why_by_lines(q);
  } else {
    const std::vector<FacetThere> facets = facets_there(q);
    verdict = of_rays(trace)    ? why_by_rays(q, facets)
              : of_areas(trace) ? why_by_areas(q, facets)
              : of_sweep(trace) ? why_by_sweep(q, facets)
                                : why_by_pixels(q, facets);
    if (facets.size() > 1 && verdict.kind != Why::seen)
      verdict.say(" ({} has {} facets; this is {}.)", q.name, facets.size(),
                  verdict.facet < 0 ? "the one that came nearest to it" : fmt::format("facet {}", verdict.facet));
  }
  return tidied(std::move(verdict));
}

std::optional<std::int32_t> polygon_called(const Scene& scene, const std::string& text) {
  const auto count = size32(scene.polygons);
  for (std::int32_t k = 0; k < count; ++k)
    if (*scene.polygons[k].name == text && !text.empty()) return k;
  const std::size_t skip = text.size() > 1 && (text[0] == 'P' || text[0] == 'p') ? 1 : 0;
  std::int32_t number = -1;
  const char *first = text.data() + skip, *last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc() || end != last || number < 0 || number >= count) return std::nullopt;
  return number;
}

namespace {

/// A pixel whose centre the polygon covers, and how deep it and what is seen there are.
struct Covered {
  Trace::Pixel pixel{};
  bool sure = false;  ///< beyond rounding
  double gap = 0;     ///< z_v of the polygon minus that of what is seen
  std::int32_t owner = no_polygon;
};

/// By these facets, whatever way they face.
std::vector<Covered> covered(const Asked& q, std::vector<Facet> facets, const Picture& picture) {
  if (facets.empty()) return {};
  Scene alone = q.scene;
  alone.facets = std::move(facets);
  const compare::Truth truth(alone, false, {}, formulas::fills_non_zero(q.trace.header().conventions));
  std::vector<Covered> all;
  for (std::int32_t y = 0; y < truth.height(); ++y)
    for (std::int32_t x = 0; x < truth.width(); ++x)
      for (const compare::Candidate& candidate : truth.at(x, y)) {
        if (!candidate.covers) continue;
        const std::size_t at = picture.at(x, y);
        const double seen = std::isinf(picture.depth[at])
                                ? no_depth
                                : view_depth(q.scene.camera, q.trace.header().conventions, picture.depth[at]);
        all.push_back({{x, y}, candidate.sure(), candidate.z - seen, picture.polygon[at]});
        break;
      }
  return all;
}

/// Was the recording cut off before the pixel was settled? Nothing was drawn there, or only what lies behind.
bool is_pending(const Asked& q, const Covered& one) {
  return !q.trace.whole() && (one.owner == no_polygon || one.gap < 0);
}

/// "to Q at 12 pixels, to R at 3 pixels", the most first, where `to` is "to ".
std::string losses(const Asked& q, const std::vector<Covered>& all, const char* to) {
  std::map<std::int32_t, std::size_t> count;
  for (const Covered& one : all) ++count[one.owner];
  std::vector<std::pair<std::int32_t, std::size_t>> sorted(count.begin(), count.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  constexpr std::size_t named = 4;
  std::string text;
  std::size_t rest = 0;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    if (k >= named) rest += sorted[k].second;
    else
      text += fmt::format("{}{}{} at {}", text.empty() ? "" : ", ", to, q.label(sorted[k].first),
                          count_text(sorted[k].second, "pixel", "pixels"));
  }
  if (rest > 0) text += fmt::format(", {}others at {}", to, count_text(rest, "pixel", "pixels"));
  return text;
}

/// "it covers 9 pixels and loses them all, to Q at 9 pixels", as far as the recording goes.
std::string fate(const Asked& q, const std::vector<Covered>& all) {
  std::vector<Covered> lost = all;
  std::erase_if(lost, [&](const Covered& one) { return is_pending(q, one); });
  const std::size_t pending = all.size() - lost.size();
  const std::string covers = "it covers " + count_text(all.size(), "pixel", "pixels");
  if (pending == 0)
    return fmt::format("{} and loses {}, {}", covers, all.size() == 1 ? "it" : "them all", losses(q, all, "to "));
  if (lost.empty()) return fmt::format("{}, but the recording was cut off before its turn there", covers);
  return fmt::format(
      "{}; the recording was cut off before its turn at {}, and at the {} it lies behind what was drawn by then, {}",
      covers, grouped(pending), lost.size() == 1 ? "other" : "others", losses(q, lost, ""));
}

/// Where its facets were rejected one and all; else nullopt.
std::optional<Verdict> gone_as_a_whole(Asked& q, std::vector<FacetThere> facets, const Picture& picture) {
  for (FacetThere& there : facets) {
    if (!there.rejected() && !there.away) return std::nullopt;
    // Over the whole picture it does not matter whether this one pixel would be covered.
    there.cut_at.reset();
    if (there.rejected() && !there.surely)
      for (const Covered& one : covered(q, {q.scene.facets[there.facet]}, picture))
        if (one.sure && !there.surely) there.surely = one.pixel;
    if (there.at) there.at->candidate.covers = there.away || there.reason == Reject::back_facing;
  }
  q.ask_anywhere();
  return why_by_facets(q, facets);
}

Verdict filled(Asked& q, const Picture& picture) {
  std::size_t count = 0;
  std::optional<Trace::Pixel> first;
  for (std::int32_t y = 0; y < picture.height; ++y)
    for (std::int32_t x = 0; x < picture.width; ++x) {
      if (picture.polygon[picture.at(x, y)] != q.polygon) continue;
      if (!first) first = Trace::Pixel{x, y};
      ++count;
    }
  if (first)
    return with_pixel(
        q, *first, fmt::format("{} is seen at {}; the first of them:", q.name, count_text(count, "pixel", "pixels")));

  const std::vector<FacetThere> facets = facets_there(q);
  if (auto verdict = gone_as_a_whole(q, facets, picture)) return *verdict;
  if (q.trace.whole() &&
      std::all_of(facets.begin(), facets.end(), [&](const FacetThere& there) { return never_begun(q, there); })) {
    q.ask_anywhere();
    return facets.empty() ? *why_by_facets(q, facets) : not_begun(q);
  }
  std::vector<Facet> drawn;
  for (const FacetThere& there : facets)
    if (!there.rejected() && !there.away) drawn.push_back(q.scene.facets[there.facet]);
  const std::vector<Covered> all = covered(q, std::move(drawn), picture);
  if (all.empty()) {
    q.ask_anywhere();
    Verdict verdict = q.verdict(Why::not_covered, facets.empty() ? 0 : facets.front().mark,
                                "as it is drawn it covers no pixel's {}", seen_point(q.scene.raster));
    for (const FacetThere& there : facets) verdict.add_step(there.mark, q.polygon, "work on {} begins", q.name);
    return verdict;
  }
  const Covered best =
      *std::min_element(all.begin(), all.end(), [](const Covered& a, const Covered& b) { return a.gap < b.gap; });
  Verdict verdict = why_not(q.trace, q.polygon, best.pixel, q.replay());
  const std::string whole =
      verdict.kind == Why::mixed
          ? fmt::format("{} takes no pixel for itself; it covers {}. Where it is nearest:", q.name,
                        count_text(all.size(), "pixel", "pixels"))
          : fmt::format("{} is not seen anywhere: {}. Where it comes nearest to being seen:", q.name, fate(q, all));
  verdict.sentence = whole + " " + verdict.sentence;
  return verdict;
}

}  // namespace

std::string count_text(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", grouped(count), count == 1 ? one : many);
}

Verdict with_pixel(const Asked& q, Trace::Pixel pixel, const std::string& whole) {
  Verdict verdict = why_not(q.trace, q.polygon, pixel);
  verdict.sentence = whole + " " + verdict.sentence;
  return verdict;
}

Verdict why_not(const Trace& trace, std::int32_t polygon, Replay* replay) {
  Asked q(trace, replay, polygon, {0, 0});
  if (of_curves(trace)) return tidied(curves_anywhere(q));
  if (of_lines(trace)) return tidied(lines_anywhere(q));
  return tidied(filled(q, Picture(q.state_at(trace.size()).picture)));
}

}  // namespace zstep::answers
