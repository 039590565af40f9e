// Pieces of polygons, their planes and boxes, the tests between them, and the orders and trees that these make (001,
// 002, 003).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "traces/file/header.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/vectors.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

namespace detail {

/// Also where a run with a tree does not say of what nodes it is made.
inline bool cuts_in_world(const Situation& at) {
  const bool tree_not_told = at.has_step<NodeMake>() && !at.records<NodeMake>() && !at.on_screen();
  return tree_not_told || zstep::cuts_in_world(at.scene, at.method());
}
inline const Stage& cutting_stage(const Situation& at) { return cuts_in_world(at) ? world_stage : raster_stage; }
inline std::optional<glm::dvec3> cutting_point(const Situation& at, std::int32_t vertex) {
  if (cuts_in_world(at)) {
    if (at.is_point(vertex)) return at.scene.points[vertex];
    const VertexStages* made = at.vertex(vertex);
    return made ? std::optional(made->world) : std::nullopt;
  }
  return at.has_depth(vertex) ? zstep::cutting_point(at.scene, at.before, vertex) : std::nullopt;
}

/// The plane A x + B y + C z + D of a piece.
template <class T>
struct Plane {
  T a, b, c, d;
};
template <class Out>
std::optional<Plane<typename Out::Number>> plane_of(Out& out, const Situation& at, std::int32_t piece) {
  const Piece* found = at.piece(piece);
  if (!found || !found->plane) return std::nullopt;
  const Place place{Place::In::piece, piece};
  const PlaneEquation& plane = *found->plane;
  return Plane<typename Out::Number>{
      out.number("A", plane.plane_a, place["plane_a"]), out.number("B", plane.plane_b, place["plane_b"]),
      out.number("C", plane.plane_c, place["plane_c"]), out.number("D", plane.plane_d, place["plane_d"])};
}

}  // namespace detail

template <class Out>
void derive(const Extent& e, const Situation& at, Out& out) {
  const Piece* piece = at.piece(e.piece);
  if (!piece || piece->outline.empty()) return;
  constexpr double far = std::numeric_limits<double>::infinity();
  glm::dvec3 low(far), high(-far);
  bool has_depths = true;
  for (const std::int32_t vertex : piece->outline) {
    const auto corner = at.on_raster(vertex);
    if (!corner) return;
    out.reads(Place{Place::In::vertex, vertex});
    low = {std::min(low.x, corner->x), std::min(low.y, corner->y), std::min(low.z, corner->z)};
    high = {std::max(high.x, corner->x), std::max(high.y, corner->y), std::max(high.z, corner->z)};
    has_depths = has_depths && at.has_depth(vertex);
  }
  out.is(&Extent::x_min, low.x), out.is(&Extent::x_max, high.x);
  out.is(&Extent::y_min, low.y), out.is(&Extent::y_max, high.y);
  if (has_depths) out.is(&Extent::z_min, low.z), out.is(&Extent::z_max, high.z);
}

template <class Out>
void derive(const PlaneDepth& e, const Situation& at, Out& out) {
  const auto plane = detail::plane_of(out, at, e.piece);
  if (!plane) return;
  out.gives(&PlaneDepth::z, plane_depth(plane->a, plane->b, plane->c, plane->d, out.number("x", e.x_at, Place{}),
                                        out.number("y", e.y_at, Place{})));
}

template <class Out>
void derive(const VertexSide& e, const Situation& at, Out& out) {
  out.rule(Rule::side_is_right, e.side != Side::crossing && (e.side == Side::on || e.value != 0));
  const auto plane = detail::plane_of(out, at, e.plane_of);
  const auto point = detail::cutting_point(at, e.vertex);
  if (!plane || !point) return;
  const auto p = vector_of(out, "", *point, Place{Place::In::vertex, e.vertex}, detail::cutting_stage(at));
  out.gives(&VertexSide::value, plane_value(plane->a, plane->b, plane->c, plane->d, p.x, p.y, p.z));
}

namespace detail {

/// Are these the two pieces that the run says it compares now? Where it never says that, any two may be.
inline bool of_pair(const Situation& at, std::int32_t one, std::int32_t other) {
  const auto& pair = at.method().pair;
  return !pair || (pair->piece == one && pair->other == other) || (pair->piece == other && pair->other == one);
}

}  // namespace detail

/// Do two ends of extents meet but for rounding, which is as large as it is of the largest of the four? Whether such
/// extents overlap is not said by their numbers.
template <class Equal>
bool extents_meet(double end, double other_begin, double largest, Equal&& equal) {
  return end == other_begin || equal(end + largest, other_begin + largest);
}

template <class Out>
void derive(const ExtentTest& e, const Situation& at, Out& out) {
  out.rule(Rule::test_of_pair, detail::of_pair(at, e.piece, e.other));
  const Piece *one = at.piece(e.piece), *other = at.piece(e.other);
  const auto low = [&](const Extent& of) {
    return e.axis == Axis::x ? of.x_min : e.axis == Axis::y ? of.y_min : of.z_min;
  };
  const auto high = [&](const Extent& of) {
    return e.axis == Axis::x ? of.x_max : e.axis == Axis::y ? of.y_max : of.z_max;
  };
  if (one && one->extent) {
    out.reads(Place{Place::In::piece, e.piece});
    out.is(&ExtentTest::low, low(*one->extent)), out.is(&ExtentTest::high, high(*one->extent));
  }
  if (other && other->extent) {
    out.reads(Place{Place::In::piece, e.other});
    out.is(&ExtentTest::other_low, low(*other->extent)), out.is(&ExtentTest::other_high, high(*other->extent));
  }
  // Whether what only touches overlaps is a convention, and z asks which one is nearer altogether.
  const double largest = std::max({std::abs(e.low), std::abs(e.high), std::abs(e.other_low), std::abs(e.other_high)});
  const auto equal = [&](double begin, double end) { return out.equal(begin, end); };
  if (e.axis == Axis::z || extents_meet(e.low, e.other_high, largest, equal) ||
      extents_meet(e.other_low, e.high, largest, equal))
    return;
  out.is(&ExtentTest::overlap, e.low < e.other_high && e.other_low < e.high);
}

namespace detail {

/// A part lies in the plane of the whole that it was cut from.
inline const Piece* whole_of(const Situation& at, const Piece* piece) {
  while (piece && at.piece(piece->parent)) piece = at.piece(piece->parent);
  return piece;
}
/// The vertices around a piece: its outline; where none is recorded, the corners of the facet that it was just made of.
inline std::span<const std::int32_t> around_piece(const Situation& at, const Piece& piece) {
  const auto& pieces = at.method().pieces;
  const std::size_t facet = at.method().facet;
  const bool just_made = piece.parent == -1 && !pieces.empty() && &piece == &pieces[pieces.size() - 1];
  if (!piece.outline.empty() || !just_made || at.method().facet < 0 || facet >= at.scene.facets.size() ||
      at.scene.facets[facet].polygon != piece.polygon)
    return piece.outline;
  return corners_of(at, at.method().facet);
}
/// The plane that the corners of a piece are in, where all are known.
inline std::optional<CornersPlane> own_plane(const Situation& at, const Piece& piece) {
  const std::span<const std::int32_t> around = around_piece(at, piece);
  for (const std::int32_t vertex : around)
    if (!cutting_point(at, vertex)) return std::nullopt;
  return plane_of_corners(around.size(), [&](std::size_t i) { return *cutting_point(at, around[i]); });
}
inline bool has_side(const Piece& piece, std::int32_t one, std::int32_t other) {
  for (std::size_t i = 0; i < piece.outline.size(); ++i) {
    const std::int32_t here = piece.outline[i], next = piece.outline[i + 1 < piece.outline.size() ? i + 1 : 0];
    if ((here == one && next == other) || (here == other && next == one)) return true;
  }
  return false;
}

/// Where an edge from a to b is cut: by the plane of the node at work, or of a piece of the pair at work. Corners may
/// be taken as they lie in their own plane, and in a ring of pieces it is another one that cuts: which one, the step
/// does not say, so that of these the nearest counts (in a run of many pieces nothing is said then).
inline std::optional<Rounded> where_cut(const SplitVertex& e, const Situation& at, const glm::dvec3& a,
                                        const glm::dvec3& b) {
  const MethodState& method = at.method();
  std::vector<Rounded> all;
  const auto add = [&](const Rounded& d_0, const Rounded& d_1) {
    if (const Rounded t = where_zero(d_0, d_1); std::isfinite(t.value)) all.push_back(t);
  };
  const auto by_plane_of = [&](std::int32_t number) {
    const Piece* piece = at.piece(number);
    if (piece && piece->plane) add(plane_value<Rounded>(*piece->plane, a), plane_value<Rounded>(*piece->plane, b));
  };
  const std::size_t node = method.node;
  if (method.node >= 0 && node < method.tree.size()) by_plane_of(method.tree[node].pieces.front());
  if (method.pair) by_plane_of(method.pair->piece), by_plane_of(method.pair->other);
  if (!all.empty() && gives(nearest_of(e.t, all), e.t, rounding_of_float64)) return nearest_of(e.t, all);

  constexpr std::size_t most_pieces = 4096;
  if (method.pieces.size() > most_pieces) return std::nullopt;
  std::vector<CornersPlane> own;
  for (const Piece& piece : method.pieces)
    if (!piece.cut && has_side(piece, e.vertex_0, e.vertex_1))
      if (const auto plane = own_plane(at, *whole_of(at, &piece))) own.push_back(*plane);
  for (const Piece& piece : method.pieces) {
    if (!piece.plane) continue;
    const Rounded d_0 = plane_value<Rounded>(*piece.plane, a), d_1 = plane_value<Rounded>(*piece.plane, b);
    add(d_0, d_1);
    const Vector<Rounded> normal{piece.plane->plane_a, piece.plane->plane_b, piece.plane->plane_c};
    for (const CornersPlane& in : own) {
      const Rounded cosine = dot(in.normal, normal);
      add(d_0 - cosine * (dot(in.normal, rounded(a)) + in.d), d_1 - cosine * (dot(in.normal, rounded(b)) + in.d));
    }
  }
  return all.empty() ? std::nullopt : std::optional(nearest_of(e.t, all));
}

}  // namespace detail

template <class Out>
void derive(const SplitVertex& e, const Situation& at, Out& out) {
  out.rule(Rule::cut_in_edge, e.t >= 0 && e.t <= 1);
  const auto from = detail::cutting_point(at, e.vertex_0), to = detail::cutting_point(at, e.vertex_1);
  if (!from || !to) return;
  if (const auto t = detail::where_cut(e, at, *from, *to)) out.near(&SplitVertex::t, *t);
  const Stage& stage = detail::cutting_stage(at);
  const auto a = vector_of(out, "_0", *from, Place{Place::In::vertex, e.vertex_0}, stage),
             b = vector_of(out, "_1", *to, Place{Place::In::vertex, e.vertex_1}, stage);
  const auto t = out.number("t", e.t, Place{});
  out.gives(&SplitVertex::x_cut, part_of_way(a.x, b.x, t));
  out.gives(&SplitVertex::y_cut, part_of_way(a.y, b.y, t));
  out.gives(&SplitVertex::z_cut, part_of_way(a.z, b.z, t));
}

// Planes of pieces, the sides of them, and the tree that they make (001, 003).

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
  const std::size_t number = node;
  if (node < 0 || number >= tree.size() || tree[number].parent < 0) return nullptr;
  return &tree[tree[number].parent];
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
  // Whichever it is, it is so of both numbers.
  const std::array<std::pair<Rounded, Rounded>, 4> ways{
      {{least[0], greatest[0]}, {least[1], greatest[1]}, {-greatest[0], -least[0]}, {-greatest[1], -least[1]}}};
  const auto off = [&](const std::pair<Rounded, Rounded>& way) {
    return std::abs(way.first.value - e.least) + std::abs(way.second.value - e.greatest);
  };
  const auto way = std::min_element(ways.begin(), ways.end(),
                                    [&](const auto& one, const auto& other) { return off(one) < off(other); });
  out.near(&SideTest::least, way->first);
  out.near(&SideTest::greatest, way->second);
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
  out.is(&TablesBegin::polygons, size32(at.scene.polygons));
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
  const std::size_t place = e.place;
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
  const std::size_t parent = e.parent;
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
  const std::size_t number = e.node;
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
