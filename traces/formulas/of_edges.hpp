// What the edge table, the active edge list and spans follow from: x–y and z–y interpolation (000, "Double
// interpolation"; 001), the rules of the list (000, "The algorithm"), and the intervals of the scan-line method (002).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/fill.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/vectors.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

namespace detail {

/// The ends of an edge, the one with the smaller y first, by the names that formulas have for them; their depths where
/// the run has them.
template <class T>
struct Ends {
  T x_0, y_0, x_1, y_1;
  std::optional<T> z_0 = {}, z_1 = {};
};
template <class Out>
auto ends_of(Out& out, const Situation& at, std::int32_t vertex_0, std::int32_t vertex_1)
    -> std::optional<Ends<typename Out::Number>> {
  const auto a = at.on_raster(vertex_0), b = at.on_raster(vertex_1);
  if (!a || !b) return std::nullopt;
  const Place from{Place::In::vertex, vertex_0}, to{Place::In::vertex, vertex_1};
  Ends<typename Out::Number> ends{out.number("x_0", a->x, from["x_s"]), out.number("y_0", a->y, from["y_s"]),
                                  out.number("x_1", b->x, to["x_s"]), out.number("y_1", b->y, to["y_s"])};
  if (!at.has_depth(vertex_0) || !at.has_depth(vertex_1)) return ends;
  ends.z_0 = out.number("z_0", a->z, from["z"]), ends.z_1 = out.number("z_1", b->z, to["z"]);
  return ends;
}

/// Has the outline at work its lowest point at this vertex, also where that is a horizontal edge? Nothing where the
/// outline is not known, or rounding decides.
inline std::optional<bool> is_lowest(const Situation& at, std::int32_t vertex) {
  const MethodState& method = at.method();
  std::span<const std::int32_t> outline = method.outline;
  if (const Piece* piece = at.piece(method.piece)) outline = piece->outline;
  if (outline.empty() && at.on_screen()) outline = corners_of(at, method.facet);
  if (!method.polygons_told && !at.on_screen()) outline = {};
  const auto here = std::find(outline.begin(), outline.end(), vertex);
  if (here == outline.end() || std::find(here + 1, outline.end(), vertex) != outline.end()) return std::nullopt;
  const auto y_of = [&](std::size_t place) { return at.on_raster(outline[place]); };
  return turns_down(outline.size(), here - outline.begin(), [&](std::size_t place) {
    const auto corner = y_of(place);
    return corner ? std::optional(corner->y) : std::nullopt;
  });
}

/// Has the list of active edges no others than the program's own? Where a run never says that an edge leaves, as long
/// as none has ended.
inline bool list_is_exact(const Situation& at) {
  if (at.tells_leaving()) return true;
  const auto& line = at.method().scan_line;
  const auto& active = at.method().active;
  return line && std::none_of(active.begin(), active.end(), [&](const ActiveEdge& one) {
           const EdgeTableInsert* entry = at.edge(one.edge);
           return entry && entry->end_row <= *line;
         });
}

/// The active edges on a scan line. Where a run never says that an edge leaves, those that have ended are not among
/// them.
inline std::vector<ActiveEdge> active_on(const Situation& at, std::int32_t y) {
  std::vector<ActiveEdge> active = at.method().active;
  if (!at.tells_leaving())
    std::erase_if(active, [&](const ActiveEdge& one) {
      const EdgeTableInsert* entry = at.edge(one.edge);
      return entry && entry->end_row <= y;
    });
  return active;
}

/// Is the list out of order between these two places?
inline bool out_of_order(const std::vector<ActiveEdge>& active, std::size_t left) {
  return left + 1 < active.size() && active[left].x > active[left + 1].x;
}

/// Are these the first and second, third and fourth … of the list? Edges that meet may stand either way round. By the
/// non-zero rule others may stand between them.
inline bool pair_of_list(const Situation& at, const std::vector<ActiveEdge>& active, const ActiveEdge& left,
                         const ActiveEdge& right) {
  if (fills_non_zero(at.header.conventions)) return left.x <= right.x;
  std::size_t before_left = 0, up_to_left = 0, before_right = 0, up_to_right = 0;
  for (const ActiveEdge& one : active) {
    before_left += one.x < left.x, up_to_left += one.x <= left.x;
    before_right += one.x < right.x, up_to_right += one.x <= right.x;
  }
  for (std::size_t place = before_left + before_left % 2; place < up_to_left; place += 2)
    if (place + 1 >= before_right && place + 1 < up_to_right) return true;
  return false;
}

}  // namespace detail

template <class Out>
void derive(const EdgeTableInsert& e, const Situation& at, Out& out) {
  if (!at.method().keeps_all && at.method().polygon != no_polygon) {
    out.is(&EdgeTableInsert::polygon, at.method().polygon);
    out.rule(Rule::edge_of_outline, detail::joined_in_outline(at, e.vertex_0, e.vertex_1));
    out.rule(Rule::outline_of_facet, detail::outline_is_whole(at));
  }
  // Of a piece that is drawn: its outline was given when it was made.
  if (at.method().piece >= 0) out.is(&EdgeTableInsert::polygon, at.method().polygon);
  const auto ends = detail::ends_of(out, at, e.vertex_0, e.vertex_1);
  if (!ends) return;
  const double y_0 = at.on_raster(e.vertex_0)->y, y_1 = at.on_raster(e.vertex_1)->y;
  const std::int32_t height = at.scene.raster.height;
  const bool turned = y_0 > y_1;
  const auto &above = turned ? ends->y_1 : ends->y_0, &below = turned ? ends->y_0 : ends->y_1;
  const double upper = std::min(y_0, y_1), lower = std::max(y_0, y_1);
  out.whole(&EdgeTableInsert::first_row, first_row(above), row_from(upper, height));
  // With inclusive coverage an edge goes on through the scan line it ends on where its polygon has its lowest point.
  const bool as_recorded = e.end_row == row_from(end_row(lower, true), height);
  const auto lowest =
      at.header.declares(Convention::coverage) ? detail::is_lowest(at, turned ? e.vertex_0 : e.vertex_1) : std::nullopt;
  const bool past_end = may_include_end(at.header) && lowest.value_or(as_recorded);
  out.whole(&EdgeTableInsert::end_row, end_row(below, past_end), row_from(end_row(lower, past_end), height));
  if (y_0 == y_1) return;
  const auto row = out.number("y", e.first_row, Place{});
  out.gives(&EdgeTableInsert::dx_dy, slope(ends->x_0, ends->x_1, ends->y_0, ends->y_1));
  out.gives(&EdgeTableInsert::x_edge, on_line(ends->x_0, ends->x_1, row, ends->y_0, ends->y_1));
  if (!ends->z_0) return;
  out.gives(&EdgeTableInsert::dz_dy, slope(*ends->z_0, *ends->z_1, ends->y_0, ends->y_1));
  out.gives(&EdgeTableInsert::z_edge, on_line(*ends->z_0, *ends->z_1, row, ends->y_0, ends->y_1));
}

template <class Out>
void derive(const EdgeTableSkip& e, const Situation& at, Out& out) {
  if (!at.method().keeps_all && at.method().polygon != no_polygon)
    out.rule(Rule::edge_of_outline, detail::joined_in_outline(at, e.vertex_0, e.vertex_1));
  const auto a = at.on_raster(e.vertex_0), b = at.on_raster(e.vertex_1);
  if (!a || !b) return;
  const double upper = std::min(a->y, b->y), lower = std::max(a->y, b->y);
  const std::int32_t height = at.scene.raster.height;
  out.reads(Place{Place::In::vertex, e.vertex_0});
  out.reads(Place{Place::In::vertex, e.vertex_1});
  const bool level = out.equal(a->y, b->y), meets_none = level || row_from(upper, height) >= row_from(lower, height);
  out.rule(Rule::skip_is_right, meets_none);
  if (!meets_none) return;
  // Ends that rounding makes equal may be called either.
  const EdgeSkip why = a->y == b->y ? EdgeSkip::horizontal : level ? e.why : EdgeSkip::between_rows;
  out.is(&EdgeTableSkip::why, why);
}

template <class Out>
void derive(const ScanLineBegin& e, const Situation& at, Out& out) {
  // While there are active edges no line is left out.
  if (const auto& last = at.method().scan_line; last && !detail::active_on(at, e.y).empty())
    out.rule(Rule::line_is_next, e.y == *last + 1);
  // What ended before this line should have left by now, unless it leaves on it.
  bool all_left = true;
  for (const ActiveEdge& active : at.method().active)
    if (const EdgeTableInsert* entry = at.edge(active.edge)) all_left = all_left && entry->end_row >= e.y;
  if (at.tells_leaving()) out.rule(Rule::edge_left_behind, all_left);
  // A table of all polygons is too long to be gone through at each line.
  if (at.method().keeps_all || !at.records<EdgeEnter>()) return;
  bool all_entered = true;
  for (std::size_t edge = 0; edge < at.method().edge_table.size(); ++edge)
    all_entered = all_entered && (at.method().edge_stages[edge] != EdgeStage::waiting ||
                                  at.method().edge_table[edge].first_row >= e.y ||
                                  at.method().edge_table[edge].first_row >= at.method().edge_table[edge].end_row);
  out.rule(Rule::edge_missing, all_entered);
}

template <class Out>
void derive(const EdgeEnter& e, const Situation& at, Out& out) {
  const EdgeTableInsert* entry = at.edge(e.edge);
  if (!entry) return;
  out.reads(Place{Place::In::edge_table, e.edge});
  if (at.method().scan_line) out.rule(Rule::edge_in_bucket, *at.method().scan_line == entry->first_row);
  const auto& active = at.method().active;
  const std::size_t place = e.place;
  // A place is one of a list whose edges have moved and left as the run says.
  if (!at.records<EdgeStep>() || !detail::list_is_exact(at)) return;
  if (e.place < 0 || place > active.size()) return;
  const bool left = place == 0 || active[place - 1].x <= entry->x_edge || out.equal(active[place - 1].x, entry->x_edge);
  const bool right =
      place == active.size() || entry->x_edge <= active[place].x || out.equal(active[place].x, entry->x_edge);
  // A list that is not in order has no place that keeps it so; it is sorted later then.
  bool sorted = true;
  for (std::size_t i = 0; i + 1 < active.size(); ++i) sorted = sorted && !detail::out_of_order(active, i);
  if (sorted) out.rule(Rule::edge_sorted, left && right);
}

template <class Out>
void derive(const EdgeRetire& e, const Situation& at, Out& out) {
  const EdgeTableInsert* entry = at.edge(e.edge);
  if (!entry || !at.method().scan_line) return;
  const std::int32_t y = *at.method().scan_line;
  out.reads(Place{Place::In::edge_table, e.edge});
  // At the scan line where it ends, or at the end of the one before.
  out.rule(Rule::edge_retires, y == entry->end_row || y + 1 == entry->end_row);
}

template <class Out>
void derive(const EdgeStep& e, const Situation& at, Out& out) {
  const EdgeTableInsert* entry = at.edge(e.edge);
  const ActiveEdge* active = at.active(e.edge);
  if (!entry || !active || !at.method().scan_line) return;
  const Place table{Place::In::edge_table, e.edge}, here{Place::In::active_edge, e.edge};
  if (at.adds_slopes()) {
    out.gives(&EdgeStep::x_edge,
              out.number("x", active->x, here["x_edge"]) + out.number("1/m", entry->dx_dy, table["dx_dy"]));
    out.gives(&EdgeStep::z_edge,
              out.number("z", active->z, here["z_edge"]) + out.number("dz/dy", entry->dz_dy, table["dz_dy"]));
    return;
  }
  const auto ends = detail::ends_of(out, at, entry->vertex_0, entry->vertex_1);
  if (!ends) return;
  const auto row = out.number("y", *at.method().scan_line, Place{});
  out.gives(&EdgeStep::x_edge, on_line(ends->x_0, ends->x_1, row, ends->y_0, ends->y_1));
  if (ends->z_0) out.gives(&EdgeStep::z_edge, on_line(*ends->z_0, *ends->z_1, row, ends->y_0, ends->y_1));
}

template <class Out>
void derive(const EdgeSwap& e, const Situation& at, Out& out) {
  const auto& active = at.method().active;
  const std::size_t left = e.place;
  if (!at.records<EdgeStep>() || !detail::list_is_exact(at) || e.place < 0 || left + 1 >= active.size()) return;
  for (const std::size_t place : {left, left + 1}) out.reads(Place{Place::In::active_edge, active[place].edge});
  out.rule(Rule::swap_needed, active[left].x >= active[left + 1].x);
}

namespace detail {

/// By how many slopes x and z of an edge are away from where it entered: one for each scan line since. Where a slope is
/// too small for the digits that are written, it does not tell.
template <class Out>
bool moved_once_a_line(Out& out, const EdgeTableInsert& entry, const ActiveEdge& active, std::int32_t y) {
  const int rows = y - entry.first_row;
  if (rows < 0) return true;
  const auto once = [&](double here, double start, double slope) {
    const double sure = slope / (8 * (rows + 1));
    if (out.equal(here, here + sure) || out.equal(start, start + sure)) return true;
    return std::abs((here - start) / slope - rows) < 0.5;
  };
  return once(active.x, entry.x_edge, entry.dx_dy) && once(active.z, entry.z_edge, entry.dz_dy);
}

}  // namespace detail

/// The slopes of the plane through three vertices (004).
template <class Out>
void derive(const PlaneSlopes& e, const Situation& at, Out& out) {
  if (at.method().polygon != no_polygon && !at.method().keeps_all) out.is(&PlaneSlopes::polygon, at.method().polygon);
  const auto from = at.on_raster(e.vertex_0), one = at.on_raster(e.vertex_1), other = at.on_raster(e.vertex_2);
  if (!from || !one || !other) return;
  if (!at.has_depth(e.vertex_0) || !at.has_depth(e.vertex_1) || !at.has_depth(e.vertex_2)) return;
  // Seen edge-on they span no plane on the raster, to the digits of the number format.
  const double right = (one->x - from->x) * (other->y - from->y), left = (other->x - from->x) * (one->y - from->y);
  if (std::abs(right - left) <= rounding_of_float32 * (std::abs(right) + std::abs(left))) return;
  const Place p{Place::In::vertex, e.vertex_0}, q{Place::In::vertex, e.vertex_1}, r{Place::In::vertex, e.vertex_2};
  const auto x_0 = out.number("x_0", from->x, p["x_s"]), y_0 = out.number("y_0", from->y, p["y_s"]),
             z_0 = out.number("z_0", from->z, p["z"]);
  const auto x_1 = out.number("x_1", one->x, q["x_s"]) - x_0, y_1 = out.number("y_1", one->y, q["y_s"]) - y_0,
             z_1 = out.number("z_1", one->z, q["z"]) - z_0;
  const auto x_2 = out.number("x_2", other->x, r["x_s"]) - x_0, y_2 = out.number("y_2", other->y, r["y_s"]) - y_0,
             z_2 = out.number("z_2", other->z, r["z"]) - z_0;
  out.gives(&PlaneSlopes::dz_dx, plane_slope(y_1, z_1, y_2, z_2, x_1, x_2));
  out.gives(&PlaneSlopes::dz_dy, plane_slope(x_1, z_1, x_2, z_2, y_1, y_2));
}

template <class Out>
void derive(const SpanBegin& e, const Situation& at, Out& out) {
  const ActiveEdge *left = at.active(e.left_edge), *right = at.active(e.right_edge);
  if (left && right) {
    const std::vector<ActiveEdge> active = detail::active_on(at, e.y);
    bool sorted = true;
    for (std::size_t i = 0; i + 1 < active.size(); ++i)
      sorted = sorted && (!detail::out_of_order(active, i) || out.equal(active[i].x, active[i + 1].x));
    // Where edges stand is known of a run that says how they move; and in which order, of one that says that, too.
    const bool moves = at.records<EdgeStep>(), swaps = at.records<EdgeSwap>() && detail::list_is_exact(at);
    // What was put in a wrong place stays there.
    const auto of_list = [&](Rule rule, bool holds) {
      const Place list{Place::In::active_list, 0};
      if (holds || out.trusts(list)) out.rule(rule, holds);
      else out.reads(list);
    };
    if (moves && swaps) of_list(Rule::list_in_order, sorted);
    if (moves && (sorted || !swaps))
      of_list(Rule::span_pairs,
              left != right && (at.method().keeps_all || detail::pair_of_list(at, active, *left, *right)));
    const auto is_here = [&](const ActiveEdge& one) {
      const EdgeTableInsert* entry = at.edge(one.edge);
      return moves || (entry && entry->first_row == e.y);
    };
    const Place l{Place::In::active_edge, e.left_edge}, r{Place::In::active_edge, e.right_edge};
    for (const ActiveEdge* one : {left, right}) {
      const EdgeTableInsert* entry = at.edge(one->edge);
      if (entry && moves && at.adds_slopes() && out.trusts(Place{Place::In::active_edge, one->edge}) &&
          out.trusts(Place{Place::In::edge_table, one->edge}))
        out.rule(Rule::edge_moves_once, detail::moved_once_a_line(out, *entry, *one, e.y));
    }
    if (is_here(*left)) {
      out.gives(&SpanBegin::x_left, out.number("x of the left edge", left->x, l["x_edge"]));
      out.gives(&SpanBegin::z_left, out.number("z of the left edge", left->z, l["z_edge"]));
    }
    if (is_here(*right)) {
      out.gives(&SpanBegin::x_right, out.number("x of the right edge", right->x, r["x_edge"]));
      out.gives(&SpanBegin::z_right, out.number("z of the right edge", right->z, r["z_edge"]));
    }
  }
  if (at.method().scan_line) out.rule(Rule::span_line, *at.method().scan_line == e.y);
  const auto ended = [&](std::int32_t edge) {
    const EdgeTableInsert* entry = at.edge(edge);
    return entry && entry->end_row <= e.y;
  };
  bool none_ended = !ended(e.left_edge) && !ended(e.right_edge);
  if (!at.method().keeps_all && at.tells_leaving())
    for (const ActiveEdge& active : at.method().active) none_ended = none_ended && !ended(active.edge);
  out.rule(Rule::edge_left_behind, none_ended);
  const std::int32_t width = at.scene.raster.width;
  const Place event{};
  const auto x_left = out.number("x_L", e.x_left, event["x_left"]),
             x_right = out.number("x_R", e.x_right, event["x_right"]);
  const auto first_within = [&](Conventions::Coverage coverage) {
    return std::max(0, limited_column(first_pixel(e.x_left, coverage), width));
  };
  const auto last_within = [&](Conventions::Coverage coverage) {
    return limited_column(last_pixel(e.x_right, coverage) + 1, width) - 1;
  };
  const Conventions::Coverage coverage = coverage_of(at.header, [&](Conventions::Coverage which) {
    return first_within(which) == e.first && last_within(which) == e.last;
  });
  out.whole(&SpanBegin::first, first_pixel(x_left, coverage), first_within(coverage));
  out.whole(&SpanBegin::last, last_pixel(x_right, coverage), last_within(coverage));
  if (e.x_right == e.x_left) return;
  out.gives(&SpanBegin::dz_dx, slope(out.number("z_L", e.z_left, event["z_left"]),
                                     out.number("z_R", e.z_right, event["z_right"]), x_left, x_right));
}

// The scan-line method: flags, intervals, implied edges (002, "Scan Line Algorithm").

template <class Out>
void derive(const FlagFlip& e, const Situation& at, Out& out) {
  const auto& inside = at.method().sweep.inside;
  out.is(&FlagFlip::inside, std::find(inside.begin(), inside.end(), e.piece) == inside.end());
  const EdgeTableInsert* edge = at.edge(e.edge);
  const Piece* piece = at.piece(e.piece);
  if (at.method().enters_told && at.records<PieceMake>())
    out.rule(Rule::flip_own_edge, edge && piece && edge->polygon == piece->polygon && at.active(e.edge));
}

template <class Out>
void derive(const SpanFlags& e, const Situation& at, Out& out) {
  if (at.records<FlagFlip>()) out.is(&SpanFlags::flags, size32(at.method().sweep.inside));
  if (at.method().scan_line) out.rule(Rule::span_line, *at.method().scan_line == e.y);
  // From the edge at which a flag flipped last to the next one, as far as the raster goes.
  const bool moves = at.records<EdgeStep>() && at.tells_leaving(), swaps = at.records<EdgeSwap>();
  std::vector<ActiveEdge> active = moves ? at.method().active : std::vector<ActiveEdge>{};
  if (!swaps)
    std::stable_sort(active.begin(), active.end(),
                     [](const ActiveEdge& one, const ActiveEdge& other) { return one.x < other.x; });
  const auto& flip = at.method().sweep.flip;
  const std::int32_t width = at.scene.raster.width;
  for (std::size_t i = 0; flip && i + 1 < active.size(); ++i) {
    if (active[i].edge != flip->edge) continue;
    const double left = active[i].x, right = active[i + 1].x;
    if (!swaps && (left == right || (i > 0 && active[i - 1].x == left))) continue;  // either may stand first
    for (const std::size_t side : {i, i + 1}) out.reads(Place{Place::In::active_edge, active[side].edge});
    out.rule(Rule::list_in_order, left <= right || out.equal(left, right));
    out.near(&SpanFlags::x_left, nearest_of(e.x_left, {std::max(left, -0.5), left, std::max(left, 0.0)}));
    out.near(&SpanFlags::x_right,
             nearest_of(e.x_right, {std::min(right, width - 0.5), right, std::min<double>(right, width)}));
  }
  const Conventions::Coverage coverage = at.header.conventions.coverage;
  out.is(&SpanFlags::first, std::max(0, limited_column(first_pixel(e.x_left, coverage), width)));
  out.is(&SpanFlags::last, limited_column(last_pixel(e.x_right, coverage) + 1, width) - 1);
}

template <class Out>
void derive(const SpanWinner& e, const Situation& at, Out& out) {
  const Sweep& sweep = at.method().sweep;
  if (!sweep.interval) return;
  if (at.records<FlagFlip>())
    out.rule(Rule::winner_inside, std::find(sweep.inside.begin(), sweep.inside.end(), e.piece) != sweep.inside.end());
  const bool within = e.first >= sweep.interval->first && e.last <= sweep.interval->last;
  out.rule(Rule::pixel_in_span, e.first > e.last || within);
}

/// x where the depths of two planes are equal on a scan line.
template <class T>
T where_planes_meet(const T& a_1, const T& b_1, const T& c_1, const T& d_1, const T& a_2, const T& b_2, const T& c_2,
                    const T& d_2, const T& y) {
  return -((b_2 / c_2 - b_1 / c_1) * y + (d_2 / c_2 - d_1 / c_1)) / (a_2 / c_2 - a_1 / c_1);
}

template <class Out>
void derive(const ImpliedEdge& e, const Situation& at, Out& out) {
  const auto plane = detail::plane_of(out, at, e.piece);
  if (!plane || !at.method().scan_line) return;
  out.gives(&ImpliedEdge::z, plane_depth(plane->a, plane->b, plane->c, plane->d, out.number("x", e.x_at, Place{}),
                                         out.number("y", *at.method().scan_line, Place{})));
  const Piece *one = at.piece(e.piece), *other = at.piece(e.other);
  if (!one->plane || !other || !other->plane) return;
  const PlaneEquation &p = *one->plane, &q = *other->plane;
  if (q.plane_a / q.plane_c == p.plane_a / p.plane_c) return;
  const auto x = where_planes_meet<Rounded>(p.plane_a, p.plane_b, p.plane_c, p.plane_d, q.plane_a, q.plane_b, q.plane_c,
                                            q.plane_d, Rounded(*at.method().scan_line, 0));
  const auto& interval = at.method().sweep.interval;
  // Seen from an end of the interval at which they are as good as equal, it is there.
  if (interval) out.near(&ImpliedEdge::x_at, nearest_of(e.x_at, {x, interval->x_left, interval->x_right}));
}

}  // namespace zstep::formulas
