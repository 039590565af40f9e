// Wireframe, hidden lines and the floating horizon: a polygon is seen where one of its edges or curves is drawn.

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/answers/why_not_parts.hpp"
#include "sim/words/rejects.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"

namespace zstep::answers {
namespace {

/// An edge of the polygon, as the trace left it at its end.
struct DrawnEdge {
  LineRow row;
  OnRaster from, to;
};

bool is_edge_of(const Asked& q, const LineBegin& line) {
  return polygon_of_facet(q.scene, line.left_facet) == q.polygon ||
         polygon_of_facet(q.scene, line.right_facet) == q.polygon;
}

std::vector<DrawnEdge> lines_of(Asked& q) {
  const State& state = q.state_at(q.trace.size());
  std::vector<DrawnEdge> lines;
  for (const LineRow& row : state.machine.lines) {
    if (!is_edge_of(q, row.entry)) continue;
    const auto from = on_raster(q.scene, state, row.entry.vertex_0), to = on_raster(q.scene, state, row.entry.vertex_1);
    if (from && to) lines.push_back({row, *from, *to});
  }
  return lines;
}

/// Where work on it begins.
std::optional<std::int64_t> begin_of(const Asked& q, const DrawnEdge& line) {
  return numbered(q.trace, last_mark(q.trace), q.trace.size() + 1, &LineBegin::line, line.row.entry.line);
}

double nearest_pixel(double at) { return std::floor(at + 0.5); }

/// Where a line passes the pixel, 0 to 1 along it, by the rule of drawing: one pixel a column, or a row where it is
/// steep.
std::optional<double> passes(const DrawnEdge& line, Trace::Pixel pixel) {
  const double dx = line.to.x - line.from.x, dy = line.to.y - line.from.y;
  const bool steep = std::abs(dy) > std::abs(dx);
  const double from = steep ? line.from.y : line.from.x, along = steep ? dy : dx;
  const double beside = steep ? line.from.x : line.from.y, slope = (steep ? dx : dy) / along;
  const double at = steep ? pixel.y : pixel.x, across = steep ? pixel.x : pixel.y;
  if (along == 0) return std::nullopt;
  const double end_0 = nearest_pixel(from), end_1 = nearest_pixel(from + along);
  if (at < std::min(end_0, end_1) || at > std::max(end_0, end_1) ||
      nearest_pixel(beside + (at - from) * slope) != across)
    return std::nullopt;
  return (at - from) / along;
}

double distance_to(const DrawnEdge& line, Trace::Pixel pixel) {
  const double dx = line.to.x - line.from.x, dy = line.to.y - line.from.y, px = pixel.x - line.from.x,
               py = pixel.y - line.from.y;
  const double length = dx * dx + dy * dy, t = length > 0 ? std::clamp((px * dx + py * dy) / length, 0.0, 1.0) : 0;
  return portable::length(px - t * dx, py - t * dy);
}

/// How far t is from an interval of the line: ends are rounded to pixels, so it may be beside what is drawn there.
template <class Interval>
double off(const Interval& interval, double t) {
  return std::max({0.0, interval.t_0 - t, t - interval.t_1});
}
/// The nearest to t; of two as near a piece that is hidden.
const LinePiece* piece_at(const DrawnEdge& line, double t) {
  const LinePiece* best = nullptr;
  for (const LinePiece& piece : line.row.pieces)
    if (!best || off(piece, t) < off(*best, t) || (off(piece, t) == off(*best, t) && !piece.visible)) best = &piece;
  return best;
}

std::string name_of(const Asked& q, const LineBegin& line) {
  return fmt::format("edge {}\u2013{}", vertex_label(q.scene, line.vertex_0), vertex_label(q.scene, line.vertex_1));
}

std::int64_t step_of_piece(const Asked& q, std::int64_t begin, const LinePiece& wanted) {
  const auto found = next_before<LinePiece, LineBegin>(q.trace, begin, q.trace.size() + 1, [&](const LinePiece& piece) {
    return piece.t_0 == wanted.t_0 && piece.t_1 == wanted.t_1 && piece.visible == wanted.visible;
  });
  return found ? found->step : begin;
}

/// One of its edges was drawn through the pixel.
std::optional<Verdict> drawn(Asked& q) {
  std::optional<Verdict> verdict;
  for (auto step = next_color(q, 0); step; step = next_color(q, *step)) {
    const auto line = last_event<LineBegin>(q.trace, *step);
    const auto part = last_event<LinePiece>(q.trace, *step);
    if (!line || !part || !is_edge_of(q, line->event)) continue;
    const bool visible = part->event.visible;
    verdict = seen(q, *step,
                   fmt::format("its {} is drawn through it{}", name_of(q, line->event),
                               visible ? "" : ", dashed, as it is hidden there"),
                   "the pixel gets the colour of lines");
    q.add_formulas(*verdict, part->step);
    verdict->add_step(line->step, q.polygon, "work on the edge begins");
    verdict->add_step(part->step, q.polygon, "a piece of it that is {}", visible ? "visible" : "hidden");
    if (visible) break;
  }
  return verdict;
}

/// Where the pixel is along the edge. The ends of pieces are rounded to pixels, so it may lie a little beside what is
/// drawn there.
std::string place_text(double t, double from, double to) {
  const std::string place = fmt::format("at the pixel t = {} along the edge", number(std::clamp(t, 0.0, 1.0)));
  if (t < 0 || t > 1) return fmt::format("{}: its end is rounded to this pixel", place);
  return t < from || t > to
             ? fmt::format("{}: the end at t = {} is rounded to this pixel", place, number(t < from ? from : to))
             : place;
}

/// Do all polygons at the edge face away, or lie edge-on?
bool all_away(const Asked& q, const DrawnEdge& line) {
  for (const std::int32_t facet : {line.row.entry.left_facet, line.row.entry.right_facet}) {
    if (facet < 0 || facet >= std::ssize(q.scene.facets)) continue;
    if (!check_reject(q.scene, facet, Reject::back_facing, nullptr).holds) return false;
  }
  return true;
}

Verdict hidden(Asked& q, const DrawnEdge& line, const LinePiece& piece, double t) {
  const std::int64_t begin = begin_of(q, line).value_or(0);
  const std::int64_t part = begin > 0 ? step_of_piece(q, begin, piece) : 0;
  const auto by = std::min_element(line.row.hidden.begin(), line.row.hidden.end(),
                                   [&](const LineHide& a, const LineHide& b) { return off(a, t) < off(b, t); });
  const std::string name = name_of(q, line.row.entry);
  Verdict verdict;
  if (by == line.row.hidden.end()) {
    verdict = all_away(q, line)
                  ? q.verdict(Why::back_edge, part,
                              "its {} passes there, but all faces at it face away, so it is left out", name)
                  : q.verdict(Why::line_hidden, part,
                              "its {} passes there, but the trace takes this piece of it for hidden, and does not say "
                              "by what",
                              name);
    verdict.add_formula("{}", place_text(t, piece.t_0, piece.t_1));
  } else {
    const std::int32_t other = polygon_of_facet(q.scene, by->facet);
    verdict = q.verdict(Why::line_hidden, part, "its {} passes there, but {} hides it from t = {} to t = {}", name,
                        q.label(other), number(by->t_0), number(by->t_1));
    verdict.other = other;
    const auto is_it = [&](const LineHide& hide) { return hide.facet == by->facet && hide.t_0 == by->t_0; };
    if (const auto hide = next_before<LineHide, LineBegin>(q.trace, begin, q.trace.size() + 1, is_it)) {
      verdict.step = hide->step;
      q.add_formulas(verdict, hide->step);
      verdict.add_step(hide->step, other, "{} hides an interval of the edge", q.label(other));
    }
    verdict.add_formula("{}", place_text(t, by->t_0, by->t_1));
  }
  verdict.add_step(begin, q.polygon, "work on {} begins", name);
  verdict.add_step(part, q.polygon, "a piece of it that is hidden");
  return verdict;
}

}  // namespace

bool of_lines(const Trace& trace) { return trace.has(kind_of<LineBegin>); }

Verdict why_by_lines(Asked& q) {
  if (auto verdict = drawn(q)) return *verdict;
  const std::vector<DrawnEdge> lines = lines_of(q);
  if (lines.empty()) {
    const std::vector<FacetThere> facets = facets_there(q);
    const bool any =
        std::any_of(facets.begin(), facets.end(), [](const FacetThere& there) { return there.at || there.cut_at; });
    return q.verdict(any ? Why::not_covered : Why::outside, 0, "none of its edges is in view");
  }
  const DrawnEdge* nearest = nullptr;
  for (const DrawnEdge& line : lines) {
    if (!nearest || distance_to(line, q.pixel) < distance_to(*nearest, q.pixel)) nearest = &line;
    const auto t = passes(line, q.pixel);
    const LinePiece* piece = t ? piece_at(line, *t) : nullptr;
    if (piece && !piece->visible) return hidden(q, line, *piece, *t);
  }
  const std::int64_t begin = begin_of(q, *nearest).value_or(0);
  Verdict verdict = q.verdict(Why::not_covered, begin,
                              "only edges are drawn, and the nearest of its own, {}, passes {} pixels from the centre",
                              name_of(q, nearest->row.entry), number(distance_to(*nearest, q.pixel)));
  verdict.add_step(begin, q.polygon, "work on {} begins", name_of(q, nearest->row.entry));
  return verdict;
}

Verdict lines_anywhere(Asked& q) {
  const std::vector<DrawnEdge> lines = lines_of(q);
  std::size_t seen_edges = 0;
  const DrawnEdge *visible = nullptr, *hidden = nullptr;
  for (const DrawnEdge& line : lines) {
    const bool any = std::any_of(line.row.pieces.begin(), line.row.pieces.end(),
                                 [](const LinePiece& piece) { return piece.visible; });
    if (any) visible = visible ? visible : &line, ++seen_edges;
    else hidden = hidden ? hidden : &line;
  }
  const DrawnEdge* picked = visible ? visible : hidden;
  if (!picked) q.ask_anywhere();
  if (!picked) return why_by_lines(q);
  // A pixel on it: the first that was drawn, or for one that was not the middle of the edge.
  const std::int64_t begin = begin_of(q, *picked).value_or(0);
  Trace::Pixel pixel{nearest_int((picked->from.x + picked->to.x) / 2),
                     nearest_int((picked->from.y + picked->to.y) / 2)};
  const auto any = [](const ColorWrite&) { return true; };
  if (const auto color = next_before<ColorWrite, LineBegin>(q.trace, begin, q.trace.size() + 1, any))
    pixel = {color->event.x, color->event.y};
  pixel.x = std::clamp(pixel.x, 0, q.scene.raster.width - 1),
  pixel.y = std::clamp(pixel.y, 0, q.scene.raster.height - 1);
  const std::string edges = count_text(lines.size(), "edge", "edges");
  return with_pixel(q, pixel,
                    visible
                        ? fmt::format("Of the {} of {} in view, {} seen, in whole or in part. On one of them:", edges,
                                      q.name, seen_edges == 1 ? "one is" : fmt::format("{} are", seen_edges))
                        : fmt::format("None of the {} of {} in view is seen. On one of them:", edges, q.name));
}

// The floating horizon: a polygon is a cell of the surface, and is seen where one of the curves along its border is.

namespace {

/// A piece of a curve along the polygon's border: the step of its curve_segment and the one at which it ends.
struct Segment {
  std::int64_t begin = 0, end = 0;
  CurveSegment ends{};
};

std::set<std::int32_t> corners_of(const Asked& q, std::int32_t polygon) {
  std::set<std::int32_t> corners;
  for (const Facet& facet : q.scene.facets) {
    if (facet.polygon != polygon) continue;
    for (std::int32_t k = 0; k < facet.corner_count; ++k) corners.insert(q.scene.corners[facet.first_corner + k]);
  }
  return corners;
}

/// A side of the cell, not its diagonal.
bool is_side(const Asked& q, const std::set<std::int32_t>& corners, const CurveSegment& segment) {
  if (!corners.contains(segment.vertex_0) || !corners.contains(segment.vertex_1)) return false;
  const std::int32_t apart = std::abs(segment.vertex_0 - segment.vertex_1);
  return !q.scene.surface || apart == 1 || apart == q.scene.surface->columns;
}

/// Whose curve a step belongs to: the first cell that has the segment as a side.
std::int32_t owner_of(const Asked& q, std::int64_t step) {
  const auto segment = last_event<CurveSegment>(q.trace, step);
  if (!segment || !q.scene.surface) return no_polygon;
  for (const Facet& facet : q.scene.facets) {
    int found = 0;
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const std::int32_t corner = q.scene.corners[facet.first_corner + k];
      found += corner == segment->event.vertex_0 || corner == segment->event.vertex_1;
    }
    if (found == 2 && facet.polygon != q.polygon) return facet.polygon;
  }
  return no_polygon;
}

/// A curve in the pixel's column.
struct There : Found<HorizonTest> {
  double low = 0, high = 0;  ///< rows that it passes within the column
  bool hides(std::int32_t row) const {
    return event.verdict == Horizon::hidden && low - 0.5 <= row && row <= high + 0.5;
  }
};

std::vector<There> tests_in_column(const Asked& q, const Segment& segment) {
  std::vector<There> all;
  const auto tests =
      all_that<HorizonTest>(q.trace, segment.begin, segment.end, [](const HorizonTest&) { return true; });
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const HorizonTest& test = tests[k].event;
    if (test.x != q.pixel.x) continue;
    There there{tests[k], test.y_curve, test.y_curve};
    for (const std::size_t next : {k - 1, k + 1}) {  // k - 1 of 0 is beyond the end
      if (next >= tests.size() || std::abs(tests[next].event.x - test.x) != 1) continue;
      const double halfway = (test.y_curve + tests[next].event.y_curve) / 2;
      there.low = std::min(there.low, halfway), there.high = std::max(there.high, halfway);
    }
    all.push_back(there);
  }
  return all;
}

void add_curve(const Asked& q, Verdict& verdict, const Segment& segment) {
  verdict.add_step(segment.begin, q.polygon, "the curve from sample {} to sample {}", segment.ends.vertex_0,
                   segment.ends.vertex_1);
}

std::optional<Verdict> drawn(Asked& q, const Segment& segment) {
  const auto step = next_color(q, segment.begin, segment.end);
  if (!step) return std::nullopt;
  Verdict verdict =
      seen(q, *step, "a curve along its border is drawn through it", "the pixel gets the colour of curves");
  add_curve(q, verdict, segment);
  if (const auto test = last_event<HorizonTest>(q.trace, *step, segment.begin)) {
    verdict.add_step(test->step, q.polygon, "the curve is held against the horizons of its column");
    q.add_formulas(verdict, test->step);
  }
  return verdict;
}

Verdict hidden(Asked& q, const Segment& segment, const There& there) {
  Verdict verdict = q.verdict(Why::horizon, there.step,
                              "its curve passes there at y = {}, but it is hidden by the horizons of column {}",
                              number(there.event.y_curve), q.pixel.x);
  q.add_formulas(verdict, there.step);
  if (const auto moved = last_that<HorizonMove>(q.trace, there.step, 0, [&](const HorizonMove& move) {
        return move.x == q.pixel.x && std::isfinite(move.y_curve);
      })) {
    verdict.other = owner_of(q, moved->step);
    verdict.add_step(moved->step, verdict.other, "a nearer curve moves a horizon of column {} to y = {}", q.pixel.x,
                     number(moved->event.y_curve));
  }
  add_curve(q, verdict, segment);
  verdict.add_step(there.step, q.polygon, "its point in this column is hidden");
  return verdict;
}

std::vector<Segment> segments_of(const Asked& q) {
  const std::set<std::int32_t> corners = corners_of(q, q.polygon);
  const std::int64_t end = q.trace.size() + 1;
  std::vector<Segment> segments;
  for (const auto& [step, ends] : all_that<CurveSegment>(
           q.trace, 0, end, [&](const CurveSegment& segment) { return is_side(q, corners, segment); }))
    segments.push_back({step, next_of<CurveSegment, CurveBegin>(q.trace, step, end).value_or(end), ends});
  return segments;
}

}  // namespace

bool of_curves(const Trace& trace) { return trace.has(kind_of<HorizonTest>); }

Verdict why_by_curves(Asked& q) {
  const std::vector<Segment> segments = segments_of(q);
  for (const Segment& segment : segments)
    if (auto verdict = drawn(q, segment)) return *verdict;
  std::optional<Verdict> last;
  std::string rows;
  for (const Segment& segment : segments)
    for (const There& there : tests_in_column(q, segment)) {
      rows += (rows.empty() ? "" : ", ") + number(there.event.y_curve);
      if (there.hides(q.pixel.y)) last = hidden(q, segment, there);
    }
  if (last) return *last;
  const std::int64_t step = segments.empty() ? 0 : segments.front().begin;
  Verdict verdict =
      rows.empty()
          ? q.verdict(Why::not_covered, step, "only curves are drawn, and none along its border meets column {}",
                      q.pixel.x)
          : q.verdict(Why::not_covered, step,
                      "only curves are drawn, and those along its border pass column {} at y = {}", q.pixel.x, rows);
  for (const Segment& segment : segments) add_curve(q, verdict, segment);
  return verdict;
}

Verdict curves_anywhere(Asked& q) {
  std::size_t visible = 0, hidden = 0;
  std::optional<Trace::Pixel> drawn, behind;
  for (const Segment& segment : segments_of(q))
    for (std::int64_t step = segment.begin + 1; step < segment.end; ++step) {
      if (const auto color = event_at<ColorWrite>(q.trace, step); color && !drawn)
        drawn = Trace::Pixel{color->x, color->y};
      const auto test = event_at<HorizonTest>(q.trace, step);
      if (!test) continue;
      (test->verdict == Horizon::hidden ? hidden : visible) += 1;
      const auto row =
          static_cast<std::int32_t>(std::clamp(std::round(test->y_curve), 0.0, q.scene.raster.height - 1.0));
      if (test->verdict == Horizon::hidden && !behind)
        behind = Trace::Pixel{std::clamp(test->x, 0, q.scene.raster.width - 1), row};
    }
  const std::string whole = fmt::format("Of the {} of the curves around {}, {} visible and {} hidden.",
                                        count_text(visible + hidden, "point", "points"), q.name, visible, hidden);
  return with_pixel(q, drawn ? *drawn : behind.value_or(q.pixel), whole);
}

}  // namespace zstep::answers
