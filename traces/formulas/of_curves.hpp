// Curves and lines: the floating horizon (004, "Some of the methods of hidden surface elimination"), and edges that
// faces cross and hide.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/vectors.hpp"

namespace zstep::formulas {

template <>
inline constexpr bool joins_things<CurveSegment> = true;

template <class Out>
void derive(const HorizonTest& e, const Situation& at, Out& out) {
  const HorizonWork& work = at.method().horizon;
  if (work.segment) {
    const auto a = at.on_raster(work.segment->vertex_0), b = at.on_raster(work.segment->vertex_1);
    // A curve that is seen edge-on between two columns stands on the nearest one.
    if (a && b && a->x != b->x && e.x >= std::min(a->x, b->x) && e.x <= std::max(a->x, b->x)) {
      const Place from{Place::In::vertex, work.segment->vertex_0}, to{Place::In::vertex, work.segment->vertex_1};
      out.gives(&HorizonTest::y_curve, on_line(out.number("y_0", a->y, from["y_s"]), out.number("y_1", b->y, to["y_s"]),
                                               out.number("x", e.x, Place{}), out.number("x_0", a->x, from["x_s"]),
                                               out.number("x_1", b->x, to["x_s"])));
    }
  }
  const std::size_t column = e.x;
  if (e.x < 0 || column >= work.upper.size() || column >= work.lower.size()) return;
  const double upper = work.upper[column], lower = work.lower[column];
  out.reads(Place{Place::In::horizon, e.x});
  const auto option = at.header.conventions.options.find("horizons");
  const bool one = option != at.header.conventions.options.end() && option->second == "one";
  // An entry is NaN while nothing was drawn in its column.
  const bool above = !(e.y_curve > upper), below = !one && !(e.y_curve < lower);
  out.is(&HorizonTest::verdict, above ? Horizon::above : below ? Horizon::below : Horizon::hidden);
}

template <class Out>
void derive(const CurveBegin& e, const Situation& at, Out& out) {
  const auto& last = at.method().horizon.curve;
  out.rule(Rule::number_is_next, e.curve == (last ? last->curve + 1 : 0));
  if (!at.scene.surface) return;
  const Surface& surface = *at.scene.surface;
  if (e.row < 0 || e.row >= (e.across ? surface.columns : surface.rows)) return;
  // A sample stands at (x, z, y) in the world.
  const glm::dvec3& first = at.scene.points[e.across ? e.row : e.row * surface.columns];
  out.is(&CurveBegin::constant, e.across ? first.x : first.y);
}

template <class Out>
void derive(const HorizonMove& e, const Situation& at, Out& out) {
  const HorizonWork& work = at.method().horizon;
  const std::size_t column = e.x;
  const auto& own = e.upper ? work.upper : work.lower;
  if (e.x < 0 || column >= own.size() || !std::isfinite(e.y_curve)) return;
  out.reads(Place{Place::In::horizon, e.x});
  const double before = own[column];
  out.rule(Rule::horizon_moves_out, std::isnan(before) || (e.upper ? e.y_curve <= before : e.y_curve >= before));
  if (work.test && work.test->x == e.x) out.is(&HorizonMove::y_curve, work.test->y_curve);
}

/// Where a curve crosses a horizon between two columns, both taken as straight there: at the part d_0/(d_0 − d_1) of
/// the way, d being how far the curve is from the horizon.
template <class Out>
void derive(const HorizonCross& e, const Situation& at, Out& out) {
  const HorizonWork& work = at.method().horizon;
  if (work.test) out.rule(Rule::cross_beside, std::abs(e.x_at - work.test->x) <= 1);
  if (!work.before || !work.here) return;
  const HorizonPassage &from = *work.before, &to = *work.here;
  const double before = e.upper ? from.upper : from.lower, here = e.upper ? to.upper : to.lower;
  if (std::abs(from.test.x - to.test.x) != 1 || !std::isfinite(before) || !std::isfinite(here)) return;
  const auto horizon = [&](std::string_view name, double value, std::int32_t x) {
    return out.number(name, value, Place{Place::In::horizon, x});
  };
  const auto y_0 = out.number("y_0", from.test.y_curve, Place{}), y_1 = out.number("y_1", to.test.y_curve, Place{}),
             x_0 = out.number("x_0", from.test.x, Place{}), x_1 = out.number("x_1", to.test.x, Place{});
  const auto t = where_zero(out.named("d_0", y_0 - horizon("h_0", before, from.test.x)),
                            out.named("d_1", y_1 - horizon("h_1", here, to.test.x)));
  out.gives(&HorizonCross::x_at, part_of_way(x_0, x_1, t));
  out.gives(&HorizonCross::y_at, part_of_way(y_0, y_1, t));
}

namespace detail {

/// Of a curve on two columns, the ends of what is drawn between them of its part above or below the horizons.
struct VisiblePart {
  double x_0, y_0, x_1, y_1;
  Horizon where;
};
inline std::vector<VisiblePart> visible_parts(const HorizonPassage& from, const HorizonPassage& to) {
  const double x_0 = from.test.x, y_0 = from.test.y_curve, x_1 = to.test.x, y_1 = to.test.y_curve;
  std::vector<VisiblePart> parts;
  if (from.test.verdict == to.test.verdict) {
    if (to.test.verdict != Horizon::hidden) parts.push_back({x_0, y_0, x_1, y_1, to.test.verdict});
    return parts;
  }
  for (const bool begins : {true, false}) {
    const Horizon where = begins ? from.test.verdict : to.test.verdict;
    if (where == Horizon::hidden) continue;
    const bool upper = where == Horizon::above;
    const double t = where_zero(y_0 - (upper ? from.upper : from.lower), y_1 - (upper ? to.upper : to.lower));
    const bool crosses = t >= 0 && t <= 1;  // else only the column itself is drawn
    const double x = crosses  ? part_of_way(x_0, x_1, t)
                     : begins ? x_0
                              : x_1,
                 y = crosses  ? part_of_way(y_0, y_1, t)
                     : begins ? y_0
                              : y_1;
    parts.push_back(begins ? VisiblePart{x_0, y_0, x, y, where} : VisiblePart{x, y, x_1, y_1, where});
  }
  return parts;
}

/// Does the part come as near to a pixel's centre as `reach` in x and in y?
inline bool comes_near(const VisiblePart& part, double x, double y, double reach) {
  double low = 0, high = 1;
  const auto narrow = [&](double from, double to, double centre) {
    if (from == to) {
      if (std::abs(from - centre) > reach) high = -1;
      return;
    }
    const double one = (centre - reach - from) / (to - from), other = (centre + reach - from) / (to - from);
    low = std::max(low, std::min(one, other)), high = std::min(high, std::max(one, other));
  };
  narrow(part.x_0, part.x_1, x), narrow(part.y_0, part.y_1, y);
  return low <= high;
}

/// Ink of what is seen above the upper horizon, which is told from the paper, and of what is seen below the lower one.
inline Color ink_of_curve(const Color& paper, Horizon where) {
  if (where == Horizon::below) return {213, 94, 0};
  const bool dark = 2 * paper.red + 5 * paper.green + paper.blue < 4 * 255;
  return dark ? Color{255, 255, 255} : Color{0, 0, 0};
}

/// The part of the curve at work that a pixel is drawn of, where it is between the last two columns; with none, nothing
/// of what is visible there comes near it. Of several parts it is the one that it has the ink of.
struct DrawnOfCurve {
  bool known = false;
  std::optional<VisiblePart> part{};
};
inline DrawnOfCurve drawn_of_curve(const Situation& at, const ColorWrite& e) {
  const HorizonWork& work = at.method().horizon;
  if (!work.here) return {};
  const HorizonPassage& to = *work.here;
  const bool joined = work.before && std::abs(work.before->test.x - to.test.x) <= 1;  // 0 where it rises in one column
  const HorizonPassage& from = joined ? *work.before : to;
  if (e.x < std::min(from.test.x, to.test.x) || e.x > std::max(from.test.x, to.test.x)) return {};
  constexpr double reach = 1;  // programs draw lines in more than one way
  std::vector<VisiblePart> parts = visible_parts(from, to);
  if (joined)  // a piece that was cut off begins anew
    for (const VisiblePart& alone : visible_parts(to, to)) parts.push_back(alone);
  DrawnOfCurve drawn{true};
  for (const VisiblePart& part : parts) {
    if (!comes_near(part, e.x, e.y, reach + rounding_of_float32)) continue;
    const Color ink = ink_of_curve(at.scene.background, part.where);
    const bool of_its_ink = ink.red == e.r8 && ink.green == e.g8 && ink.blue == e.b8;
    if (of_its_ink || !drawn.part) drawn.part = part;
    if (of_its_ink) break;
  }
  return drawn;
}

}  // namespace detail

// Edges as lines of the picture: where faces cross them, what they hide, and what is seen of them.

/// Where on a line of the picture, from 0 at p to 1 at q, it is crossed by the line through a and b.
template <class T>
T where_lines_cross(const T& p_x, const T& p_y, const T& q_x, const T& q_y, const T& a_x, const T& a_y, const T& b_x,
                    const T& b_y) {
  return ((a_x - p_x) * (b_y - a_y) - (a_y - p_y) * (b_x - a_x)) /
         ((q_x - p_x) * (b_y - a_y) - (q_y - p_y) * (b_x - a_x));
}

namespace detail {

/// What a corner may lie beside a line and yet count as on it, in pixels.
inline constexpr double beside_line = 1e-9;

/// Where a face meets a line, as parts of its way: in space, where the line goes through the face's plane, and on the
/// picture, where it crosses the face's outline, each from one vertex to the next.
struct Crossings {
  std::vector<Rounded> in_space, on_picture;
  std::vector<std::array<std::int32_t, 2>> outline;  ///< those edges, as `on_picture` has them
  bool any() const { return !in_space.empty() || !on_picture.empty(); }
  /// The edge that is crossed at t.
  std::optional<std::array<std::int32_t, 2>> edge_at(double t) const {
    if (on_picture.empty()) return std::nullopt;
    const auto nearer = [&](const Rounded& a, const Rounded& b) {
      return std::abs(a.value - t) < std::abs(b.value - t);
    };
    const auto best = std::min_element(on_picture.begin(), on_picture.end(), nearer);
    return outline[best - on_picture.begin()];
  }
};

inline void cross_piece(Crossings& crossings, const Situation& at, const Piece& piece, const Vector<Rounded>& a,
                        const Vector<Rounded>& b) {
  const auto point = [](const Vector<Rounded>& v) { return glm::dvec3(v.x.value, v.y.value, v.z.value); };
  if (piece.plane) {
    const Rounded t =
        where_zero(plane_value<Rounded>(*piece.plane, point(a)), plane_value<Rounded>(*piece.plane, point(b)));
    if (std::isfinite(t.value)) crossings.in_space.push_back(t);
  }
  const Rounded along_x = b.x - a.x, along_y = b.y - a.y, square = along_x * along_x + along_y * along_y;
  const double allowed = beside_line * std::sqrt(square.value);
  const auto side = [&](const Vector<Rounded>& corner) {
    Rounded value = along_x * (corner.y - a.y) - along_y * (corner.x - a.x);
    value.spread += allowed / rounding_of_float64;
    return value;
  };
  std::vector<Vector<Rounded>> corners;
  for (const std::int32_t vertex : piece.outline) {
    const auto corner = at.on_raster(vertex);
    if (!corner) return;
    corners.push_back(rounded({corner->x, corner->y, corner->z}));
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector<Rounded>&start = corners[i], &end = corners[i + 1 < corners.size() ? i + 1 : 0];
    const Rounded side_0 = side(start), side_1 = side(end);
    if (std::abs(side_0.value) <= allowed && std::abs(side_1.value) <= allowed) continue;  // it lies on the line
    const Rounded part = where_zero(side_0, side_1);
    const double off = rounding_of_float32 * std::max(part.spread, 1.0);
    if (!(part.value >= -off && part.value <= 1 + off)) continue;  // beside the edge
    Rounded t = where_lines_cross(a.x, a.y, b.x, b.y, start.x, start.y, end.x, end.y);
    if (!std::isfinite(t.value)) continue;
    // A corner beside the line counts as on it: that moves the crossing the farther, the more the two run alike.
    const Rounded side_by_side = (end.x - start.x) * along_x + (end.y - start.y) * along_y;
    t.spread += std::abs(side_by_side.value / (side_1 - side_0).value) * allowed / square.value / rounding_of_float64;
    crossings.on_picture.push_back(t);
    crossings.outline.push_back({piece.outline[i], piece.outline[i + 1 < corners.size() ? i + 1 : 0]});
  }
}

/// Of the pieces of a facet's polygon: which of them the facet is, they do not say. Pieces are gathered in the order of
/// their polygons; in one that is another nothing is found.
inline Crossings crossings_of(const Situation& at, const LineBegin& line, std::int32_t facet) {
  Crossings crossings;
  if (!at.records<OutlineVertex>() || !at.records<PlaneEquation>()) return crossings;  // half of them says nothing
  const auto a = at.on_raster(line.vertex_0), b = at.on_raster(line.vertex_1);
  if (!a || !b || corners_of(at, facet).empty()) return crossings;
  if (!at.has_depth(line.vertex_0) || !at.has_depth(line.vertex_1)) return crossings;
  const std::int32_t polygon = at.scene.facets[facet].polygon;
  const auto& pieces = at.method().pieces;
  std::size_t first = 0;
  for (std::size_t end = pieces.size(); first < end;) {
    const std::size_t middle = (first + end) / 2;
    if (pieces[middle].polygon < polygon) first = middle + 1;
    else end = middle;
  }
  for (std::size_t i = first; i < pieces.size() && pieces[i].polygon == polygon; ++i)
    cross_piece(crossings, at, pieces[i], rounded({a->x, a->y, a->z}), rounded({b->x, b->y, b->z}));
  return crossings;
}

inline const LineRow* line_row(const Situation& at, std::int32_t number) {
  const std::size_t line = number;
  return number >= 0 && line < at.method().lines.size() ? &at.method().lines[line] : nullptr;
}

/// Is more than half of a part of a line behind faces? Between two of them it may be seen for less than can be drawn.
inline bool is_mostly_hidden(const LineRow& row, double t_0, double t_1) {
  std::vector<std::pair<double, double>> hidden;
  for (const LineHide& hide : row.hidden) hidden.emplace_back(hide.t_0, hide.t_1);
  std::sort(hidden.begin(), hidden.end());
  if (!(t_0 < t_1))
    return std::any_of(hidden.begin(), hidden.end(),
                       [&](const auto& one) { return one.first <= t_0 && t_0 <= one.second; });
  double length = 0, reached = t_0;
  for (const auto& [from, to] : hidden) {
    const double end = std::min(to, t_1);
    length += std::max(0.0, end - std::max(from, reached));
    reached = std::max(reached, end);
  }
  return length > 0.5 * (t_1 - t_0);
}

}  // namespace detail

/// Parts of a line follow one another, each ends where something begins or ends to hide it, and those that a face hides
/// are not seen.
template <class Out>
void derive(const LinePiece& e, const Situation& at, Out& out) {
  const LineRow* row = detail::line_row(at, e.line);
  if (!row) return;
  out.is(&LinePiece::t_0, row->pieces.empty() ? 0.0 : row->pieces.back().t_1);
  out.rule(Rule::hides_of_line, e.t_0 <= e.t_1 && e.t_1 <= 1);
  const bool hidden = detail::is_mostly_hidden(*row, e.t_0, e.t_1);
  if (!at.records<LineHide>()) return;
  std::vector<Rounded> ends{1.0};
  for (const LineHide& hide : row->hidden) ends.insert(ends.end(), {Rounded(hide.t_0), Rounded(hide.t_1)});
  out.near(&LinePiece::t_1, nearest_of(e.t_1, ends));
  // Edges between faces that all face away are dropped as a whole.
  if (row->entry.kind != LineKind::back) out.is(&LinePiece::visible, !hidden);
}

/// A face hides a line between two of its crossings, or from its beginning, or to its end.
template <class Out>
void derive(const LineHide& e, const Situation& at, Out& out) {
  out.rule(Rule::hides_of_line, 0 <= e.t_0 && e.t_0 <= e.t_1 && e.t_1 <= 1);
  const LineRow* row = detail::line_row(at, e.line);
  if (!row) return;
  detail::Crossings crossings = detail::crossings_of(at, row->entry, e.facet);
  if (!crossings.any()) return;
  std::vector<Rounded>& all = crossings.on_picture;
  all.insert(all.end(), crossings.in_space.begin(), crossings.in_space.end());
  all.push_back(0.0);
  out.near(&LineHide::t_0, nearest_of(e.t_0, all));
  all.back() = 1.0;
  out.near(&LineHide::t_1, nearest_of(e.t_1, all));
}

template <class Out>
void derive(const LineCross& e, const Situation& at, Out& out) {
  const LineRow* row = detail::line_row(at, e.line);
  if (!row) return;
  const LineBegin& entry = row->entry;
  const auto a = at.on_raster(entry.vertex_0), b = at.on_raster(entry.vertex_1);
  if (!a || !b) return;
  const Place from{Place::In::vertex, entry.vertex_0}, to{Place::In::vertex, entry.vertex_1};
  const auto t = out.number("t", e.t, Place{});
  out.gives(&LineCross::x_at, part_of_way(out.number("x_0", a->x, from["x_s"]), out.number("x_1", b->x, to["x_s"]), t));
  out.gives(&LineCross::y_at, part_of_way(out.number("y_0", a->y, from["y_s"]), out.number("y_1", b->y, to["y_s"]), t));
  const detail::Crossings crossings = detail::crossings_of(at, entry, e.facet);
  const std::vector<Rounded>& all = e.in_space ? crossings.in_space : crossings.on_picture;
  if (!all.empty()) out.near(&LineCross::t, nearest_of(e.t, all));
}

}  // namespace zstep::formulas
