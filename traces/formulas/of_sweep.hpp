// The scan-line method: flags, intervals, implied edges (002, "Scan Line Algorithm").
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/facet_planes.hpp"
#include "traces/formulas/of_pieces.hpp"

namespace zstep::formulas {

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
  if (at.records<FlagFlip>()) out.is(&SpanFlags::flags, static_cast<std::int32_t>(at.method().sweep.inside.size()));
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

template <class Out>
void derive(const CoverageAdd& e, const Situation& at, Out& out) {
  double all = e.coverage;
  for (const CoverageAdd& share : at.method().sweep.covered)
    if (share.x == e.x && share.y == e.y) all += share.coverage;
  out.rule(Rule::share_of_pixel, e.coverage >= 0 && all <= 1 + rounding_of_float32);
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
