// Pieces of polygons, their planes and boxes, and the tests between them (001, 002, 003).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "traces/formulas/facet_planes.hpp"
#include "traces/formulas/lines.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/planes.hpp"
#include "traces/formulas/vectors.hpp"

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
    if (at.is_point(vertex)) return at.scene.points[static_cast<std::size_t>(vertex)];
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
  const auto facet = static_cast<std::size_t>(at.method().facet);
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
  const auto node = static_cast<std::size_t>(method.node);
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

}  // namespace zstep::formulas
