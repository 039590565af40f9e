// Mistakes with Warnock's areas (002, "Warnock's Algorithm").
#pragma once

#include <algorithm>

#include "traces/formulas/of_areas.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace detail {

using formulas::detail::Interval;

/// A half that reaches one column or row into its neighbour, and one that does not.
inline void suppose_half(Interval recorded, Interval parent, std::string_view fields, Supposed& out) {
  const Interval right = formulas::detail::half_of(parent, recorded);
  const bool is_right = recorded.first == right.first && recorded.end == right.end;
  const bool into_next = recorded.first == right.first && recorded.end == right.end + 1,
             into_last = recorded.first == right.first - 1 && recorded.end == right.end;
  // Which half reaches too far is the program's; the other one says nothing.
  if (into_next || into_last) out.says(quarters_overlap, true, false, fields);
  else if (!is_right) out.says(quarters_overlap, false, false);
}

/// Is the piece in front of all others of the area, at its four corners?
inline std::optional<bool> in_front(const Situation& at, const AreaBegin& area, std::int32_t number) {
  const Piece* piece = at.piece(number);
  if (!piece || !piece->plane) return std::nullopt;
  for (const AreaBin& bin : at.method().bins) {
    if (bin.piece == number || bin.bin == Bin::disjoint) continue;
    const Piece* other = at.piece(bin.piece);
    if (!other || !other->plane) return std::nullopt;
    for (const std::int32_t x : {area.first_column, area.end_column - 1})
      for (const std::int32_t y : {area.first_row, area.end_row - 1})
        if (formulas::plane_depth(*other->plane, x, y) < formulas::plane_depth(*piece->plane, x, y)) return false;
  }
  return true;
}

}  // namespace detail

inline void suppose(const AreaBegin& e, const Situation& at, Supposed& out) {
  if (e.parent < 0 || static_cast<std::size_t>(e.parent) >= at.method().areas.size()) return;
  const AreaBegin& parent = at.method().areas[static_cast<std::size_t>(e.parent)].entry;
  detail::suppose_half({e.first_column, e.end_column}, {parent.first_column, parent.end_column},
                       "first_column end_column", out);
  detail::suppose_half({e.first_row, e.end_row}, {parent.first_row, parent.end_row}, "first_row end_row", out);
}

inline void suppose(const AreaDecide& e, const Situation& at, Supposed& out) {
  const AreaBegin* area = formulas::detail::area_at_work(at);
  if (!area) return;
  const std::int32_t columns = area->end_column - area->first_column, rows = area->end_row - area->first_row;
  const bool pixel = columns == 1 && rows == 1;
  if (!pixel && columns <= 2 && rows <= 2)
    if (e.what == AreaCase::pixel || e.what == AreaCase::subdivide)
      out.says(stops_one_early, e.what == AreaCase::pixel, e.what == AreaCase::subdivide);
  if (e.what == AreaCase::front_surrounder)
    if (const auto front = detail::in_front(at, *area, e.piece); front && !*front)
      out.says(surrounding_unchecked, true, false);
  if (e.what != AreaCase::subdivide) return;
  for (const AreaBin& bin : at.method().bins)
    if (bin.bin == Bin::surrounding) return out.says(surrounding_unchecked, false, true);
}

}  // namespace zstep::mistakes
