// Mistakes of the scan-line method: its flags, and which of the polygons that are in is seen (002).
#pragma once

#include <algorithm>
#include <set>
#include <span>
#include <string_view>

#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/mistakes/of_edges.hpp"
#include "traces/mistakes/of_pixels.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace detail {

/// How many of these edges of a polygon lie at the x of another one of them, as at a vertex that they share?
inline int at_shared_vertices(const Situation& at, std::span<const ActiveEdge> passed, std::int32_t polygon) {
  std::set<double> places;
  int count = 0;
  for (const ActiveEdge& one : passed)
    if (const EdgeTableInsert* entry = at.edge(one.edge); entry && entry->polygon == polygon)
      count += !places.insert(one.x).second;
  return count;
}

/// Is the flag of each polygon that has passed two edges at one x as it should be after these edges? `fields`: what is
/// wrong where it is not.
inline void suppose_flags(const Situation& at, std::span<const ActiveEdge> passed, std::string_view fields,
                          Supposed& out) {
  std::set<std::int32_t> polygons, should_be, are;
  for (const ActiveEdge& one : passed)
    if (const EdgeTableInsert* entry = at.edge(one.edge)) {
      polygons.insert(entry->polygon);
      if (!should_be.erase(entry->polygon)) should_be.insert(entry->polygon);
    }
  for (const std::int32_t number : at.method().sweep.inside)
    if (const Piece* piece = at.piece(number)) are.insert(piece->polygon);
  for (const std::int32_t polygon : polygons)
    if (const int missed = at_shared_vertices(at, passed, polygon); missed > 0) {
      // Who misses two of them has the right flag again.
      const bool right = should_be.contains(polygon) == are.contains(polygon);
      out.says(flag_missed, right == (missed % 2 == 0), right, fields);
    }
}

}  // namespace detail

namespace detail {

/// How a piece lies to the others whose flags are true, at a column: nearer than all of them, or farther?
struct AmongPieces {
  bool nearest = true, farthest = true, known = true;
};
inline AmongPieces among_pieces(const Situation& at, const Piece& seen, double x, const Supposed& out) {
  const double y = *at.method().scan_line, z = formulas::plane_depth(*seen.plane, x, y);
  AmongPieces found;
  for (const std::int32_t number : at.method().sweep.inside) {
    const Piece* piece = at.piece(number);
    if (!piece || !piece->plane) return {false, false, false};
    const double other = formulas::plane_depth(*piece->plane, x, y);
    if (!out.equal(other, Rounded(z))) (other < z ? found.nearest : found.farthest) = false;
  }
  return found;
}

/// An edge that is still used on a scan line which it does not meet.
inline void suppose_ended(const Situation& at, std::int32_t y, Supposed& out) {
  if (any_ended(at, y, 0))
    for (const Mistake mistake : {retired_one_late, never_retired}) out.says(mistake, true, false);
}

}  // namespace detail

inline void suppose(const SpanFlags& e, const Situation& at, Supposed& out) {
  detail::suppose_ends(e, at, out);
  const auto& active = at.method().active;
  const auto& flip = at.method().sweep.flip;
  if (!flip) return;
  const auto here =
      std::find_if(active.begin(), active.end(), [&](const ActiveEdge& one) { return one.edge == flip->edge; });
  if (here == active.end()) return;
  const bool sorted = std::is_sorted(active.begin(), active.end(), [](auto& a, auto& b) { return a.x < b.x; });
  if (!sorted && here + 1 != active.end() && out.equal(e.x_right, Rounded((here + 1)->x)))
    out.says(not_sorted, true, false, "x_right first last");
  // All edges up to here, those at the same place among them.
  auto beyond = here + 1;
  while (beyond != active.end() && beyond->x == here->x) ++beyond;
  // Who leaves out an edge goes from the one before it to the one behind it.
  const bool to_the_next = beyond != here + 1 && beyond != active.end() && out.equal(e.x_right, Rounded(beyond->x));
  detail::suppose_flags(at, std::span(active.begin(), beyond), to_the_next ? "x_right" : "", out);
}

inline void suppose(const ScanLineBegin& e, const Situation& at, Supposed& out) {
  detail::suppose_closed(at, out);
  detail::suppose_last_written(at, out);
  detail::suppose_retired(true, out);
  if (at.method().sweep.flip) detail::suppose_flags(at, at.method().active, "", out);  // of the line before
  if (detail::any_ended(at, e.y, 1)) {
    out.says(never_retired, true, false);
    out.says(retired_one_late, !detail::any_ended(at, e.y, 2), false);
  }
}

inline void suppose(const PlaneEquation& e, const Situation& at, Supposed& out) {
  const Piece* piece = at.piece(e.piece);
  const auto plane = piece ? formulas::detail::own_plane(at, *piece) : std::nullopt;
  if (!plane) return;
  const Rounded d = plane->as_long_as({e.plane_a, e.plane_b, e.plane_c}).d;
  if (!out.equal(d.value, Rounded(0.0, d.spread))) out.number(plane_d_sign, "plane_d", e.plane_d, {-d}, d);
}

inline void suppose(const FlagFlip&, const Situation& at, Supposed& out) {
  detail::suppose_retired(true, out);
  if (at.method().scan_line) detail::suppose_ended(at, *at.method().scan_line, out);
}

inline void suppose(const SpanWinner& e, const Situation& at, Supposed& out) {
  const auto& sweep = at.method().sweep;
  const Piece* seen = at.piece(e.piece);
  if (sweep.inside.size() < 2 || e.first > e.last || !at.method().scan_line || !seen || !seen->plane) return;
  const detail::AmongPieces first = detail::among_pieces(at, *seen, e.first, out),
                            last = detail::among_pieces(at, *seen, e.last, out);
  if (!first.known || !last.known) return;
  out.says(wrong_of_two, first.farthest && last.farthest, first.nearest && last.nearest);
  if (!sweep.interval || e.first != sweep.interval->first) return;
  const detail::AmongPieces left = detail::among_pieces(at, *seen, sweep.interval->x_left, out);
  if (!left.nearest || left.farthest) return;
  const bool to_the_end = e.last == sweep.interval->last;
  out.says(implied_edge_missed, to_the_end, last.nearest || !to_the_end);
}

}  // namespace zstep::mistakes
