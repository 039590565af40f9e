// Mistakes with the depth of a pixel, the compare and the two writes (000, "The algorithm").
#pragma once

#include <cmath>

#include "traces/formulas/lines.hpp"
#include "traces/formulas/planes.hpp"
#include "traces/mistakes/of_edges.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace detail {

/// Before another pixel's turn comes: were depth and colour of the last one written if, and only if, it was nearer?
inline void suppose_last_written(const Situation& at, Supposed& out) {
  const auto& last = at.method().fragment;
  if (!last || !last->nearer || at.method().keeps_all || at.method().polygon == no_polygon) return;
  const auto pixel = static_cast<std::size_t>(at.pixel(last->x, last->y));
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
  const std::int32_t drawn = at.before.picture.polygon[static_cast<std::size_t>(at.pixel(e.x, e.y))];
  out.says(equal_wins, tie ? e.nearer : right, right, "nearer");
  auto& line = out.one_line;
  if (line.empty()) line.assign(static_cast<std::size_t>(at.scene.raster.width), at.header.empty_depth());
  double& last = line[static_cast<std::size_t>(e.x)];
  const bool wins_on_line = comparison.wins(e.z, last);
  if (wins_on_line) last = e.z;
  out.says(buffer_of_one_line, e.nearer == wins_on_line, right, "nearer");
  const bool draws = at.records<PixelWrite>();
  // Where pixels are not written the run says only who won there last, if it says which polygon is at work.
  auto& winners = out.winners;
  if (winners.empty()) winners.assign(at.before.picture.polygon.size(), no_polygon);
  std::int32_t& winner = winners[static_cast<std::size_t>(at.pixel(e.x, e.y))];
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
  if (!fragment || !fragment->nearer) return;
  out.says(colour_always, true, *fragment->nearer);
  out.says(colour_not_written, false, true);
}

}  // namespace zstep::mistakes
