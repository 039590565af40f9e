// Mistakes with what one method lives by: orders of painting and the tree, Warnock's areas, rays, horizons, the flags
// of the scan line (001 to 004).
#pragma once

#include <algorithm>
#include <numeric>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "traces/formulas/of_areas.hpp"
#include "traces/formulas/of_curves.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/of_rays.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/mistakes/of_polygons.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace detail {

/// Tests 3 and 4 of a pair: what the run did after a side was found, and what it should have done.
inline void suppose_after_side(const Situation& at, Supposed& out, bool passed) {
  const auto& pair = at.method().pair;
  if (!out.side || !pair) return;
  const SideTest test = *out.side;
  out.side.reset();
  const bool third = test.piece == pair->piece && test.plane_of == pair->other,
             fourth = test.piece == pair->other && test.plane_of == pair->piece;
  if (!third && !fourth) return;
  bool behind = test.side == Side::behind, front = test.side == Side::front;
  const bool in_plane = test.side == Side::on;
  const Piece *piece = at.piece(test.piece), *plane_of = at.piece(test.plane_of);
  if (in_plane && piece && plane_of)  // the later one of the scene counts as behind
    behind = piece->polygon >= plane_of->polygon, front = plane_of->polygon >= piece->polygon;
  if (behind == front) return;
  const bool right = third ? behind : front;
  if (in_plane) {  // no proof yet: in one plane, other mistakes give the same answer
    if (passed != right) out.note_in_plane();
    return;
  }
  if (passed != right) out.shows_since_in_plane(tests_3_4_swapped);
  out.says(tests_3_4_swapped, passed != right, passed == right);
}

/// Pieces that were cut off are in the list again when work on it goes on, or when it is over.
inline void suppose_put_back(Supposed& out) {
  for (std::size_t lost = 0; lost < out.cut_off.size(); ++lost) out.says(pieces_lost, true, false);
  out.cut_off.clear();
}

/// A piece gets into the tree under a plane that it is on both sides of.
inline void suppose_placed(std::int32_t piece, Supposed& out) {
  if (out.spanning.erase(piece)) out.says(spanning_not_split, true, false);
}

}  // namespace detail

inline void suppose(const ListInsert& e, const Situation& at, Supposed& out) {
  const bool is_part = out.cut_off.erase(e.piece) > 0;
  if (is_part) out.says(pieces_lost, false, true);
  if (at.method().pair && !is_part) return;  // others are moved, too, and not to where they belong by depth
  const Piece* piece = at.piece(e.piece);
  const auto& list = at.method().list;
  const std::size_t place = e.place;
  if (!piece || !piece->extent || e.place < 0 || place > list.size()) return;
  const auto piece_at = [&](std::size_t which) -> const Piece* {
    const Piece* other = list[which].marked ? nullptr : at.piece(list[which].piece);
    return other && other->extent ? other : nullptr;
  };
  const Piece* before = place > 0 ? piece_at(place - 1) : nullptr;
  const Piece* after = place < list.size() ? piece_at(place) : nullptr;
  const Extent& own = *piece->extent;
  const auto in_order = [&](double Extent::*by) {
    return (!before || (*before->extent).*by >= own.*by) && (!after || own.*by >= (*after->extent).*by);
  };
  if (!is_part) out.says(sorted_by_nearest, in_order(&Extent::z_min), in_order(&Extent::z_max), "place", e.place);
  // Of equals the first one of the scene has to win, so it is painted last; of its parts, the one that was made first.
  const bool tie_before = before && before->extent->z_max == own.z_max,
             tie_after = after && after->extent->z_max == own.z_max;
  if (!tie_before && !tie_after) return;
  const auto in_turn = [&](const Piece& one, std::int32_t number, const Piece& other, std::int32_t other_number) {
    if (one.polygon != other.polygon) return one.polygon > other.polygon;
    return !is_part || number > other_number;
  };
  const bool right = (!tie_before || in_turn(*before, list[place - 1].piece, *piece, e.piece)) &&
                     (!tie_after || in_turn(*piece, e.piece, *after, list[place].piece));
  // A part at the end of the list may be there for any reason.
  if (is_part && !right && !after) return;
  // A program that puts each one behind all of its depth has some of them in the right order by chance.
  out.says(ties_unstable, !right || !tie_after, right);
}

inline void suppose(const PairBegin&, const Situation& at, Supposed& out) {
  detail::suppose_after_side(at, out, true);
  detail::suppose_put_back(out);
  out.asks_other_way = false;
}
inline void suppose(const OverlapTest&, const Situation& at, Supposed& out) {
  detail::suppose_after_side(at, out, false);
  out.asks_other_way = true;
}

inline void suppose(const SideTest& e, const Situation& at, Supposed& out) {
  detail::suppose_after_side(at, out, false);
  if (!out.asks_other_way) out.side = e;
  if (at.method().list.empty() && e.side == Side::crossing) out.spanning.insert(e.piece);
}

inline void suppose(const PieceMake& e, const Situation& at, Supposed& out) {
  if (e.parent >= 0 && at.has_step<ListInsert>()) out.cut_off.insert(e.piece);
  if (out.spanning.erase(e.parent)) out.says(spanning_not_split, false, true);
}

inline void suppose(const PieceDraw&, const Situation& at, Supposed& out) {
  detail::suppose_after_side(at, out, true);
  detail::suppose_put_back(out);
}

inline void suppose(const NodeMake& e, const Situation&, Supposed& out) { detail::suppose_placed(e.piece, out); }
inline void suppose(const NodeAdd& e, const Situation&, Supposed& out) { detail::suppose_placed(e.piece, out); }

inline void suppose(const EyeSide& e, const Situation& at, Supposed& out) {
  if (const TreeNode* parent = formulas::detail::parent_of(at, e.node);
      parent && parent->eye && formulas::detail::paints_over(at) && formulas::detail::painted_last(at, *parent)) {
    const bool beyond = formulas::detail::lies_beyond(*parent, e.node);
    out.says(near_side_first, beyond, !beyond);
  }
  const std::size_t number = e.node;
  if (e.node < 0 || number >= at.method().tree.size() || !at.camera) return;
  const Piece* piece = at.piece(at.method().tree[number].pieces.front());
  if (!piece || !piece->plane) return;
  const PlaneEquation& plane = *piece->plane;
  const bool perspective = at.camera->kind == Camera::Kind::perspective;
  const glm::dvec3 eye = at.on_screen() ? glm::dvec3(0, 0, -1) : at.camera->eye;
  const auto value = [&](double w) {
    return formulas::plane_value<formulas::Rounded>(plane.plane_a, plane.plane_b, plane.plane_c, plane.plane_d * w,
                                                    eye.x, eye.y, eye.z);
  };
  const formulas::Rounded c = plane.plane_c;
  out.number(side_by_normal, "value", e.value, {value(0), c, -c, formulas::Rounded(0.0)}, value(perspective ? 1 : 0));
}

// Mistakes with Warnock's areas (002, "Warnock's Algorithm").

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
  if (e.parent < 0 || e.parent >= std::ssize(at.method().areas)) return;
  const AreaBegin& parent = at.method().areas[e.parent].entry;
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

// Mistakes with rays: which of the points that a ray meets is kept, and which boxes it is thought to meet (002).

inline void suppose(const BoxTest& e, const Situation& at, Supposed& out) {
  const RayBegin* ray = formulas::detail::ray_cast_last(at);
  const std::size_t box = e.box;
  if (!ray || e.box < 0 || box >= at.method().boxes.size()) return;
  const std::array<double, 3> way = formulas::detail::way_of(*ray);
  if (std::find(way.begin(), way.end(), 0.0) == way.end()) return;
  const formulas::detail::Passage passage = formulas::detail::passage_of(*ray, at.method().boxes[box].entry);
  const formulas::detail::Reach reach = formulas::detail::reach_of(at, *ray);
  const RayHit* kept = formulas::detail::kept_hit(at);
  const bool met = passage.enter.value < passage.leave.value && passage.leave.value > reach.least &&
                   passage.enter.value < (kept ? kept->t : reach.most);
  if (met) out.says(box_misses_at_0, !e.hit, e.hit, "t_enter t_leave hit");
}

inline void suppose(const RayHit& e, const Situation& at, Supposed& out) {
  const RayBegin* ray = formulas::detail::ray_at_work(at);
  if (!ray || formulas::detail::ray_cast_last(at) != ray) return;
  const formulas::detail::Reach reach = formulas::detail::reach_of(at, *ray);
  const RayHit* kept = formulas::detail::kept_hit(at);
  const bool nearer = !kept || e.t < kept->t;
  if (e.t < reach.least) {
    const bool kept_on = e.nearest == (e.inside && nearer);
    if (kept_on) out.says(negative_t, true, false, "nearest");
    else out.rules_out(negative_t);
  }
  if (!e.inside || e.t < reach.least || e.t > reach.most || (kept && e.t == kept->t)) return;
  out.says(nearest_by_index, e.nearest, e.nearest == nearer, "nearest");
}

// Mistakes with the floating horizon (004).

namespace detail {

/// The rows of a surface from the nearest to the farthest, where all are on one side of the eye; else none.
inline std::vector<std::int32_t> rows_from_eye(const Situation& at) {
  if (!at.scene.surface || !at.camera || at.scene.surface->columns <= 0) return {};
  const std::size_t columns = at.scene.surface->columns;
  std::vector<std::int32_t> rows(at.scene.points.size() / columns);
  std::iota(rows.begin(), rows.end(), 0);
  const auto place = [&](std::int32_t row) { return at.scene.points[static_cast<std::size_t>(row) * columns].y; };
  const double eye = at.camera->eye.y;
  const auto is_ahead = [&](std::int32_t row) {
    return at.camera->kind == Camera::Kind::perspective ? place(row) >= eye : eye <= 0;
  };
  const bool ahead = !rows.empty() && is_ahead(rows.front());
  for (const std::int32_t row : rows)
    if (is_ahead(row) != ahead) return {};
  std::stable_sort(rows.begin(), rows.end(), [&](std::int32_t one, std::int32_t other) {
    return ahead ? place(one) < place(other) : place(one) > place(other);
  });
  return rows;
}

/// On the last column the curve was seen below all before it: has the lower horizon come down there since?
inline void suppose_lower_moved(const Situation& at, Supposed& out) {
  const HorizonWork& work = at.method().horizon;
  if (!work.here || work.here->test.verdict == Horizon::hidden) return;
  const HorizonPassage& last = *work.here;
  const std::size_t column = last.test.x;
  if (last.test.x < 0 || column >= work.lower.size() || !(last.test.y_curve > last.lower)) return;
  // Who does not move it either uses it all the same, or has the upper one alone.
  for (const Mistake mistake : {lower_never_moves, only_upper})
    out.says(mistake, work.lower[column] == last.lower, work.lower[column] != last.lower);
}

}  // namespace detail

inline void suppose(const CurveBegin& e, const Situation& at, Supposed& out) {
  detail::suppose_lower_moved(at, out);
  if (e.across || (at.method().horizon.curve && at.method().horizon.curve->across)) return;
  const std::vector<std::int32_t> rows = detail::rows_from_eye(at);
  const std::size_t turn = e.curve;
  if (e.curve < 0 || turn >= rows.size()) return;
  out.whole(farthest_first, "row", e.row, {rows[rows.size() - 1 - turn]}, {rows[turn]});
}

inline void suppose(const HorizonCross& e, const Situation& at, Supposed& out) {
  const HorizonWork& work = at.method().horizon;
  if (!work.before || !work.here) return;
  const HorizonPassage &from = *work.before, &to = *work.here;
  const Rounded y_0 = from.test.y_curve, y_1 = to.test.y_curve, x_0 = from.test.x, x_1 = to.test.x;
  const Rounded d_0 = y_0 - Rounded(e.upper ? from.upper : from.lower),
                d_1 = y_1 - Rounded(e.upper ? to.upper : to.lower);
  if (!std::isfinite(d_0.value) || !std::isfinite(d_1.value)) return;
  const Rounded t = formulas::where_zero(d_0, d_1), other = formulas::where_zero(d_1, d_0);
  const auto part = [&](std::string_view field, double recorded, const Rounded& begin, const Rounded& end) {
    out.number(crossing_from_end, field, recorded, {formulas::part_of_way(begin, end, other)},
               formulas::part_of_way(begin, end, t));
  };
  part("x_at", e.x_at, x_0, x_1);
  part("y_at", e.y_at, y_0, y_1);
}

inline void suppose(const ColorWrite& e, const Situation& at, Supposed& out) {
  const auto drawn = formulas::detail::drawn_of_curve(at, e);
  const HorizonWork& work = at.method().horizon;
  if (!drawn.known || !drawn.part || !work.here) return;
  // Where both parts meet, either ink may be right.
  const Horizon where = work.here->test.verdict;
  if (where == Horizon::hidden || (work.before && work.before->test.verdict != where)) return;
  const auto is = [&](Horizon of) {
    const Color ink = formulas::detail::ink_of_curve(at.scene.background, of);
    return ink.red == e.r8 && ink.green == e.g8 && ink.blue == e.b8;
  };
  out.says(one_ink, is(Horizon::above), is(where), "r8 g8 b8");
}

inline void suppose(const HorizonTest& e, const Situation& at, Supposed& out) {
  detail::suppose_lower_moved(at, out);
  const HorizonWork& work = at.method().horizon;
  const std::size_t column = e.x;
  if (work.segment) {
    const auto a = at.on_raster(work.segment->vertex_0), b = at.on_raster(work.segment->vertex_1);
    if (a && b && a->x != b->x && e.x > std::min(a->x, b->x) && e.x < std::max(a->x, b->x))
      out.number(not_interpolated, "y_curve", e.y_curve, {Rounded(a->y), Rounded(b->y)},
                 formulas::on_line(Rounded(a->y), Rounded(b->y), Rounded(e.x), Rounded(a->x), Rounded(b->x)));
  }
  if (e.x < 0 || column >= work.upper.size() || column >= work.lower.size()) return;
  const bool above = !(e.y_curve > work.upper[column]), below = !(e.y_curve < work.lower[column]);
  if (above || !below) return;
  out.says(only_upper, e.verdict == Horizon::hidden, e.verdict == Horizon::below, "verdict");
  if (e.verdict == Horizon::hidden) out.rules_out(lower_never_moves);
}

// Mistakes of the scan-line method: its flags, and which of the polygons that are in is seen (002).

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
