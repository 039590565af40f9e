// Mistakes with the order of painting: depth sort's list and tests (002), the tree and the way through it (001, 003).
#pragma once

#include <algorithm>

#include "traces/formulas/of_orders.hpp"
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
  const auto place = static_cast<std::size_t>(e.place);
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
  const auto number = static_cast<std::size_t>(e.node);
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

}  // namespace zstep::mistakes
