// Methods that go by areas and intervals. Warnock: the chain of areas around the pixel, the polygon's bin in each, and
// who the last one was given to. Scan line: was the polygon's flag in at the pixel, and who was in front around it?

#include <algorithm>
#include <cmath>

#include "sim/answers/why_not_parts.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/of_areas.hpp"
#include "traces/formulas/outlines.hpp"

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

/// The piece that a facet became, before other work begins.
template <class... Other>
std::optional<Found<PieceMake>> piece_of(const Asked& q, const FacetThere& there) {
  if (there.mark == 0 || there.rejected()) return std::nullopt;
  const auto any = [](const PieceMake&) { return true; };
  return next_before<PieceMake, Other...>(q.trace, there.mark, next_mark(q.trace, there.mark), any);
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
    if (const auto piece = piece_of<AreaBegin>(q, there)) pieces.push_back(piece->event.piece);
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
    for (const auto& [step, bin] : all_that<AreaBin>(q.trace, chain[k].begin, chain[k].decided, is_mine))
      if (!(last && bin.bin == Bin::disjoint)) last = BinThere{step, bin, k};
    if (last) return last;
  }
  return std::nullopt;
}

std::string area_text(const AreaBegin& area) {
  return fmt::format("area {} (columns {} to {}, rows {} to {})", area.area, area.first_column, area.end_column - 1,
                     area.first_row, area.end_row - 1);
}

/// Depths of a piece that were compared in the last area.
std::vector<Found<PlaneDepth>> depths_in(const Asked& q, const AreaThere& leaf, std::int32_t piece) {
  return all_that<PlaneDepth>(q.trace, leaf.begin, leaf.decided,
                              [&](const PlaneDepth& depth) { return depth.piece == piece; });
}
void add_depths(const Asked& q, Verdict& verdict, const std::vector<Found<PlaneDepth>>& depths, std::int32_t of) {
  for (const auto& [step, depth] : depths)
    verdict.add_step(step, of, "{} at ({}, {}): {} = {}", q.label(of), number(depth.x_at), number(depth.y_at), q.z,
                     told(depth.z));
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
  const auto of_mine = depths_in(q, leaf, bin.bin.piece), of_its = depths_in(q, leaf, leaf.decide.piece);
  if (of_mine.empty() || of_its.empty()) return not_recorded(q);
  Verdict verdict;
  if (surrounded) {
    double least = no_depth;
    formulas::detail::AtCorners held;
    const std::size_t compared = std::min(of_mine.size(), of_its.size());
    for (std::size_t k = 0; k < compared; ++k) held.add(of_its[k].event.z, of_mine[k].event.z);
    const std::string corners = held.all() == 4 ? "all four corners" : "the corners where they were compared";
    verdict = q.verdict(Why::surrounded, leaf.decided,
                        "{} surrounds {} and {}, so all of the area became {} without a look at this pixel", other,
                        area_text(leaf.area), before_at(held, corners), other);
    verdict.other = owner.shows;
    for (std::size_t k = 0; k < compared; ++k) {
      const PlaneDepth &mine = of_mine[k].event, &its = of_its[k].event;
      verdict.add_formula("at ({}, {}): {} of {} = {}, of {} = {}", number(mine.x_at), number(mine.y_at), q.z, q.name,
                          told(mine.z), other, told(its.z));
      least = std::min(least, mine.z - its.z);
    }
    verdict.gap = least;
    if (least < -1e-9 * std::max(1.0, std::abs(of_its.front().event.z))) {
      verdict.kind = Why::contradicted;
      verdict.say(" But at one of the corners {} is nearer by \u0394{} = {}.", q.name, q.z, told(-least));
    }
    verdict.add_formula("at the corner where it comes nearest: \u0394{} = {}", q.z, told(least));
  } else {
    const double z = of_mine.back().event.z, its = of_its.back().event.z;
    const bool tie = formulas::detail::equally_near(z, its);
    verdict =
        tie ? q.verdict(Why::tie, leaf.decided, "at the pixel's centre it is exactly as near as {}, which {}", other,
                        kept_in_tie(q.trace.header(), owner.shows < q.polygon, "is painted"))
        : z < its  // and yet the other is painted
            ? q.verdict(Why::contradicted, leaf.decided,
                        "the area is this pixel alone, and at its centre it is nearer than {} by \u0394{} = {}, but "
                        "the area is given to {}",
                        other, q.z, told(its - z), other)
            : q.verdict(Why::lost, leaf.decided,
                        "the area is this pixel alone, and at its centre {} is nearer by \u0394{} = {}", other, q.z,
                        told(z - its));
    verdict.other = owner.shows, verdict.gap = z - its;
    verdict.add_formula("{}", difference(q.z, q.name, other, z, its));
  }
  verdict.add_step(bin.step, q.polygon, "{} is {} in area {}", q.name, word_of(bin.bin.bin), leaf.area.area);
  add_depths(q, verdict, of_mine, q.polygon);
  add_depths(q, verdict, of_its, owner.shows);
  verdict.add_step(leaf.decided, owner.shows, "area {} is given to {}", leaf.area.area, other);
  verdict.add_step(owner.written, owner.shows, "the pixel becomes {}", other);
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
    const std::string z = owner->z ? fmt::format(", {} = {}", q.z, told(*owner->z)) : "";
    Verdict verdict = seen(q, owner->written, fmt::format("{} is filled with it{}", area, z));
    if (!chain.empty())
      verdict.add_step(chain.back().decided, q.polygon, "area {} is given to {}", chain.back().area.area, q.name);
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
    verdict->say(" It is disjoint from {}, so it is not looked at again in there.", area_text(area.area));
    q.add_formulas(*verdict, bin->step);
  } else {
    verdict->step = area.decided;
    verdict->say(" It reaches into {}, but not to this pixel's centre.", area_text(area.area));
  }
  verdict->add_step(bin->step, q.polygon, "{} is {} in area {}", q.name, word_of(bin->bin.bin), area.area.area);
  const AreaThere& leaf = chain.back();
  if (owner) {
    verdict->other = owner->shows;
    verdict->add_step(leaf.decided, owner->shows, "area {} is given to {}", leaf.area.area, q.label(owner->shows));
    verdict->add_step(owner->written, owner->shows, "the pixel becomes {}", q.label(owner->shows));
  } else {
    verdict->add_step(leaf.decided, no_polygon, "area {} {}", leaf.area.area,
                      leaf.decide.what == AreaCase::background ? "stays background" : "is settled");
  }
  return *verdict;
}

// The scan-line method: was the polygon's flag in at the pixel, and who was in front on the interval around it?

namespace {

/// The polygon's rows of the polygon table.
std::vector<PlaneEquation> rows_of(const Asked& q, const std::vector<FacetThere>& facets) {
  std::vector<PlaneEquation> rows;
  for (const FacetThere& there : facets) {
    const auto made = piece_of<EdgeTableInsert, ScanLineBegin>(q, there);
    if (!made) continue;
    if (auto plane = next_event<PlaneEquation>(q.trace, made->step, next_mark(q.trace, there.mark))) {
      plane->event.piece = made->event.piece;
      rows.push_back(plane->event);
    }
  }
  return rows;
}

/// What the sweep along the pixel's line did, as far as it matters here.
struct Line {
  std::int64_t interval = 0, winner = 0, paint = 0, cover = 0;  ///< steps, 0 where there is none
  std::int64_t flip_before = 0, flip_after = 0;                 ///< of the polygon, next to the pixel
  std::vector<std::int32_t> in;                                 ///< the polygon's pieces whose flag is in there
  std::int32_t owner = no_polygon;
  double z = 0, share = 0;
  std::vector<Link> links;  ///< depths and implied edges on the interval
};

Line look_along(Asked& q, const std::vector<PlaneEquation>& rows) {
  Line line;
  const std::int64_t end_of_all = q.trace.size() + 1;
  const auto begin = numbered(q.trace, last_mark(q.trace), end_of_all, &ScanLineBegin::y, q.pixel.y);
  if (!begin) return line;
  const auto is_mine = [&](std::int32_t piece) {
    return std::any_of(rows.begin(), rows.end(), [piece](const PlaneEquation& row) { return row.piece == piece; });
  };
  const std::int64_t end = next_of<ScanLineBegin>(q.trace, *begin, end_of_all).value_or(end_of_all);
  const std::int32_t x = q.pixel.x;
  bool on_interval = false;
  for (std::int64_t step = *begin + 1; step < end; ++step) {
    const Event& event = q.trace.event(step).event;
    if (const auto* flip = get_if<FlagFlip>(&event)) {
      on_interval = false;
      if (!is_mine(flip->piece)) continue;
      if (line.interval == 0) {
        line.flip_before = step;
        std::erase(line.in, flip->piece);
        if (flip->inside) line.in.push_back(flip->piece);
      } else if (line.flip_after == 0) {
        line.flip_after = step;
      }
    } else if (const auto* flags = get_if<SpanFlags>(&event)) {
      on_interval = flags->first <= x && x <= flags->last;
      if (on_interval) line.interval = step;
      // Passed without an interval around the pixel: the flags from here on lie to its right.
      if (!on_interval && line.interval == 0 && flags->first > x) line.interval = step, line.in.clear();
    } else if (const auto* depth = get_if<PlaneDepth>(&event); depth && on_interval) {
      if (is_mine(depth->piece))
        line.links.push_back(
            {step, q.polygon, fmt::format("{} at x = {}: {} = {}", q.name, number(depth->x_at), q.z, told(depth->z))});
    } else if (holds<ImpliedEdge>(event) && on_interval) {
      line.links.push_back({step, no_polygon, "two penetrate each other: an implied edge"});
    } else if (const auto* winner = get_if<SpanWinner>(&event);
               winner && on_interval && winner->first <= x && x <= winner->last) {
      line.winner = step;
    } else if (const auto* paint = get_if<PixelPaint>(&event); paint && paint->x == x) {
      line.paint = step, line.owner = paint->polygon, line.z = paint->z;
    } else if (const auto* cover = get_if<CoverageAdd>(&event); cover && cover->x == x && cover->owner == q.polygon) {
      line.cover = step, line.share = cover->coverage;
    }
  }
  return line;
}

void add_paint(const Asked& q, Verdict& verdict, const Line& line) {
  if (line.paint == 0) return;
  verdict.add_step(line.winner, line.owner, "{} is the frontmost on this interval", q.label(line.owner));
  verdict.add_step(line.paint, line.owner, "the pixel becomes {}, {} = {}", q.label(line.owner), q.z, told(line.z));
}

Verdict why_behind(Asked& q, const Line& line, const std::vector<PlaneEquation>& rows) {
  const PlaneEquation& p =
      *std::find_if(rows.begin(), rows.end(), [&](const PlaneEquation& row) { return row.piece == line.in.front(); });
  const double z = formulas::plane_depth(p, q.pixel.x, q.pixel.y), gap = z - line.z;
  const std::string other = q.label(line.owner);
  // As the method has it: planes that slant give large numbers that cancel.
  const double rounding = 2e-13 *
                          (std::abs(p.plane_a * q.pixel.x) + std::abs(p.plane_b * q.pixel.y) + std::abs(p.plane_d)) /
                          std::abs(p.plane_c);
  const std::int64_t decided = line.winner != 0 ? line.winner : line.paint;
  Verdict verdict =
      std::abs(gap) <= rounding
          ? q.verdict(Why::tie, decided, "its flag is in, but it is as near as {} to rounding, and {} {}", other, other,
                      kept_in_tie(q.trace.header(), line.owner < q.polygon, "is painted"))
      : gap < 0  // and yet the other is painted
          ? q.verdict(Why::contradicted, decided,
                      "its flag is in and its plane is nearer than {} by \u0394{} = {}, but {} is painted", other, q.z,
                      told(-gap), other)
          : q.verdict(Why::lost, decided,
                      "its flag is in, but {} is in front on this interval of the line, here by \u0394{} = {}", other,
                      q.z, told(gap));
  verdict.other = line.owner, verdict.gap = gap;
  verdict.add_formula("{} of {} = \u2212(A x + B y + D)/C = \u2212({}\u00b7{} + {}\u00b7{} + {})/{} = {}", q.z, q.name,
                      factor(p.plane_a), q.pixel.x, factor(p.plane_b), q.pixel.y, number(p.plane_d), factor(p.plane_c),
                      told(z));
  verdict.add_formula("{}", difference(q.z, q.name, other, z, line.z));
  verdict.add_step(line.flip_before, q.polygon, "the flag of {} turns to in", q.name);
  verdict.add_step(line.interval, no_polygon, "the interval of the line around the pixel");
  verdict.chain.insert(verdict.chain.end(), line.links.begin(), line.links.end());
  add_paint(q, verdict, line);
  return verdict;
}

/// Beside the pixel, in the scan line's own words.
void tell_flag(Asked& q, Verdict& verdict, const Line& line) {
  verdict.kind = Why::flag_out;
  const bool before = line.flip_before != 0;
  verdict.step = before ? line.flip_before : line.flip_after;
  verdict.say(" On scan line {} {}.", q.pixel.y,
              before              ? "its flag is out again at the pixel"
              : verdict.step != 0 ? "its flag turns to in only beyond the pixel"
                                  : "none of its edges is active, so its flag stays out");
  verdict.add_step(verdict.step, q.polygon, "the flag of {} turns to {}", q.name, before ? "out" : "in");
  verdict.add_step(line.interval, no_polygon, "the interval of the line at or beyond the pixel");
  add_paint(q, verdict, line);
  verdict.other = line.owner;
}

}  // namespace

bool of_sweep(const Trace& trace) {
  return trace.has(kind_of<FlagFlip>) && depth_buffer(trace.header()) != DepthBuffer::line;
}

Verdict mixed_by_share(Asked& q, std::int64_t step, double share) {
  Verdict verdict = q.verdict(Why::mixed, step, "it is seen on {} % of the pixel's area, though not at its centre",
                              number(100 * share));
  q.add_formulas(verdict, step);
  verdict.add_step(step, q.polygon, "{} is mixed in by its share", q.name);
  return verdict;
}

Verdict why_by_sweep(Asked& q, const std::vector<FacetThere>& facets) {
  const std::vector<PlaneEquation> rows = rows_of(q, facets);
  const Line line = look_along(q, rows);
  if (line.paint != 0 && line.owner == q.polygon) {
    Verdict verdict =
        seen(q, line.paint,
             fmt::format("it is the frontmost on its interval of scan line {}, {} = {}", q.pixel.y, q.z, told(line.z)));
    verdict.add_step(line.winner, q.polygon, "{} is the frontmost on this interval", q.name);
    return verdict;
  }
  if (line.cover != 0) {
    Verdict verdict = mixed_by_share(q, line.cover, line.share);
    verdict.other = line.owner;
    add_paint(q, verdict, line);
    return verdict;
  }
  if (!line.in.empty() && line.paint != 0) return why_behind(q, line, rows);
  auto verdict = why_by_facets(q, facets);
  if (!verdict) return not_recorded(q);
  if (verdict->kind == Why::not_covered && !rows.empty()) tell_flag(q, *verdict, line);
  return *verdict;
}

}  // namespace zstep::answers
