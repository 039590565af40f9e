// Planes of pieces, the sides of them, and the tree that they make (001, 003).
#pragma once

#include <algorithm>
#include <cmath>

#include "traces/file/records.hpp"
#include "traces/formulas/facet_planes.hpp"
#include "traces/formulas/follows.hpp"
#include "traces/formulas/of_pieces.hpp"

namespace zstep::formulas {

template <>
inline constexpr bool joins_things<NodeAdd> = true;

/// Does this run cut polygons in the world, and not on the raster? Vertices are then followed from there.
inline bool run_cuts_in_world(const Header& header, const Scene& scene) {
  return records<NodeMake>(header) && scene.camera.kind != Camera::Kind::screen;
}

namespace detail {

/// A step that numbers say the side of: nothing lies in front that has no value in front. Which sign is in front is the
/// method's; how near to a plane is on it, too.
inline bool may_be(Side side, double least, double greatest) {
  switch (side) {
    case Side::front:
    case Side::behind:
      return least != 0 || greatest != 0;
    case Side::crossing:
      return least < 0 && greatest > 0;
    case Side::on:
      break;
  }
  return true;
}

inline const TreeNode* parent_of(const Situation& at, std::int32_t node) {
  const auto& tree = at.method().tree;
  const auto number = static_cast<std::size_t>(node);
  if (node < 0 || number >= tree.size() || tree[number].parent < 0) return nullptr;
  return &tree[static_cast<std::size_t>(tree[number].parent)];
}
/// Does the run paint what is farther first, so that what is nearer covers it?
inline bool paints_over(const Situation& at) {
  const auto option = at.header.conventions.options.find("order");
  return option == at.header.conventions.options.end() || option->second != "front-to-back";
}
/// Does this node lie beyond its parent's plane, seen from the eye?
inline bool lies_beyond(const TreeNode& parent, std::int32_t node) {
  return parent.eye && node == (parent.eye->front ? parent.back_child : parent.front_child);
}
/// Has each piece that was made, and not cut, entered the list?
inline bool all_in_list(const MethodState& method) {
  std::int32_t number = 0;
  for (const Piece& piece : method.pieces)
    if (!method.list.contains(number++) && !piece.cut) return false;
  return true;
}
/// Is it a piece of this node that was painted last?
inline bool painted_last(const Situation& at, const TreeNode& node) {
  const auto& drawn = at.method().drawn;
  return !drawn.empty() &&
         std::find(node.pieces.begin(), node.pieces.end(), drawn[drawn.size() - 1]) != node.pieces.end();
}

}  // namespace detail

template <class Out>
void derive(const PlaneEquation& e, const Situation& at, Out& out) {
  const Piece* whole = detail::whole_of(at, at.piece(e.piece));
  if (!whole) return;
  for (const std::int32_t vertex : detail::around_piece(at, *whole)) {
    if (!detail::cutting_point(at, vertex)) return;
    out.reads(Place{Place::In::vertex, vertex});
  }
  const auto plane = detail::own_plane(at, *whole);
  if (!plane) return;
  const CornersPlane as_it = plane->as_long_as({e.plane_a, e.plane_b, e.plane_c});
  out.near(&PlaneEquation::plane_a, as_it.normal.x), out.near(&PlaneEquation::plane_b, as_it.normal.y);
  out.near(&PlaneEquation::plane_c, as_it.normal.z), out.near(&PlaneEquation::plane_d, as_it.d);
}

template <class Out>
void derive(const SideTest& e, const Situation& at, Out& out) {
  out.rule(Rule::side_is_right, e.least <= e.greatest && detail::may_be(e.side, e.least, e.greatest));
  // Of pieces in a ring any one may be cut by the plane of any other.
  if (e.side != Side::crossing) out.rule(Rule::test_of_pair, detail::of_pair(at, e.piece, e.plane_of));
  const Piece *piece = at.piece(e.piece), *plane_of = at.piece(e.plane_of);
  if (!piece || !plane_of || !plane_of->plane || piece->outline.empty()) return;
  out.reads(Place{Place::In::piece, e.plane_of});
  // Corners as they lie, or as their own plane has them; and the plane either way round.
  constexpr double far = std::numeric_limits<double>::infinity();
  Rounded least[2] = {far, far}, greatest[2] = {-far, -far};
  for (const std::int32_t vertex : piece->outline) {
    auto corner = detail::cutting_point(at, vertex);
    if (!corner) return;
    out.reads(Place{Place::In::vertex, vertex});
    for (const int own : {0, 1}) {
      if (own == 1 && piece->plane && piece->plane->plane_c != 0)
        corner->z = plane_depth(*piece->plane, corner->x, corner->y);
      const Rounded value = plane_value<Rounded>(*plane_of->plane, *corner);
      if (value.value < least[own].value) least[own] = value;
      if (value.value > greatest[own].value) greatest[own] = value;
    }
  }
  out.near(&SideTest::least, nearest_of(e.least, {least[0], least[1], -greatest[0], -greatest[1]}));
  out.near(&SideTest::greatest, nearest_of(e.greatest, {greatest[0], greatest[1], -least[0], -least[1]}));
}

template <class Out>
void derive(const OverlapTest& e, const Situation& at, Out& out) {
  out.rule(Rule::test_of_pair, detail::of_pair(at, e.piece, e.other));
  const Piece *one = at.piece(e.piece), *other = at.piece(e.other);
  if (!one || !other || !one->extent || !other->extent) return;
  if (!e.overlap) return out.rule(Rule::point_in_both, std::isnan(e.x_at) && std::isnan(e.y_at));
  const auto lies_in = [&](const Extent& extent) {
    return extent.x_min <= e.x_at && e.x_at <= extent.x_max && extent.y_min <= e.y_at && e.y_at <= extent.y_max;
  };
  out.rule(Rule::point_in_both, lies_in(*one->extent) && lies_in(*other->extent));
}

template <class Out>
void derive(const TablesBegin&, const Situation& at, Out& out) {
  out.is(&TablesBegin::polygons, static_cast<std::int32_t>(at.scene.polygons.size()));
}

/// Newell's list goes by the farthest depth, the farthest first. Pieces that were moved stand where tests put them, and
/// of equal ones any may come first. What a painter goes by is its own choice.
template <class Out>
void derive(const ListInsert& e, const Situation& at, Out& out) {
  if (!at.records<PairBegin>()) return;
  const auto& list = at.method().list;
  const auto& pair = at.method().pair;
  const Piece* own = at.piece(e.piece);
  if (pair && pair->other == e.piece) return out.is(&ListInsert::place, 0);  // it becomes the first
  if (pair || !at.method().drawn.empty()) return;                            // others are moved, too
  const auto place = static_cast<std::size_t>(e.place);
  if (!own || !own->extent || e.place < 0 || place > list.size()) return;
  const auto farther = [&](const ListEntry& one) {  // clearly farther than the piece: 1, nearer: -1; else 0
    const Piece* piece = at.piece(one.piece);
    if (one.marked || !piece || !piece->extent) return 0;
    const double z = piece->extent->z_max;
    return out.equal(z, own->extent->z_max) ? 0 : z > own->extent->z_max ? 1 : -1;
  };
  const bool fits =
      (place == 0 || farther(list[place - 1]) >= 0) && (place == list.size() || farther(list[place]) <= 0);
  std::int32_t expected = 0;
  if (!fits)
    for (auto entry = list.begin(); entry != list.end() && farther(*entry) > 0; ++entry) ++expected;
  out.is(&ListInsert::place, fits ? e.place : expected);
}

template <class Out>
void derive(const PieceMake& e, const Situation& at, Out& out) {
  if (const Piece* parent = at.piece(e.parent)) out.is(&PieceMake::polygon, parent->polygon);
  else if (at.method().polygon != no_polygon) out.is(&PieceMake::polygon, at.method().polygon);
}
template <class Out>
void derive(const PairBegin& e, const Situation& at, Out& out) {
  if (!at.records<ListInsert>() || !at.records<PieceMake>()) return;
  const MethodState& method = at.method();
  const bool first = !method.list.empty() && method.list.begin()->piece == e.piece;
  if (at.records<ListRemove>())
    out.rule(Rule::pair_in_list, first && e.other != e.piece && method.list.contains(e.other));
  if (!method.pair && method.drawn.empty()) out.rule(Rule::list_is_whole, detail::all_in_list(method));
}
template <class Out>
void derive(const PieceDraw& e, const Situation& at, Out& out) {
  if (at.records<ListInsert>() && at.records<PieceMake>() && !at.method().pair && at.method().drawn.empty())
    out.rule(Rule::list_is_whole, detail::all_in_list(at.method()));
  if (const Piece* piece = at.piece(e.piece)) out.is(&PieceDraw::polygon, piece->polygon);
}

template <class Out>
void derive(const NodeMake& e, const Situation& at, Out& out) {
  const auto parent = static_cast<std::size_t>(e.parent);
  if (e.parent < 0) return out.rule(Rule::node_is_free, at.method().tree.empty());
  if (parent >= at.method().tree.size()) return;
  const TreeNode& node = at.method().tree[parent];
  out.rule(Rule::node_is_free, (e.front ? node.front_child : node.back_child) == -1);
}

template <class Out>
void derive(const EyeSide& e, const Situation& at, Out& out) {
  out.is(&EyeSide::front, e.value > 0);
  if (const TreeNode* parent = detail::parent_of(at, e.node);
      parent && detail::paints_over(at) && detail::lies_beyond(*parent, e.node))
    out.rule(Rule::far_side_first, !detail::painted_last(at, *parent));
  const auto number = static_cast<std::size_t>(e.node);
  if (e.node < 0 || number >= at.method().tree.size() || !at.camera) return;
  const auto plane = detail::plane_of(out, at, at.method().tree[number].pieces.front());
  if (!plane) return;
  // From afar it is the direction towards the eye that counts, and w is 0.
  const glm::dvec3 eye = at.on_screen() ? glm::dvec3(0, 0, -1) : at.camera->eye;
  const Place scene{Place::In::scene, 0};
  const auto w = out.number("w", at.camera->kind == Camera::Kind::perspective ? 1 : 0, scene);
  const auto p = vector_of(out, "", eye, scene, detail::cutting_stage(at));
  out.gives(&EyeSide::value, plane_value(plane->a, plane->b, plane->c, plane->d * w, p.x, p.y, p.z));
}

template <class Out>
void derive(const NodeSkip& e, const Situation&, Out& out) {
  out.rule(Rule::node_skip_side, e.front ? e.value < 0 : e.value > 0);
}

}  // namespace zstep::formulas
