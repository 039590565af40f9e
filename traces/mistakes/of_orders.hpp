// Mistakes with the order of painting: depth sort's list and tests (002), the tree and the way through it (001, 003).
#pragma once

#include <algorithm>

#include "traces/formulas/outlines.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace detail {

inline bool was_drawn(const Situation& at, std::int32_t piece) {
  const auto& drawn = at.method().drawn;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (drawn[i] == piece) return true;
  return false;
}

/// Tests 3 and 4 of a pair: what the run did after a side was found, and what it should have done.
inline void suppose_after_side(const Situation& at, Supposed& out, bool passed) {
  const auto& pair = at.method().pair;
  if (!out.side || !pair) return;
  const SideTest test = *out.side;
  out.side.reset();
  const bool third = test.piece == pair->piece && test.plane_of == pair->other,
             fourth = test.piece == pair->other && test.plane_of == pair->piece;
  if (!third && !fourth) return;
  const bool behind = test.side == Side::behind, front = test.side == Side::front;
  if (!behind && !front) return;
  const bool right = third ? behind : front;
  out.says(tests_3_4_swapped, passed != right, passed == right);
}

/// A piece gets into the tree under a plane that it is on both sides of.
inline void suppose_placed(std::int32_t piece, Supposed& out) {
  if (out.spanning.erase(piece)) out.says(spanning_not_split, true, false);
}

/// The node that holds a piece.
inline const TreeNode* node_of(const Situation& at, std::int32_t piece) {
  const auto& tree = at.method().tree;
  for (std::size_t i = 0; i < tree.size(); ++i)
    if (std::find(tree[i].pieces.begin(), tree[i].pieces.end(), piece) != tree[i].pieces.end()) return &tree[i];
  return nullptr;
}

}  // namespace detail

inline void suppose(const ListInsert& e, const Situation& at, Supposed& out) {
  if (at.method().pair) return;  // later pieces are moved, too, and not to where they belong by depth
  const Piece* piece = at.piece(e.piece);
  const auto& list = at.method().list;
  const auto place = static_cast<std::size_t>(e.place);
  if (!piece || !piece->extent || e.place < 0 || place > list.size()) return;
  const auto extent_at = [&](std::size_t which) -> const Extent* {
    const Piece* other = at.piece(list[which].piece);
    return other && other->extent ? &*other->extent : nullptr;
  };
  const Extent* before = place > 0 ? extent_at(place - 1) : nullptr;
  const Extent* after = place < list.size() ? extent_at(place) : nullptr;
  const Extent& own = *piece->extent;
  const auto in_order = [&](double Extent::*by) {
    return (!before || before->*by >= own.*by) && (!after || own.*by >= after->*by);
  };
  const bool right = in_order(&Extent::z_max);
  out.says(sorted_by_nearest, in_order(&Extent::z_min), right);
  const bool tie = (before && before->z_max == own.z_max) || (after && after->z_max == own.z_max);
  if (tie) out.says(ties_unstable, after && after->z_max == own.z_max, !(after && after->z_max == own.z_max));
}

inline void suppose(const PairBegin&, const Situation& at, Supposed& out) { detail::suppose_after_side(at, out, true); }
inline void suppose(const OverlapTest&, const Situation& at, Supposed& out) {
  detail::suppose_after_side(at, out, false);
}

inline void suppose(const SideTest& e, const Situation& at, Supposed& out) {
  detail::suppose_after_side(at, out, false);
  out.side = e;
  if (at.method().list.empty() && e.side == Side::crossing) out.spanning.insert(e.piece);
}

inline void suppose(const PieceMake& e, const Situation&, Supposed& out) {
  if (out.spanning.erase(e.parent)) out.says(spanning_not_split, false, true);
}

inline void suppose(const PieceDraw& e, const Situation& at, Supposed& out) {
  detail::suppose_after_side(at, out, true);
  if (const Piece* piece = at.piece(e.piece); piece && piece->parent >= 0) out.says(pieces_lost, false, true);
  // Of a node, all that lies on the other side than the eye is painted before, and what lies on the eye's side after.
  const TreeNode* node = detail::node_of(at, e.piece);
  if (!node || !node->eye) return;
  const std::int32_t near = node->eye->front ? node->front_child : node->back_child,
                     far = node->eye->front ? node->back_child : node->front_child;
  const auto is_painted = [&](std::int32_t child) {
    const auto at_child = static_cast<std::size_t>(child);
    return child >= 0 && at_child < at.method().tree.size() &&
           detail::was_drawn(at, at.method().tree[at_child].pieces.front());
  };
  const bool near_painted = is_painted(near), far_painted = is_painted(far);
  if (near_painted != far_painted) out.says(near_side_first, near_painted, far_painted);
}

inline void suppose(const NodeMake& e, const Situation&, Supposed& out) { detail::suppose_placed(e.piece, out); }
inline void suppose(const NodeAdd& e, const Situation&, Supposed& out) { detail::suppose_placed(e.piece, out); }

inline void suppose(const EyeSide& e, const Situation& at, Supposed& out) {
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
  out.number(side_by_normal, e.value, {value(0), c, -c}, value(perspective ? 1 : 0));
}

inline void suppose_at_end(const Situation& at, Supposed& out) {
  const auto& pieces = at.method().pieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto number = static_cast<std::int32_t>(i);
    if (pieces[i].parent >= 0 && !pieces[i].cut && at.has_step<ListInsert>() && !at.method().list.contains(number) &&
        !detail::was_drawn(at, number))
      out.says(pieces_lost, true, false);
  }
}

}  // namespace zstep::mistakes
