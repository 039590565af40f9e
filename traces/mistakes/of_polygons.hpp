// Mistakes on a polygon's way from the scene to its pixels: vertices and facing (000, "Viewing"; 003), edges and spans,
// depths, the compare and the two writes (000, "The algorithm").
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/mistakes/supposed.hpp"
#include "traces/scene.hpp"

namespace zstep::mistakes {

namespace detail {

/// z_v of a vertex of the scene, as its place there gives it; nothing of one that clipping has made.
inline std::optional<Rounded> true_z_v(const Situation& at, std::int32_t vertex) {
  if (!at.camera || !at.is_point(vertex)) return std::nullopt;
  const glm::dvec3& w = at.scene.points[vertex];
  const glm::dmat4& t_v = at.camera->view;
  return formulas::matrix_row<Rounded>(t_v[0][2], t_v[1][2], t_v[2][2], t_v[3][2], w.x, w.y, w.z);
}
/// Is the vertex before the near plane, and not only where a wrong z_v has put it?
inline bool is_before_near(const Situation& at, std::int32_t vertex) {
  const auto z_v = true_z_v(at, vertex);
  return z_v && z_v->value < at.camera->near * (1 - formulas::rounding_of_float32);
}

}  // namespace detail

inline void suppose(const ViewTransform& e, const Situation& at, Supposed& out) {
  if (at.on_screen()) return;
  if (const auto z_v = detail::true_z_v(at, e.vertex)) out.number(depth_axis_reversed, "z_v", e.z_v, {-*z_v}, *z_v);
}

inline void suppose(const Projection& e, const Situation& at, Supposed& out) {
  const VertexStages* vertex = at.viewed(e.vertex);
  if (!vertex || !at.camera) return;
  const Rounded z_v = vertex->view.z, d = at.camera->d;
  const bool parallel = at.camera->kind == Camera::Kind::orthographic;
  const double on_plane[2] = {e.x_p, e.y_p}, viewed[2] = {vertex->view.x, vertex->view.y};
  for (int axis = 0; axis < 2 && !parallel; ++axis) {
    const std::string_view name = axis == 0 ? "x_p" : "y_p";
    const Rounded v = viewed[axis], right = formulas::projected(d, v, z_v);
    out.number(no_divide, name, on_plane[axis], {v, d * v}, right);
    out.number(divide_twice, name, on_plane[axis], {right / z_v, d * right / z_v}, right);
  }
  if (!parallel && detail::is_before_near(at, e.vertex)) out.says(not_clipped_near, true, false);
  if (!at.header.declares(Convention::depth) || !(at.camera->near < at.camera->far)) return;
  const auto depth = at.header.conventions.depth;
  if (depth == Conventions::Depth::view) return;
  const Rounded right = formulas::vertex_depth(
      formulas::depth_scale(*at.camera, depth, [](double number) { return Rounded(number); }), z_v);
  out.number(z_v_for_depth, "z", e.z, {z_v}, right);
}

inline void suppose(const ViewportTransform& e, const Situation& at, Supposed& out) {
  const VertexStages* vertex = at.viewed(e.vertex);
  const Raster& raster = at.scene.raster;
  if (!at.camera || !vertex || vertex->stage < VertexStages::projected || !(at.camera->window > 0) ||
      raster.height <= 0 || at.header.conventions.positions != Conventions::Positions::exact)
    return;
  const Rounded height = raster.height, w_y = at.camera->window, w_x = at.camera->window * raster.width / raster.height;
  const Rounded x = formulas::screen_x(Rounded(vertex->plane.x), w_x, Rounded(raster.width), raster),
                y = formulas::screen_y(Rounded(vertex->plane.y), w_y, height, raster);
  const Rounded half = 0.5, turned = height - y - Rounded(1.0);
  out.number(y_upside_down, "y_s", e.y_s, {turned, turned + half, turned - half}, y);
  out.number(centres_half_off, "x_s", e.x_s, {x + half}, x);
  out.number(centres_half_off, "y_s", e.y_s, {y + half}, y);
}

inline void suppose(const FacingTest& e, const Situation&, Supposed& out) {
  if (e.facing == Facing::edge_on || e.view_dot_normal == 0) return;
  const Facing right = e.view_dot_normal > 0 ? Facing::back : Facing::front;
  out.says(clockwise_front, e.facing != right, e.facing == right, "facing");
}

inline void suppose(const ClipCross& e, const Situation&, Supposed& out) {
  if (e.plane == ClipPlane::near) out.rules_out(not_clipped_near);
}

// Mistakes with the edge table, the active edge list and spans (000, "The algorithm" and "Double interpolation").

namespace detail {

/// The edge goes upwards in an outline of its polygon, so that its ends have to be exchanged; false where that is not
/// known.
inline bool is_turned(const Situation& at, std::int32_t polygon, std::int32_t upper, std::int32_t lower) {
  const auto goes_up = [&](std::span<const std::int32_t> outline) {
    for (std::size_t i = 0; i < outline.size(); ++i)
      if (outline[i] == lower && outline[(i + 1) % outline.size()] == upper) return true;
    return false;
  };
  const MethodState& method = at.method();
  if (!method.keeps_all)
    return goes_up(method.outline.empty() ? formulas::detail::corners_of(at, method.facet)
                                          : std::span<const std::int32_t>(method.outline));
  // In a table of all polygons it may be the edge of another one than the last; they come in order.
  const auto any_of_polygon = [&](const auto& all, auto&& outline) {
    std::size_t first = 0;
    for (std::size_t end = all.size(); first < end;) {
      const std::size_t middle = (first + end) / 2;
      if (all[middle].polygon < polygon) first = middle + 1;
      else end = middle;
    }
    for (; first < all.size() && all[first].polygon == polygon; ++first)
      if (goes_up(outline(first))) return true;
    return false;
  };
  return any_of_polygon(method.pieces, [&](std::size_t i) { return std::span(method.pieces[i].outline); }) ||
         any_of_polygon(at.scene.facets, [&](std::size_t i) { return formulas::detail::corners_of(at, index32(i)); });
}

/// The edges of this polygon are done: is the one from its last vertex back to the first among them, if all others are?
/// Edges that meet no scan line need not be.
inline void suppose_closed(const Situation& at, Supposed& out) {
  const std::int32_t polygon = std::exchange(out.edges_of, no_polygon);
  std::set<std::pair<std::int32_t, std::int32_t>> there;
  for (const EdgeTableInsert& entry : at.method().edge_table)
    if (entry.polygon == polygon) there.insert(std::minmax(entry.vertex_0, entry.vertex_1));
  const auto has = [&](std::int32_t one, std::int32_t other) {
    const auto a = at.on_raster(one), b = at.on_raster(other);
    const std::int32_t height = at.scene.raster.height;
    return !a || !b || formulas::row_from(a->y, height) == formulas::row_from(b->y, height) ||
           there.contains(std::minmax(one, other));
  };
  const auto look_at = [&](std::span<const std::int32_t> outline) {
    if (outline.size() < 3) return;
    for (std::size_t i = 0; i + 1 < outline.size(); ++i)
      if (!has(outline[i], outline[i + 1])) return;
    const bool closed = has(outline.back(), outline.front());
    out.says(closing_edge_missed, !closed, closed);
  };
  if (polygon == no_polygon) return;
  if (at.method().pieces.empty() && at.method().polygon == polygon) look_at(at.method().outline);
  for (const Piece& piece : at.method().pieces)
    if (piece.polygon == polygon && piece.parent < 0) look_at(piece.outline);
}

/// What is no number is none of the whole numbers that a column or a row may be.
inline std::int32_t whole_of(double x) {
  constexpr double most = 1e9;
  if (std::isnan(x)) return std::numeric_limits<std::int32_t>::min();
  return static_cast<std::int32_t>(std::clamp(x, -most, most));
}

/// Edges in the list that have ended by so many scan lines, or more, when work on a line begins.
inline bool any_ended(const Situation& at, std::int32_t y, std::int32_t lines) {
  const auto& active = at.method().active;
  return std::any_of(active.begin(), active.end(), [&](const ActiveEdge& one) {
    const EdgeTableInsert* entry = at.edge(one.edge);
    return entry && entry->end_row + lines <= y;
  });
}

/// Edges have left the list, and another step comes. Who never retires one may still empty the list at the end, edges
/// that ended long before together with the last ones.
inline void suppose_retired(bool goes_on, Supposed& out) {
  const bool late = std::exchange(out.retired_late, false), in_time = std::exchange(out.retired_in_time, false);
  if (goes_on ? late || in_time : in_time && !late) out.says(never_retired, false, true);
}

/// The list is out of order, and the span lies between two neighbours as if it were not.
inline bool paired_unsorted(const Situation& at, const SpanBegin& e) {
  const auto& active = at.method().active;
  const bool sorted =
      std::is_sorted(active.begin(), active.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  for (std::size_t place = 0; !sorted && place + 1 < active.size(); place += 2)
    if (active[place].edge == e.left_edge && active[place + 1].edge == e.right_edge) return true;
  return false;
}

/// Of a span, or of an interval between edges.
template <class E>
inline void suppose_ends(const E& e, const Situation& at, Supposed& out) {
  const std::int32_t width = at.scene.raster.width;
  const Conventions::Coverage coverage = at.header.conventions.coverage;
  const std::int32_t first = std::max(0, formulas::limited_column(formulas::first_pixel(e.x_left, coverage), width)),
                     last = formulas::limited_column(formulas::last_pixel(e.x_right, coverage) + 1, width) - 1;
  const auto is = [&](std::int32_t recorded, double whole) {
    const std::int32_t made = whole_of(whole);
    return recorded == made || recorded == std::clamp(made, 0, width - 1);
  };
  const bool right = e.first == first && e.last == last;
  out.says(right_end_included,
           e.first == first &&
               (is(e.last, last + 1) || is(e.last, std::floor(e.x_right)) || is(e.last, std::floor(e.x_right) + 1)),
           right, "last");
  out.says(left_end_excluded, (is(e.first, first + 1) || is(e.first, std::floor(e.x_left) + 1)) && e.last == last,
           right, "first");
  out.says(
      ends_rounded,
      is(e.first, std::round(e.x_left)) && (is(e.last, std::round(e.x_right)) || is(e.last, std::round(e.x_right) - 1)),
      right, "first last");
  out.says(
      ends_truncated,
      is(e.first, std::trunc(e.x_left)) && (is(e.last, std::trunc(e.x_right)) || is(e.last, std::trunc(e.x_right) - 1)),
      right, "first last");
}

}  // namespace detail

inline void suppose(const EdgeTableInsert& e, const Situation& at, Supposed& out) {
  if (e.polygon != out.edges_of) detail::suppose_closed(at, out);
  out.edges_of = e.polygon;
  const auto a = at.on_raster(e.vertex_0), b = at.on_raster(e.vertex_1);
  if (!a || !b) return;
  if (a->y == b->y) return out.says(horizontal_inserted, true, false, Supposed::whole_step);
  const bool other_way = a->y > b->y;
  const OnRaster &p = other_way ? *b : *a, &q = other_way ? *a : *b;
  const std::int32_t upper = other_way ? e.vertex_1 : e.vertex_0, lower = other_way ? e.vertex_0 : e.vertex_1;
  const std::int32_t height = at.scene.raster.height;

  const std::int32_t end = formulas::row_from(q.y, height);
  const std::int32_t past =
      formulas::may_include_end(at.header) ? formulas::row_from(std::floor(q.y) + 1, height) : end;
  if (past == end || at.header.declares(Convention::coverage))
    out.whole(ends_one_late, "end_row", e.end_row, {end + 1, detail::whole_of(std::floor(q.y)) + 1}, {end, past});
  const std::int32_t begin = formulas::row_from(p.y, height);
  out.whole(starts_one_early, "first_row", e.first_row,
            {std::max(0, detail::whole_of(std::floor(p.y))), std::max(0, begin - 1)}, {begin});

  const Rounded x_0 = p.x, y_0 = p.y, z_0 = p.z, x_1 = q.x, y_1 = q.y, z_1 = q.z, row = e.first_row;
  const Rounded dx_dy = formulas::slope(x_0, x_1, y_0, y_1), dz_dy = formulas::slope(z_0, z_1, y_0, y_1);
  if (p.x != q.x) out.number(slope_inverted, "dx_dy", e.dx_dy, {formulas::slope(y_0, y_1, x_0, x_1)}, dx_dy);
  out.number(
      slope_whole, "dx_dy", e.dx_dy,
      {std::trunc(dx_dy.value), std::floor(dx_dy.value), std::trunc(std::trunc(q.x - p.x) / std::trunc(q.y - p.y))},
      dx_dy);
  out.number(z_slope_of_x, "dz_dy", e.dz_dy, {Rounded(e.dx_dy)}, dz_dy);
  const Rounded z = formulas::on_line(z_0, z_1, row, y_0, y_1);
  out.follows("x_edge", "dx_dy", e.x_edge, x_0 + Rounded(e.dx_dy) * (row - y_0));
  for (const Rounded& from : {z_0, z_1})
    out.follows("z_edge", "dz_dy", e.z_edge, from + Rounded(e.dz_dy) * (row - y_0));
  const bool turned = detail::is_turned(at, e.polygon, upper, lower);
  if (turned) {
    out.number(z_not_swapped, "dz_dy", e.dz_dy, {-dz_dy}, dz_dy);
    out.number(z_not_swapped, "z_edge", e.z_edge, {formulas::on_line(z_1, z_0, row, y_0, y_1)}, z);
  }
  const auto slope_of_x = [&](auto made) {
    const Rounded slope = made(slope_inverted) && p.x != q.x ? formulas::slope(y_0, y_1, x_0, x_1) : dx_dy;
    return made(slope_whole) ? Rounded(std::trunc(slope.value)) : slope;
  };
  out.together("dx_dy", e.dx_dy, {slope_inverted, slope_whole}, slope_of_x);
  out.together("dz_dy", e.dz_dy, {z_slope_of_x, slope_inverted, slope_whole, z_not_swapped}, [&](auto made) {
    const Rounded slope = made(z_slope_of_x) ? slope_of_x(made) : dz_dy;
    return made(z_not_swapped) && turned ? -slope : slope;
  });
  const auto z_from = [&](const Rounded& from, const Rounded& to, auto made) {
    const bool other = made(z_not_swapped) && turned;
    if (made(z_at_vertex)) return other ? to : from;
    return other ? formulas::on_line(to, from, row, y_0, y_1) : formulas::on_line(from, to, row, y_0, y_1);
  };
  out.together("z_edge", e.z_edge, {z_not_swapped, z_at_vertex}, [&](auto made) { return z_from(z_0, z_1, made); });
  out.number(x_at_vertex, "x_edge", e.x_edge, {x_0}, formulas::on_line(x_0, x_1, row, y_0, y_1));
  out.number(z_at_vertex, "z_edge", e.z_edge, {z_0}, z);
  const VertexStages *from = at.viewed(upper), *to = at.viewed(lower);
  if (!from || !to || !at.camera) return;
  if (at.header.conventions.depth != Conventions::Depth::view)
    out.together("z_edge", e.z_edge, {z_v_for_depth, z_not_swapped, z_at_vertex}, [&](auto made) {
      return made(z_v_for_depth) ? z_from(from->view.z, to->view.z, made) : z_from(z_0, z_1, made);
    });
  if (at.header.conventions.depth != Conventions::Depth::view)
    out.number(z_v_for_depth, "z_edge", e.z_edge,
               {formulas::on_line(Rounded(from->view.z), Rounded(to->view.z), row, y_0, y_1)}, z);
  const bool before = detail::is_before_near(at, upper) || detail::is_before_near(at, lower);
  out.says(not_clipped_near, before, !before);
}

inline void suppose(const EdgeTableSkip& e, const Situation&, Supposed& out) {
  if (e.why == EdgeSkip::horizontal) out.says(horizontal_inserted, false, true);
}

inline void suppose(const EdgeRetire& e, const Situation& at, Supposed& out) {
  const EdgeTableInsert* entry = at.edge(e.edge);
  if (!entry || !at.method().scan_line) return;
  const std::int32_t y = *at.method().scan_line;
  (y > entry->end_row + 1 ? out.retired_late : out.retired_in_time) = true;
  out.says(retired_one_late, y == entry->end_row + 1, y == entry->end_row || y + 1 == entry->end_row);
}

inline void suppose(const EdgeStep& e, const Situation& at, Supposed& out) {
  const EdgeTableInsert* entry = at.edge(e.edge);
  const ActiveEdge* active = at.active(e.edge);
  if (!entry || !active || !at.method().scan_line) return;
  if (*at.method().scan_line == entry->first_row) out.says(stepped_too_early, true, false);
  const Rounded x = active->x, dx = entry->dx_dy, z = active->z, dz = entry->dz_dy;
  Rounded right_x = x + dx, right_z = z + dz;
  if (!at.adds_slopes()) {
    const auto a = at.on_raster(entry->vertex_0), b = at.on_raster(entry->vertex_1);
    if (!a || !b) return;
    const Rounded y = *at.method().scan_line;
    right_x = formulas::on_line(Rounded(a->x), Rounded(b->x), y, Rounded(a->y), Rounded(b->y));
    right_z = formulas::on_line(Rounded(a->z), Rounded(b->z), y, Rounded(a->y), Rounded(b->y));
  }
  out.number(rounded_then_stepped, "x_edge", e.x_edge,
             {std::round((x + dx).value), std::trunc((x + dx).value), std::floor((x + dx).value)}, right_x);
  out.number(z_not_carried, "z_edge", e.z_edge, {z}, right_z);
  out.sum_in_float32("x_edge", e.x_edge, active->x, entry->dx_dy, right_x);
  out.sum_in_float32("z_edge", e.z_edge, active->z, entry->dz_dy, right_z);
}

inline void suppose(const EdgeSwap&, const Situation&, Supposed& out) { out.says(not_sorted, false, true); }

inline void suppose(const SpanBegin& e, const Situation& at, Supposed& out) {
  detail::suppose_retired(true, out);
  if (detail::paired_unsorted(at, e)) out.says(not_sorted, true, false);
  for (const Mistake mistake : {retired_one_late, never_retired})
    if (detail::any_ended(at, e.y, 0)) out.says(mistake, true, false);
  detail::suppose_ends(e, at, out);
  const EdgeTableInsert* left = nullptr;
  for (const std::int32_t edge : {e.right_edge, e.left_edge}) {
    const ActiveEdge* active = at.active(edge);
    const EdgeTableInsert* entry = at.edge(edge);
    if (!active || !entry) return;
    left = entry;
    if (entry->dx_dy == 0) continue;
    const double rows = e.y - entry->first_row;
    if (rows == 0)
      out.says(stepped_too_early, !out.equal(active->x, entry->x_edge), out.equal(active->x, entry->x_edge));
    const Rounded x = entry->x_edge, dx = entry->dx_dy;
    if (rows > 0) out.number(stepped_twice, "x_left", active->x, {x + Rounded(2 * rows) * dx}, x + Rounded(rows) * dx);
  }
  if (e.x_left == e.x_right) return;
  const Rounded dz_dx = formulas::slope(Rounded(e.z_left), Rounded(e.z_right), Rounded(e.x_left), Rounded(e.x_right));
  const EdgeTableInsert* right = at.edge(e.right_edge);
  out.shows(z_by_slope_of_x, "dz_dx", e.dz_dx, {Rounded(left->dx_dy), Rounded(right->dx_dy)}, dz_dx);
  out.shows(z_by_slope_of_edge, "dz_dx", e.dz_dx, {Rounded(left->dz_dy), Rounded(right->dz_dy)}, dz_dx);
}

// Mistakes with the depth of a pixel, the compare and the two writes (000, "The algorithm").

namespace detail {

/// Before another pixel's turn comes: were depth and colour of the last one written if, and only if, it was nearer?
inline void suppose_last_written(const Situation& at, Supposed& out) {
  const auto& last = at.method().fragment;
  if (!last || !last->nearer || at.method().keeps_all || at.method().polygon == no_polygon) return;
  const std::size_t pixel = at.pixel(last->x, last->y);
  const bool drawn = at.before.picture.polygon[pixel] == at.method().polygon;
  const double depth = at.before.picture.depth[pixel];
  const bool stored = depth == last->z, as_before = depth == last->stored;
  const bool was_drawn = last->stored_polygon == at.method().polygon, was_stored = last->stored == last->z;
  if (*last->nearer) {
    if (!was_stored && !at.method().compares_write && at.has_step<DepthWrite>())
      out.says(depth_not_written, as_before && drawn, stored);
    if (!was_drawn && at.records<PixelWrite>()) out.says(colour_not_written, !drawn && stored, drawn);
    return;
  }
  if (!was_drawn) out.says(colour_always, drawn, !drawn);
  if (!was_stored) out.says(depth_always, stored, !stored);
}

/// The depth that the span at work has at this pixel, and what mistakes make of it.
template <class E>
inline void suppose_depth(const E& e, const Situation& at, Supposed& out) {
  const auto span = at.span_of(e);
  if (!span) return;
  const std::int32_t other_way = at.scene.raster.height - 1 - span->y;
  if (other_way != span->y) out.says(y_upside_down, e.y == other_way, e.y == span->y);
  using enum Conventions::Interpolation;
  const auto how = at.header.conventions.interpolation;
  const bool by_span = how == direct || how == increments;
  if (e.y != span->y || span->x_left == span->x_right || !by_span ||
      at.header.conventions.depth == Conventions::Depth::corrected)
    return;
  const Rounded z_left = span->z_left, z_right = span->z_right, x_left = span->x_left, x_right = span->x_right, x = e.x,
                dz_dx = span->dz_dx;
  const Rounded directly = formulas::on_line(z_left, z_right, x, x_left, x_right);
  const Fragment* last = at.fragment(e.x - 1, e.y);
  if (span.open) {  // of several: the pixel before may be another one's
    if (span.open->x_last != e.x - 1) last = nullptr;
    if (span.is_of_other(at) || (how == increments && !last && e.x != span->first)) return;
  }
  const bool adds = how == increments && last;
  const Rounded right = adds ? Rounded(last->z) + dz_dx : directly;
  if (const EdgeTableInsert* left = at.edge(span->left_edge); left && !adds)
    out.together("z", e.z, {z_not_to_centre, z_stepped_before_use, z_by_slope_of_x, z_by_slope_of_edge},
                 [&](auto made) {
                   const Rounded slope = made(z_by_slope_of_x)      ? Rounded(left->dx_dy)
                                         : made(z_by_slope_of_edge) ? Rounded(left->dz_dy)
                                                                    : (z_right - z_left) / (x_right - x_left);
                   const Rounded from = made(z_not_to_centre) ? Rounded(span->first) : x_left,
                                 ahead = made(z_stepped_before_use) ? 1 : 0;
                   return z_left + slope * (x - from + ahead);
                 });
  if (!adds) {
    const Rounded from_first = z_left + (z_right - z_left) * (x - Rounded(span->first)) / (x_right - x_left);
    out.number(z_not_to_centre, "z", e.z, {from_first}, right);
    out.number(z_stepped_before_use, "z", e.z, {directly + dz_dx}, right);
  }
  if (!last || e.x <= span->first) return;
  const Rounded z = last->z;
  const Rounded of_first = formulas::on_line(z_left, z_right, Rounded(span->first), x_left, x_right);
  if (span->dz_dx != 0) out.number(z_kept_along_span, "z", e.z, {of_first}, right);
  if (const EdgeTableInsert* left = at.edge(span->left_edge), *beyond = at.edge(span->right_edge); left && beyond) {
    out.number(z_by_slope_of_x, "z", e.z, {z + Rounded(left->dx_dy), z + Rounded(beyond->dx_dy)}, right);
    out.number(z_by_slope_of_edge, "z", e.z, {z + Rounded(left->dz_dy), z + Rounded(beyond->dz_dy)}, right);
  }
  out.sum_in_float32("z", e.z, last->z, span->dz_dx, right);
}

/// Is a write at the pixel whose depth was compared, or with x and y exchanged?
template <class E>
inline void suppose_place(const E& e, const Situation& at, Supposed& out) {
  const auto& fragment = at.method().fragment;
  if (!fragment || fragment->x == fragment->y) return;
  if (e.x == fragment->y && e.y == fragment->x) out.says(x_y_exchanged, true, false);
}

}  // namespace detail

inline void suppose(const PolygonBegin&, const Situation& at, Supposed& out) {
  detail::suppose_last_written(at, out);
  detail::suppose_retired(false, out);
}

inline void suppose(const BuffersClear& e, const Situation& at, Supposed& out) {
  const double empty = at.header.empty_depth();
  if (e.z == 0 && empty != 0) out.says(buffer_begins_at_0, true, false, "z");
  if (e.z == empty && empty != 0) out.rules_out(buffer_begins_at_0);
  // A method that compares no depths can clear its buffers when it likes.
  if (at.before.position > 0 && at.method().polygon != no_polygon && at.has_step<DepthCompare>())
    out.says(buffer_reset, true, false);
}

inline void suppose(const DepthInterpolate& e, const Situation& at, Supposed& out) {
  detail::suppose_last_written(at, out);
  detail::suppose_depth(e, at, out);
}

inline void suppose(const DepthCompare& e, const Situation& at, Supposed& out) {
  if (!at.records<DepthInterpolate>()) {
    detail::suppose_last_written(at, out);
    detail::suppose_depth(e, at, out);
  }
  const double stored = at.stored(e.x, e.y);
  const Comparison& comparison = at.header.comparison;
  const bool wins = comparison.wins(e.z, stored), right = e.nearer == wins;
  const bool tie = e.z == stored || out.equal(e.z, Rounded(stored));
  const std::int32_t drawn = at.before.picture.polygon[at.pixel(e.x, e.y)];
  out.says(equal_wins, tie ? e.nearer : right, right, "nearer");
  auto& line = out.one_line;
  if (line.empty()) line.assign(at.scene.raster.width, at.header.empty_depth());
  double& last = line[e.x];
  const bool wins_on_line = comparison.wins(e.z, last);
  if (wins_on_line) last = e.z;
  out.says(buffer_of_one_line, e.nearer == wins_on_line, right, "nearer");
  const bool draws = at.records<PixelWrite>();
  // Where pixels are not written the run says only who won there last, if it says which polygon is at work.
  auto& winners = out.winners;
  if (winners.empty()) winners.assign(at.before.picture.polygon.size(), no_polygon);
  std::int32_t& winner = winners[at.pixel(e.x, e.y)];
  const std::int32_t here = at.method().polygon;
  const bool of_other = draws ? drawn != no_polygon && drawn != here
                              : stored != at.header.empty_depth() && (here == no_polygon || winner != here);
  if (e.nearer) winner = here;
  out.says(buffer_reset, of_other ? e.nearer : right, right, "nearer");
  if (tie) return;
  const bool empty = draws ? drawn == no_polygon : stored == at.header.empty_depth();
  // Against nothing, a reversed compare either always loses or has a case of its own.
  if (empty) (e.nearer ? out.won_empty : out.lost_empty) = true;
  if (out.won_empty && out.lost_empty) out.rules_out(compare_reversed);
  // Where the run does not say what the buffer was cleared to, one that was cleared to 0 loses as well.
  const bool either = empty && !at.records<BuffersClear>();
  if (!either && (!empty || !right)) out.says(compare_reversed, !right, right, "nearer");
  if (either) {
  } else if (empty && e.nearer == comparison.wins(e.z, 0)) out.says(buffer_begins_at_0, true, right, "nearer");
  else if (empty) out.rules_out(buffer_begins_at_0);
}

inline void suppose(const DepthWrite& e, const Situation& at, Supposed& out) {
  detail::suppose_place(e, at, out);
  const Fragment* fragment = at.fragment(e.x, e.y);
  if (!fragment) return;
  out.says(written_before_test, !fragment->nearer, fragment->nearer.has_value());
  if (fragment->nearer) out.says(depth_always, true, *fragment->nearer);
}

inline void suppose(const PixelPaint& e, const Situation& at, Supposed& out) {
  const auto& winners = at.method().sweep.winners;
  if (winners.empty()) return;
  const SpanWinner& seen = winners.back();
  const Piece* piece = at.piece(seen.piece);
  if (!piece || !piece->plane || e.x <= seen.first || e.x > seen.last || at.method().scan_line != e.y) return;
  const PlaneEquation& plane = *piece->plane;
  const auto depth = [&](double x) {
    return formulas::plane_depth<Rounded>(plane.plane_a, plane.plane_b, plane.plane_c, plane.plane_d, x, e.y);
  };
  out.number(z_kept_along_span, "z", e.z, {depth(seen.first)}, depth(e.x));
}

inline void suppose(const PixelWrite& e, const Situation& at, Supposed& out) {
  detail::suppose_place(e, at, out);
  const Fragment* fragment = at.fragment(e.x, e.y);
  if (!fragment) return out.says(colour_not_written, false, true);  // beside the pixel at work, but written it is
  if (!fragment->nearer) return;
  out.says(colour_always, true, *fragment->nearer);
  out.says(colour_not_written, false, true);
}

}  // namespace zstep::mistakes
