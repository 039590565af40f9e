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

/// The piece of a line at t; ends are rounded to pixels, so the nearest where none holds t.
const LinePiece* piece_at(const DrawnEdge& line, double t) {
  const LinePiece* best = nullptr;
  const auto off = [t](const LinePiece& piece) { return std::max({0.0, piece.t_0 - t, t - piece.t_1}); };
  for (const LinePiece& piece : line.row.pieces)
    if (!best || off(piece) < off(*best) || (off(piece) == off(*best) && !piece.visible)) best = &piece;
  return best;
}

std::string name_of(const Asked& q, const DrawnEdge& line) {
  return fmt::format("edge {}{}{}", vertex_label(q.scene, line.row.entry.vertex_0), "\u2013",
                     vertex_label(q.scene, line.row.entry.vertex_1));
}

std::int64_t step_of_piece(const Asked& q, std::int64_t begin, const LinePiece& wanted) {
  const auto step = next_within(q.trace, begin, q.trace.size() + 1, [&](const RecordedEvent& recorded) {
    const auto* piece = get_if<LinePiece>(&recorded.event);
    return (piece && piece->t_0 == wanted.t_0 && piece->t_1 == wanted.t_1 && piece->visible == wanted.visible) ||
           is_one_of<LineBegin>(recorded);
  });
  return step && event_at<LinePiece>(q.trace, *step) ? *step : begin;
}

/// One of its edges was drawn through the pixel.
std::optional<Verdict> drawn(Asked& q) {
  const auto here = [&](const RecordedEvent& recorded) {
    const auto* color = get_if<ColorWrite>(&recorded.event);
    return color && color->x == q.pixel.x && color->y == q.pixel.y;
  };
  std::optional<Verdict> verdict;
  for (auto step = q.trace.next(0, here, q.pixel); step; step = q.trace.next(*step, here, q.pixel)) {
    const auto begin = previous_of<LineBegin>(q.trace, *step), part = previous_of<LinePiece>(q.trace, *step);
    if (!begin || !part) continue;
    const LineBegin line = *event_at<LineBegin>(q.trace, *begin);
    if (!is_edge_of(q, line)) continue;
    const LinePiece piece = *event_at<LinePiece>(q.trace, *part);
    verdict =
        seen(q, *step,
             fmt::format("its edge {}\u2013{} is drawn through it{}", vertex_label(q.scene, line.vertex_0),
                         vertex_label(q.scene, line.vertex_1), piece.visible ? "" : ", dashed, as it is hidden there"),
             "the pixel gets the colour of lines");
    q.add_formulas(*verdict, *part);
    verdict->chain.push_back({*begin, q.polygon, "work on the edge begins"});
    verdict->chain.push_back(
        {*part, q.polygon, piece.visible ? "a piece of it that is visible" : "a piece of it that is hidden"});
    if (piece.visible) break;
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
  const LineHide* by = nullptr;
  for (const LineHide& hide : line.row.hidden)
    if (!by || std::max({0.0, hide.t_0 - t, t - hide.t_1}) < std::max({0.0, by->t_0 - t, t - by->t_1})) by = &hide;
  Verdict verdict;
  if (!by) {
    verdict =
        all_away(q, line)
            ? q.verdict(Why::back_edge, part,
                        fmt::format("its {} passes there, but all faces at it face away, so it is left out",
                                    name_of(q, line)))
            : q.verdict(
                  Why::line_hidden, part,
                  fmt::format(
                      "its {} passes there, but the trace takes this piece of it for hidden, and does not say by what",
                      name_of(q, line)));
  } else {
    const std::int32_t other = polygon_of_facet(q.scene, by->facet);
    verdict = q.verdict(Why::line_hidden, part,
                        fmt::format("its {} passes there, but {} hides it from t = {} to t = {}", name_of(q, line),
                                    q.label(other), number(by->t_0), number(by->t_1)));
    verdict.other = other;
    const auto hide = next_within(q.trace, begin, q.trace.size() + 1, [&](const RecordedEvent& recorded) {
      const auto* found = get_if<LineHide>(&recorded.event);
      return (found && found->facet == by->facet && found->t_0 == by->t_0) || is_one_of<LineBegin>(recorded);
    });
    if (hide && event_at<LineHide>(q.trace, *hide)) {
      verdict.step = *hide;
      q.add_formulas(verdict, *hide);
      verdict.chain.push_back({*hide, other, fmt::format("{} hides an interval of the edge", q.label(other))});
    }
  }
  verdict.formulas.push_back(by ? place_text(t, by->t_0, by->t_1) : place_text(t, piece.t_0, piece.t_1));
  verdict.chain.push_back({begin, q.polygon, fmt::format("work on {} begins", name_of(q, line))});
  verdict.chain.push_back({part, q.polygon, "a piece of it that is hidden"});
  return verdict;
}

}  // namespace

bool of_lines(const Trace& trace) { return trace.has(kind_of<LineBegin>); }

Verdict why_by_lines(Asked& q) {
  if (auto verdict = drawn(q)) return *verdict;
  const std::vector<DrawnEdge> lines = lines_of(q);
  if (lines.empty()) {
    const std::vector<FacetThere> facets = facets_there(q);
    const bool nothing = facets.empty() || std::none_of(facets.begin(), facets.end(), [](const FacetThere& there) {
                           return there.at || there.cut_at;
                         });
    return q.verdict(nothing ? Why::outside : Why::not_covered, 0, "none of its edges is in view");
  }
  const DrawnEdge* nearest = nullptr;
  for (const DrawnEdge& line : lines) {
    if (!nearest || distance_to(line, q.pixel) < distance_to(*nearest, q.pixel)) nearest = &line;
    const auto t = passes(line, q.pixel);
    const LinePiece* piece = t ? piece_at(line, *t) : nullptr;
    if (piece && !piece->visible) return hidden(q, line, *piece, *t);
  }
  const std::int64_t begin = begin_of(q, *nearest).value_or(0);
  Verdict verdict =
      q.verdict(Why::not_covered, begin,
                fmt::format("only edges are drawn, and the nearest of its own, {}, passes {} pixels from the centre",
                            name_of(q, *nearest), number(distance_to(*nearest, q.pixel))));
  verdict.chain.push_back({begin, q.polygon, fmt::format("work on {} begins", name_of(q, *nearest))});
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
  if (!picked) {
    q.where = "anywhere";
    Verdict verdict = why_by_lines(q);
    verdict.pixel.reset();
    return verdict;
  }
  // A pixel on it: the first that was drawn, or for one that was not the middle of the edge.
  const std::int64_t begin = begin_of(q, *picked).value_or(0);
  Trace::Pixel pixel{nearest_int((picked->from.x + picked->to.x) / 2),
                     nearest_int((picked->from.y + picked->to.y) / 2)};
  const auto draw = next_of<ColorWrite, LineBegin>(q.trace, begin, q.trace.size() + 1);
  if (const auto color = draw ? event_at<ColorWrite>(q.trace, *draw) : std::nullopt) pixel = {color->x, color->y};
  pixel.x = std::clamp(pixel.x, 0, q.scene.raster.width - 1),
  pixel.y = std::clamp(pixel.y, 0, q.scene.raster.height - 1);
  return with_pixel(q, pixel,
                    visible ? fmt::format("Of the {} of {} in view, {} seen, in whole or in part. On one of them:",
                                          count_text(lines.size(), "edge", "edges"), q.name,
                                          seen_edges == 1 ? "one is" : fmt::format("{} are", seen_edges))
                            : fmt::format("None of the {} of {} in view is seen. On one of them:",
                                          count_text(lines.size(), "edge", "edges"), q.name));
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
  const auto begin = previous_of<CurveSegment>(q.trace, step);
  if (!begin || !q.scene.surface) return no_polygon;
  const CurveSegment segment = *event_at<CurveSegment>(q.trace, *begin);
  for (const Facet& facet : q.scene.facets) {
    int found = 0;
    for (std::int32_t k = 0; k < facet.corner_count; ++k) {
      const std::int32_t corner = q.scene.corners[facet.first_corner + k];
      found += corner == segment.vertex_0 || corner == segment.vertex_1;
    }
    if (found == 2 && facet.polygon != q.polygon) return facet.polygon;
  }
  return no_polygon;
}

/// A curve in the pixel's column.
struct There {
  std::int64_t step = 0;
  HorizonTest test{};
  double low = 0, high = 0;  ///< rows that it passes within the column
  bool passes(std::int32_t row) const { return low - 0.5 <= row && row <= high + 0.5; }
};

std::vector<There> tests_in_column(const Asked& q, const Segment& segment) {
  std::vector<There> all;
  std::vector<std::pair<std::int64_t, HorizonTest>> tests;
  for (std::int64_t step = segment.begin + 1; step < segment.end; ++step)
    if (const auto test = event_at<HorizonTest>(q.trace, step)) tests.emplace_back(step, *test);
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const HorizonTest& test = tests[k].second;
    if (test.x != q.pixel.x) continue;
    There there{tests[k].first, test, test.y_curve, test.y_curve};
    for (const std::size_t next : {k - 1, k + 1}) {  // k - 1 of 0 is beyond the end
      if (next >= tests.size() || std::abs(tests[next].second.x - test.x) != 1) continue;
      const double halfway = (test.y_curve + tests[next].second.y_curve) / 2;
      there.low = std::min(there.low, halfway), there.high = std::max(there.high, halfway);
    }
    all.push_back(there);
  }
  return all;
}

std::optional<Verdict> drawn(Asked& q, const Segment& segment) {
  const auto here = [&](const RecordedEvent& recorded) {
    const auto* color = get_if<ColorWrite>(&recorded.event);
    return color && color->x == q.pixel.x && color->y == q.pixel.y;
  };
  const auto step = next_within(q.trace, segment.begin, segment.end, here);
  if (!step) return std::nullopt;
  Verdict verdict =
      seen(q, *step, "a curve along its border is drawn through it", "the pixel gets the colour of curves");
  verdict.chain.push_back(
      {segment.begin, q.polygon,
       fmt::format("the curve from sample {} to sample {}", segment.ends.vertex_0, segment.ends.vertex_1)});
  if (const auto test = previous_of<HorizonTest>(q.trace, *step, segment.begin)) {
    verdict.chain.push_back({*test, q.polygon, "the curve is held against the horizons of its column"});
    q.add_formulas(verdict, *test);
  }
  return verdict;
}

Verdict hidden(Asked& q, const Segment& segment, const There& there) {
  const auto moved = previous_within(q.trace, there.step, 0, [&](const RecordedEvent& recorded) {
    const auto* move = get_if<HorizonMove>(&recorded.event);
    return move && move->x == q.pixel.x && std::isfinite(move->y_curve);
  });
  Verdict verdict =
      q.verdict(Why::horizon, there.step,
                fmt::format("its curve passes there at y = {}, but it is hidden by the horizons of column {}",
                            number(there.test.y_curve), q.pixel.x));
  q.add_formulas(verdict, there.step);
  if (moved) {
    verdict.other = owner_of(q, *moved);
    verdict.chain.push_back({*moved, verdict.other,
                             fmt::format("a nearer curve moves a horizon of column {} to y = {}", q.pixel.x,
                                         number(event_at<HorizonMove>(q.trace, *moved)->y_curve))});
  }
  verdict.chain.push_back(
      {segment.begin, q.polygon,
       fmt::format("the curve from sample {} to sample {}", segment.ends.vertex_0, segment.ends.vertex_1)});
  verdict.chain.push_back({there.step, q.polygon, "its point in this column is hidden"});
  return verdict;
}

std::vector<Segment> segments_of(const Asked& q) {
  const std::set<std::int32_t> corners = corners_of(q, q.polygon);
  const auto of_it = [&](const RecordedEvent& recorded) {
    const auto* segment = get_if<CurveSegment>(&recorded.event);
    return segment && is_side(q, corners, *segment);
  };
  const std::int64_t end = q.trace.size() + 1;
  std::vector<Segment> segments;
  for (auto step = q.trace.next(0, of_it); step; step = q.trace.next(*step, of_it))
    segments.push_back({*step, next_of<CurveSegment, CurveBegin>(q.trace, *step, end).value_or(end),
                        *event_at<CurveSegment>(q.trace, *step)});
  return segments;
}

}  // namespace

bool of_curves(const Trace& trace) { return trace.has(kind_of<HorizonTest>); }

Verdict why_by_curves(Asked& q) {
  const std::vector<Segment> segments = segments_of(q);
  const There* behind = nullptr;
  const Segment* its = nullptr;
  std::vector<std::vector<There>> columns;
  std::string rows;
  for (const Segment& segment : segments) {
    if (auto verdict = drawn(q, segment)) return *verdict;
    columns.push_back(tests_in_column(q, segment));
  }
  for (std::size_t k = 0; k < segments.size(); ++k)
    for (const There& there : columns[k]) {
      rows += (rows.empty() ? "" : ", ") + number(there.test.y_curve);
      if (there.test.verdict == Horizon::hidden && there.passes(q.pixel.y)) behind = &there, its = &segments[k];
    }
  if (behind) return hidden(q, *its, *behind);
  const std::int64_t step = segments.empty() ? 0 : segments.front().begin;
  Verdict verdict = q.verdict(
      Why::not_covered, step,
      rows.empty()
          ? fmt::format("only curves are drawn, and none along its border meets column {}", q.pixel.x)
          : fmt::format("only curves are drawn, and those along its border pass column {} at y = {}", q.pixel.x, rows));
  for (const Segment& segment : segments)
    verdict.chain.push_back(
        {segment.begin, q.polygon,
         fmt::format("the curve from sample {} to sample {}", segment.ends.vertex_0, segment.ends.vertex_1)});
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
