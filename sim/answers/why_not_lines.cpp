// Wireframe and hidden lines: a polygon is seen where one of its edges is drawn.
#include <algorithm>
#include <cmath>

#include "sim/answers/why_not_parts.hpp"
#include "sim/words/rejects.hpp"
#include "traces/math/portable_math.hpp"

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
    if (facet < 0 || static_cast<std::size_t>(facet) >= q.scene.facets.size()) continue;
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
  Trace::Pixel pixel{static_cast<std::int32_t>(std::lround((picked->from.x + picked->to.x) / 2)),
                     static_cast<std::int32_t>(std::lround((picked->from.y + picked->to.y) / 2))};
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

}  // namespace zstep::answers
