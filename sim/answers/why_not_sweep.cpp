// The scan-line method: was the polygon's flag in at the pixel, and who was in front on the interval around it?
#include <algorithm>
#include <cmath>

#include "sim/answers/why_not_parts.hpp"
#include "traces/file/records.hpp"
#include "traces/formulas/outlines.hpp"

namespace zstep::answers {
namespace {

struct Row {
  std::int64_t step = 0;
  PlaneEquation plane{};
  std::int32_t piece = -1;
};

/// The polygon's rows of the polygon table.
std::vector<Row> rows_of(const Asked& q, const std::vector<FacetThere>& facets) {
  std::vector<Row> rows;
  for (const FacetThere& there : facets) {
    if (there.mark == 0 || there.rejected()) continue;
    const std::int64_t end = next_mark(q.trace, there.mark);
    const auto make = next_of<PieceMake, EdgeTableInsert, ScanLineBegin>(q.trace, there.mark, end);
    const auto made = make ? event_at<PieceMake>(q.trace, *make) : std::nullopt;
    const auto plane = made ? next_of<PlaneEquation>(q.trace, *make, end) : std::nullopt;
    if (plane) rows.push_back({*make, *event_at<PlaneEquation>(q.trace, *plane), made->piece});
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

Line look_along(Asked& q, const std::vector<Row>& rows) {
  Line line;
  const std::int64_t end_of_all = q.trace.size() + 1;
  const auto begin = numbered(q.trace, last_mark(q.trace), end_of_all, &ScanLineBegin::y, q.pixel.y);
  if (!begin) return line;
  const auto is_mine = [&](std::int32_t piece) {
    return std::any_of(rows.begin(), rows.end(), [piece](const Row& row) { return row.piece == piece; });
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
  verdict.chain.push_back(
      {line.winner, line.owner, fmt::format("{} is the frontmost on this interval", q.label(line.owner))});
  verdict.chain.push_back(
      {line.paint, line.owner, fmt::format("the pixel becomes {}, {} = {}", q.label(line.owner), q.z, told(line.z))});
}

Verdict why_behind(Asked& q, const Line& line, const std::vector<Row>& rows) {
  const Row& row =
      *std::find_if(rows.begin(), rows.end(), [&](const Row& one) { return one.piece == line.in.front(); });
  const PlaneEquation& p = row.plane;
  const double z = formulas::plane_depth(p, q.pixel.x, q.pixel.y), gap = z - line.z;
  const std::string other = q.label(line.owner);
  // As the method has it: planes that slant give large numbers that cancel.
  const double rounding = 2e-13 *
                          (std::abs(p.plane_a * q.pixel.x) + std::abs(p.plane_b * q.pixel.y) + std::abs(p.plane_d)) /
                          std::abs(p.plane_c);
  const bool tie = std::abs(gap) <= rounding;
  const bool nearer = gap < 0 && !tie;  // and yet the other is painted
  Verdict verdict = q.verdict(
      tie      ? Why::tie
      : nearer ? Why::contradicted
               : Why::lost,
      line.winner != 0 ? line.winner : line.paint,
      nearer ? fmt::format("its flag is in and its plane is nearer than {} by \u0394{} = {}, but {} is painted", other,
                           q.z, told(-gap), other)
      : tie  ? fmt::format("its flag is in, but it is as near as {} to rounding, and {} {}", other, other,
                           kept_in_tie(q.trace.header(), line.owner < q.polygon, "is painted"))
             : fmt::format("its flag is in, but {} is in front on this interval of the line, here by \u0394{} = {}",
                           other, q.z, told(gap)));
  verdict.other = line.owner, verdict.gap = gap;
  verdict.formulas.push_back(fmt::format(
      "{} of {} = \u2212(A x + B y + D)/C = \u2212({}\u00b7{} + {}\u00b7{} + {})/{} = {}", q.z, q.name,
      factor(p.plane_a), q.pixel.x, factor(p.plane_b), q.pixel.y, number(p.plane_d), factor(p.plane_c), told(z)));
  verdict.formulas.push_back(difference(q.z, q.name, other, z, line.z));
  verdict.chain.push_back({line.flip_before, q.polygon, fmt::format("the flag of {} turns to in", q.name)});
  verdict.chain.push_back({line.interval, no_polygon, "the interval of the line around the pixel"});
  verdict.chain.insert(verdict.chain.end(), line.links.begin(), line.links.end());
  add_paint(q, verdict, line);
  return verdict;
}

/// Beside the pixel, in the scan line's own words.
void tell_flag(Asked& q, Verdict& verdict, const Line& line) {
  verdict.kind = Why::flag_out;
  const std::string row = fmt::format("On scan line {}", q.pixel.y);
  verdict.step = line.flip_before != 0 ? line.flip_before : line.flip_after;
  verdict.sentence += line.flip_before != 0 ? fmt::format(" {} its flag is out again at the pixel.", row)
                      : line.flip_after != 0
                          ? fmt::format(" {} its flag turns to in only beyond the pixel.", row)
                          : fmt::format(" {} none of its edges is active, so its flag stays out.", row);
  if (verdict.step != 0) {
    verdict.chain.push_back({verdict.step, q.polygon,
                             fmt::format("the flag of {} turns to {}", q.name, line.flip_before != 0 ? "out" : "in")});
  }
  if (line.interval != 0)
    verdict.chain.push_back({line.interval, no_polygon, "the interval of the line at or beyond the pixel"});
  add_paint(q, verdict, line);
  verdict.other = line.owner;
}

}  // namespace

bool of_sweep(const Trace& trace) {
  return trace.has(kind_of<FlagFlip>) && depth_buffer(trace.header()) != DepthBuffer::line;
}

Verdict why_by_sweep(Asked& q, const std::vector<FacetThere>& facets) {
  const std::vector<Row> rows = rows_of(q, facets);
  const Line line = look_along(q, rows);
  if (line.paint != 0 && line.owner == q.polygon) {
    Verdict verdict =
        seen(q, line.paint,
             fmt::format("it is the frontmost on its interval of scan line {}, {} = {}", q.pixel.y, q.z, told(line.z)),
             fmt::format("the pixel becomes {}", q.name));
    verdict.chain.push_back({line.winner, q.polygon, fmt::format("{} is the frontmost on this interval", q.name)});
    return verdict;
  }
  if (line.cover != 0) {
    Verdict verdict = q.verdict(Why::mixed, line.cover, "");
    verdict.sentence = fmt::format(
        "{} is a part of what is seen {}: it is seen on {} % of the pixel's area, though not at its centre.", q.name,
        q.where, number(100 * line.share));
    verdict.other = line.owner;
    q.add_formulas(verdict, line.cover);
    verdict.chain.push_back({line.cover, q.polygon, fmt::format("{} is mixed in by its share", q.name)});
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
