// Warnock's areas: the chain of areas around the pixel, the polygon's bin in each, and who the last one was given to.
#include <algorithm>
#include <cmath>

#include "sim/answers/why_not_parts.hpp"
#include "traces/formulas/of_areas.hpp"

namespace zstep::answers {
namespace {

struct AreaThere {
  std::int64_t begin = 0, decided = 0;
  AreaBegin area{};
  AreaDecide decide{};
};

bool holds(const AreaBegin& area, Trace::Pixel pixel) {
  return area.first_column <= pixel.x && pixel.x < area.end_column && area.first_row <= pixel.y &&
         pixel.y < area.end_row;
}
bool lies_in(const AreaBegin& part, const AreaBegin& whole) {
  return part.first_column >= whole.first_column && part.end_column <= whole.end_column &&
         part.first_row >= whole.first_row && part.end_row <= whole.end_row;
}

/// The quarter of an area that holds the pixel.
std::optional<Found<AreaBegin>> quarter_with(const Trace& trace, const AreaThere& whole, Trace::Pixel pixel) {
  const std::int64_t end = trace.size() + 1;
  const auto first = next_event<AreaBegin>(trace, whole.decided, end);
  if (!first || holds(first->event, pixel)) return first;
  // The first quarter shows where the area was split; a single column or row is not. Quarters are settled in turn.
  const AreaBegin& corner = first->event;
  const std::int32_t column = corner.end_column < whole.area.end_column ? corner.end_column : whole.area.end_column;
  const std::int32_t row = corner.end_row < whole.area.end_row ? corner.end_row : whole.area.end_row;
  const auto place = [&](const AreaBegin& part) {
    return lies_in(part, whole.area) ? (part.first_column >= column) + 2 * (part.first_row >= row) : 4;
  };
  const int wanted = (pixel.x >= column) + 2 * (pixel.y >= row);
  const auto found =
      first_beyond<AreaBegin>(trace, first->step, end, [&](const AreaBegin& part) { return place(part) >= wanted; });
  return found && holds(found->event, pixel) ? found : std::nullopt;
}

/// From the whole picture to the area that was settled at the pixel.
std::vector<AreaThere> areas_around(const Asked& q) {
  std::vector<AreaThere> chain;
  const std::int64_t end = q.trace.size() + 1;
  for (auto area = next_event<AreaBegin>(q.trace, last_mark(q.trace), end); area && chain.size() < 64;
       area = quarter_with(q.trace, chain.back(), q.pixel)) {
    const auto decided = next_event<AreaDecide>(q.trace, area->step, end);
    if (!decided) break;
    chain.push_back({area->step, decided->step, area->event, decided->event});
    if (decided->event.what != AreaCase::subdivide) break;
  }
  return chain;
}

struct BinThere {
  std::int64_t step = 0;
  AreaBin bin{};
  std::size_t area = 0;  ///< in the chain
};

std::optional<std::int32_t> piece_of(const Asked& q, const FacetThere& there) {
  if (there.mark == 0 || there.rejected()) return std::nullopt;
  const auto make = next_of<PieceMake, AreaBegin>(q.trace, there.mark, next_mark(q.trace, there.mark));
  const auto made = make ? event_at<PieceMake>(q.trace, *make) : std::nullopt;
  return made ? std::optional(made->piece) : std::nullopt;
}

/// Of the facets that are drawn and cover the pixel, the nearest.
const FacetThere* nearest_over_pixel(const std::vector<FacetThere>& facets) {
  const FacetThere* nearest = nullptr;
  for (const FacetThere& there : facets)
    if (there.covers() && !there.rejected() && !there.away &&
        (!nearest || there.at->candidate.z < nearest->at->candidate.z))
      nearest = &there;
  return nearest;
}

/// The pieces that can be seen at the pixel: of the facet over it, or, where there is none, of all.
std::vector<std::int32_t> pieces_of(const Asked& q, const std::vector<FacetThere>& facets) {
  std::vector<std::int32_t> pieces;
  const FacetThere* over = nearest_over_pixel(facets);
  for (const FacetThere& there : facets) {
    if (over && &there != over) continue;
    if (const auto piece = piece_of(q, there)) pieces.push_back(*piece);
  }
  return pieces;
}

/// The last bin that the polygon was put into on the way down, if possible not "disjoint". The search goes upwards,
/// because the small areas around the pixel hold few polygons.
std::optional<BinThere> last_bin(const Asked& q, const std::vector<AreaThere>& chain,
                                 const std::vector<std::int32_t>& pieces) {
  for (std::size_t k = chain.size(); k-- > 0;) {
    std::optional<BinThere> last;
    const auto is_mine = [&](const AreaBin& bin) {
      return std::find(pieces.begin(), pieces.end(), bin.piece) != pieces.end();
    };
    for (auto bin = next_that<AreaBin>(q.trace, chain[k].begin, chain[k].decided, is_mine); bin;
         bin = next_that<AreaBin>(q.trace, bin->step, chain[k].decided, is_mine))
      if (!(last && bin->event.bin == Bin::disjoint)) last = BinThere{bin->step, bin->event, k};
    if (last) return last;
  }
  return std::nullopt;
}

std::string area_text(const AreaBegin& area) {
  return fmt::format("area {} (columns {} to {}, rows {} to {})", area.area, area.first_column, area.end_column - 1,
                     area.first_row, area.end_row - 1);
}

/// Depths that were compared in the last area: of this polygon and of the one that it was given to.
struct Depths {
  std::vector<std::pair<std::int64_t, PlaneDepth>> mine, its;
};
Depths depths_in(const Asked& q, const AreaThere& leaf, std::int32_t piece) {
  Depths depths;
  for (std::int64_t step = leaf.begin + 1; step < leaf.decided; ++step) {
    const auto depth = event_at<PlaneDepth>(q.trace, step);
    if (depth && depth->piece == piece) depths.mine.emplace_back(step, *depth);
    if (depth && depth->piece == leaf.decide.piece) depths.its.emplace_back(step, *depth);
  }
  return depths;
}

/// "is in front of it at all four corners", with ties said as such.
std::string before_at(const formulas::detail::AtCorners& held, const std::string& corners) {
  if (held.behind > 0) return fmt::format("was taken to be in front of it at {}", corners);
  if (held.tied == 0) return fmt::format("is in front of it at {}", corners);
  if (held.nearer == 0)
    return fmt::format("is exactly as near as it at {}, and is the one of the two that is painted", corners);
  return fmt::format("is in front of it at {} of the corners, and exactly as near at the others", held.nearer);
}

Verdict why_behind(Asked& q, const AreaThere& leaf, const BinThere& bin, const Visit& owner) {
  const bool surrounded = leaf.decide.what == AreaCase::front_surrounder;
  const std::string other = q.label(owner.shows);
  const Depths depths = depths_in(q, leaf, bin.bin.piece);
  if (depths.mine.empty() || depths.its.empty()) return not_recorded(q);
  Verdict verdict;
  if (surrounded) {
    double least = no_depth;
    formulas::detail::AtCorners held;
    for (std::size_t k = 0; k < std::min(depths.mine.size(), depths.its.size()); ++k)
      held.add(depths.its[k].second.z, depths.mine[k].second.z);
    const std::string corners = held.all() == 4 ? "all four corners" : "the corners where they were compared";
    verdict = q.verdict(Why::surrounded, leaf.decided,
                        fmt::format("{} surrounds {} and {}, so all of the area became {} without a look at this pixel",
                                    other, area_text(leaf.area), before_at(held, corners), other));
    verdict.other = owner.shows;
    for (std::size_t k = 0; k < std::min(depths.mine.size(), depths.its.size()); ++k) {
      const PlaneDepth &mine = depths.mine[k].second, &its = depths.its[k].second;
      verdict.formulas.push_back(fmt::format("at ({}, {}): {} of {} = {}, of {} = {}", number(mine.x_at),
                                             number(mine.y_at), q.z, q.name, told(mine.z), other, told(its.z)));
      least = std::min(least, mine.z - its.z);
    }
    verdict.gap = least;
    if (least < -1e-9 * std::max(1.0, std::abs(depths.its.front().second.z))) {
      verdict.kind = Why::contradicted;
      verdict.sentence +=
          fmt::format(" But at one of the corners {} is nearer by \u0394{} = {}.", q.name, q.z, told(-least));
    }
    verdict.formulas.push_back(fmt::format("at the corner where it comes nearest: \u0394{} = {}", q.z, told(least)));
  } else {
    const double z = depths.mine.back().second.z, its = depths.its.back().second.z;
    const bool tie = formulas::detail::equally_near(z, its);
    const bool nearer = z < its && !tie;  // and yet the other is painted
    verdict =
        nearer ? q.verdict(Why::contradicted, leaf.decided,
                           fmt::format("the area is this pixel alone, and at its centre it is nearer than {} by "
                                       "\u0394{} = {}, but the area is given to {}",
                                       other, q.z, told(its - z), other))
        : tie  ? q.verdict(Why::tie, leaf.decided,
                           fmt::format("at the pixel's centre it is exactly as near as {}, which {}", other,
                                       kept_in_tie(q.trace.header(), owner.shows < q.polygon, "is painted")))
               : q.verdict(Why::lost, leaf.decided,
                           fmt::format("the area is this pixel alone, and at its centre {} is nearer by \u0394{} = {}",
                                       other, q.z, told(z - its)));
    verdict.other = owner.shows, verdict.gap = z - its;
    verdict.formulas.push_back(difference(q.z, q.name, other, z, its));
  }
  verdict.chain.push_back({bin.step, q.polygon,
                           fmt::format("{} is {} in area {}", q.name,
                                       words_of<Bin>[static_cast<std::size_t>(bin.bin.bin)], leaf.area.area)});
  for (const auto& [step, depth] : depths.mine)
    verdict.chain.push_back(
        {step, q.polygon,
         fmt::format("{} at ({}, {}): {} = {}", q.name, number(depth.x_at), number(depth.y_at), q.z, told(depth.z))});
  for (const auto& [step, depth] : depths.its)
    verdict.chain.push_back(
        {step, owner.shows,
         fmt::format("{} at ({}, {}): {} = {}", other, number(depth.x_at), number(depth.y_at), q.z, told(depth.z))});
  verdict.chain.push_back({leaf.decided, owner.shows, fmt::format("area {} is given to {}", leaf.area.area, other)});
  verdict.chain.push_back({owner.written, owner.shows, fmt::format("the pixel becomes {}", other)});
  return verdict;
}

}  // namespace

bool of_areas(const Trace& trace) { return trace.has(kind_of<AreaBegin>); }

Verdict why_by_areas(Asked& q, const std::vector<FacetThere>& facets) {
  const std::vector<Visit> visits = visits_of(q.trace, q.pixel);
  const std::vector<AreaThere> chain = areas_around(q);
  const Visit* owner = holder(visits, q.trace.size() + 1);
  if (owner && owner->shows == q.polygon) {
    const std::string area = chain.empty() ? "its area" : area_text(chain.back().area);
    Verdict verdict = seen(
        q, owner->written,
        fmt::format("{} is filled with it{}", area, owner->z ? fmt::format(", {} = {}", q.z, told(*owner->z)) : ""),
        fmt::format("the pixel becomes {}", q.name));
    if (!chain.empty())
      verdict.chain.push_back(
          {chain.back().decided, q.polygon, fmt::format("area {} is given to {}", chain.back().area.area, q.name)});
    return verdict;
  }
  const auto bin = last_bin(q, chain, pieces_of(q, facets));
  auto verdict = why_by_facets(q, facets);
  const bool to_the_end = bin && bin->area + 1 == chain.size() && bin->bin.bin != Bin::disjoint;
  if (!verdict) {
    verdict = to_the_end && owner ? why_behind(q, chain.back(), *bin, *owner) : not_recorded(q);
    if (const FacetThere* over = nearest_over_pixel(facets)) verdict->facet = over->facet;
    return *verdict;
  }
  if (verdict->kind != Why::not_covered || !bin) return *verdict;

  const AreaThere& area = chain[bin->area];
  if (bin->bin.bin == Bin::disjoint) {
    verdict->kind = Why::apart;
    verdict->step = bin->step;
    verdict->sentence +=
        fmt::format(" It is disjoint from {}, so it is not looked at again in there.", area_text(area.area));
    q.add_formulas(*verdict, bin->step);
  } else {
    verdict->step = area.decided;
    verdict->sentence += fmt::format(" It reaches into {}, but not to this pixel's centre.", area_text(area.area));
  }
  verdict->chain.push_back({bin->step, q.polygon,
                            fmt::format("{} is {} in area {}", q.name,
                                        words_of<Bin>[static_cast<std::size_t>(bin->bin.bin)], area.area.area)});
  const AreaThere& leaf = chain.back();
  const auto given = [&]() -> std::string {
    if (owner) return "is given to " + q.label(owner->shows);
    return leaf.decide.what == AreaCase::background ? "stays background" : "is settled";
  };
  verdict->chain.push_back(
      {leaf.decided, owner ? owner->shows : no_polygon, fmt::format("area {} {}", leaf.area.area, given())});
  if (owner)
    verdict->other = owner->shows,
    verdict->chain.push_back(
        {owner->written, owner->shows, fmt::format("the pixel becomes {}", q.label(owner->shows))});
  return *verdict;
}

}  // namespace zstep::answers
