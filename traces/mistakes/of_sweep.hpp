// Mistakes of the scan-line method: its flags, and which of the polygons that are in is seen (002).
#pragma once

#include <algorithm>
#include <set>

#include "traces/formulas/outlines.hpp"
#include "traces/mistakes/of_edges.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace detail {

/// Does the polygon of this piece have two of these edges at one x, as at a vertex that they share?
inline bool shares_vertex(const Situation& at, std::span<const ActiveEdge> passed, std::int32_t polygon) {
  std::set<double> places;
  for (const ActiveEdge& one : passed)
    if (const EdgeTableInsert* entry = at.edge(one.edge); entry && entry->polygon == polygon)
      if (!places.insert(one.x).second) return true;
  return false;
}

/// Is the flag of each polygon that has passed two edges at one x as it should be after these edges?
inline void suppose_flags(const Situation& at, std::span<const ActiveEdge> passed, Supposed& out) {
  std::set<std::int32_t> polygons, should_be, are;
  for (const ActiveEdge& one : passed)
    if (const EdgeTableInsert* entry = at.edge(one.edge)) {
      polygons.insert(entry->polygon);
      if (!should_be.erase(entry->polygon)) should_be.insert(entry->polygon);
    }
  for (const std::int32_t number : at.method().sweep.inside)
    if (const Piece* piece = at.piece(number)) are.insert(piece->polygon);
  for (const std::int32_t polygon : polygons)
    if (shares_vertex(at, passed, polygon))
      out.says(flag_missed, should_be.contains(polygon) != are.contains(polygon),
               should_be.contains(polygon) == are.contains(polygon));
}

}  // namespace detail

inline void suppose(const SpanFlags& e, const Situation& at, Supposed& out) {
  const auto& active = at.method().active;
  const auto& flip = at.method().sweep.flip;
  if (!flip) return;
  const auto here =
      std::find_if(active.begin(), active.end(), [&](const ActiveEdge& one) { return one.edge == flip->edge; });
  if (here == active.end()) return;
  const bool sorted = std::is_sorted(active.begin(), active.end(), [](auto& a, auto& b) { return a.x < b.x; });
  if (!sorted && here + 1 != active.end() && out.equal(e.x_right, Rounded((here + 1)->x)))
    out.says(not_sorted, true, false);
  // All edges up to here, those at the same place among them.
  auto beyond = here + 1;
  while (beyond != active.end() && beyond->x == here->x) ++beyond;
  detail::suppose_flags(at, std::span(active.begin(), beyond), out);
}

inline void suppose(const ScanLineBegin& e, const Situation& at, Supposed& out) {
  if (at.method().sweep.flip) detail::suppose_flags(at, at.method().active, out);  // of the line before
  if (detail::any_ended(at, e.y, 1)) out.says(never_retired, true, false);
}

inline void suppose(const SpanWinner& e, const Situation& at, Supposed& out) {
  const auto& inside = at.method().sweep.inside;
  const Piece* seen = at.piece(e.piece);
  if (inside.size() < 2 || e.first > e.last || !at.method().scan_line || !seen || !seen->plane) return;
  const double x = 0.5 * (e.first + e.last), y = *at.method().scan_line;
  const double z = formulas::plane_depth(*seen->plane, x, y);
  bool nearest = true, farthest = true;
  for (const std::int32_t number : inside) {
    const Piece* piece = at.piece(number);
    if (!piece || !piece->plane) return;
    const double other = formulas::plane_depth(*piece->plane, x, y);
    if (out.equal(other, Rounded(z))) continue;
    (other < z ? nearest : farthest) = false;
  }
  out.says(wrong_of_two, farthest, nearest);
}

}  // namespace zstep::mistakes
