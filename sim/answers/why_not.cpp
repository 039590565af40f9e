#include "sim/answers/why_not.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "sim/answers/why_not_parts.hpp"
#include "sim/words/owners.hpp"
#include "traces/replay/nearby.hpp"

namespace zstep::answers {

bool does_not_cover(Why kind) {
  switch (kind) {
    case Why::outside:
    case Why::edge_on:
    case Why::degenerate:
    case Why::not_covered:
    case Why::flag_out:
    case Why::apart:
    case Why::box_missed:
      return true;
    default:
      return false;
  }
}

Asked::Asked(const Trace& asked, Replay* at_hand, std::int32_t of, Trace::Pixel at)
    : trace(asked),
      scene(asked.scene()),
      polygon(of),
      pixel(at),
      name(polygon_label(scene, of)),
      where(fmt::format("at pixel ({}, {})", at.x, at.y)),
      z(depth_symbol(scene, asked.header().conventions)),
      at_hand_(at_hand) {
  if (of < 0 || static_cast<std::size_t>(of) >= scene.polygons.size())
    throw std::out_of_range("why_not: no such polygon");
  const Raster& raster = scene.raster;
  if (at.x < 0 || at.y < 0 || at.x >= raster.width || at.y >= raster.height)
    throw std::out_of_range("why_not: no such pixel");
}

std::vector<std::int32_t> Asked::facets() const {
  std::vector<std::int32_t> found;
  for (std::size_t k = 0; k < scene.facets.size(); ++k)
    if (scene.facets[k].polygon == polygon) found.push_back(static_cast<std::int32_t>(k));
  return found;
}

Verdict Asked::verdict(Why kind, std::int64_t step, const std::string& reason) const {
  Verdict verdict;
  verdict.kind = kind, verdict.step = step, verdict.pixel = pixel;
  verdict.sentence = fmt::format("{} is not seen {}: {}.", name, where, reason);
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
  if (said.doubt) verdict.formulas.push_back(*said.doubt);
}

Verdict not_recorded(const Asked& q) {
  return q.verdict(Why::not_recorded, 0,
                   q.trace.whole() ? "it covers the pixel, but the trace records no step of it there"
                                   : "it covers the pixel, but the recording was cut off before its turn there");
}

Verdict not_begun(const Asked& q) {
  if (!q.trace.whole()) return not_recorded(q);
  return q.verdict(Why::not_recorded, 0,
                   fmt::format("the trace ends at step {}, before work on {} begins", grouped(q.trace.size()), q.name));
}

Verdict seen(Asked& q, std::int64_t step, const std::string& how, const std::string& what) {
  Verdict verdict;
  verdict.kind = Why::seen, verdict.step = step, verdict.other = q.polygon, verdict.pixel = q.pixel;
  verdict.sentence = fmt::format("{} is what is seen {}: {}.", q.name, q.where, how);
  verdict.chain.push_back({step, q.polygon, what});
  return verdict;
}

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
      verdict.sentence +=
          fmt::format(" ({} has {} facets; this is {}.)", q.name, facets.size(),
                      verdict.facet < 0 ? "the one that came nearest to it" : fmt::format("facet {}", verdict.facet));
  }
  std::erase_if(verdict.chain, [](const Link& link) { return link.step < 1; });
  std::stable_sort(verdict.chain.begin(), verdict.chain.end(),
                   [](const Link& a, const Link& b) { return a.step < b.step; });
  return verdict;
}

std::optional<std::int32_t> polygon_called(const Scene& scene, const std::string& text) {
  const auto count = static_cast<std::int32_t>(scene.polygons.size());
  for (std::int32_t k = 0; k < count; ++k)
    if (*scene.polygons[static_cast<std::size_t>(k)].name == text && !text.empty()) return k;
  const std::size_t skip = text.size() > 1 && (text[0] == 'P' || text[0] == 'p') ? 1 : 0;
  std::int32_t number = -1;
  const char *first = text.data() + skip, *last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc() || end != last || number < 0 || number >= count) return std::nullopt;
  return number;
}

}  // namespace zstep::answers
