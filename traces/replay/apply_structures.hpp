// What each kind of event does to the structures that a method keeps of all polygons: pieces, lists, trees, flags,
// areas, boxes, rays, curves, lines, the light. The rest of the small half of applying an event stands in
// apply_method_state.hpp.
#pragma once

#include <algorithm>

#include "traces/replay/apply_method_state.hpp"

namespace zstep {

// --- Pieces and planes

inline void apply_method_state(const TablesBegin&, MethodState& machine) { machine.keeps_all = true; }
inline void apply_method_state(const PieceMake& event, MethodState& machine) {
  detail::must_be_due("piece", event.piece, machine.pieces.size());
  if (event.parent != -1) detail::must_exist<PieceMake>("piece", event.parent, machine.pieces.size());
  if (event.parent != -1) machine.pieces.edit(static_cast<std::size_t>(event.parent)).cut = true;
  Piece piece;
  piece.polygon = event.polygon;
  piece.parent = event.parent;
  piece.outline.swap(machine.outline);
  machine.pieces.push_back(std::move(piece));
}
inline void apply_method_state(const PlaneEquation& event, MethodState& machine) {
  detail::must_exist<PieceMake>("piece", event.piece, machine.pieces.size());
  machine.pieces.edit(static_cast<std::size_t>(event.piece)).plane = event;
}
inline void apply_method_state(const Extent& event, MethodState& machine) {
  detail::must_exist<PieceMake>("piece", event.piece, machine.pieces.size());
  machine.pieces.edit(static_cast<std::size_t>(event.piece)).extent = event;
}
inline void apply_method_state(const PieceDraw& event, MethodState& machine) {
  detail::must_exist<PieceMake>("piece", event.piece, machine.pieces.size());
  detail::begin_polygon(machine, event.polygon);
  machine.edge_table.clear();
  machine.edge_stages.clear();
  machine.active.clear();
  machine.piece = event.piece;
  machine.drawn.push_back(event.piece);
}
inline void apply_method_state(const Saved& event, MethodState& machine) {
  machine.saved[static_cast<std::size_t>(event.coherence)] += event.tests;
}

// --- Orders

namespace detail {
/// What follows is about all polygons, or two of them.
inline void leave_polygon(MethodState& machine) {
  if (machine.polygon != no_polygon) begin_polygon(machine, no_polygon);
}
}  // namespace detail

inline void apply_method_state(const ListInsert& event, MethodState& machine) {
  detail::must_exist<PieceMake>("piece", event.piece, machine.pieces.size());
  if (event.place < 0 || static_cast<std::size_t>(event.place) > machine.list.size())
    throw Impossible(fmt::format("the list has no place {}", event.place));
  if (machine.list.contains(event.piece))
    throw Impossible(fmt::format("piece {} is in the list already", event.piece), kind_of<ListRemove>);
  detail::leave_polygon(machine);
  machine.list.insert(static_cast<std::size_t>(event.place), ListEntry{event.piece, false});
}
namespace detail {
inline std::size_t place_in_list(const MethodState& machine, std::int32_t piece) {
  const std::uint8_t needs = machine.pieces.size() == 0 ? kind_of<PieceMake> : kind_of<ListInsert>;
  if (!machine.list.contains(piece)) throw Impossible(fmt::format("piece {} is not in the list", piece), needs);
  return machine.list.place_of(piece);
}
}  // namespace detail
inline void apply_method_state(const ListRemove& event, MethodState& machine) {
  machine.list.erase(detail::place_in_list(machine, event.piece));
}
inline void apply_method_state(const ListMark& event, MethodState& machine) {
  machine.list.edit(detail::place_in_list(machine, event.piece)).marked = true;
}
inline void apply_method_state(const VertexSide&, MethodState& machine) { detail::leave_polygon(machine); }
inline void apply_method_state(const SideTest&, MethodState& machine) { detail::leave_polygon(machine); }
inline void apply_method_state(const SplitVertex&, MethodState& machine) { detail::leave_polygon(machine); }
inline void apply_method_state(const RootCandidate&, MethodState& machine) { detail::leave_polygon(machine); }
inline void apply_method_state(const PairBegin& event, MethodState& machine) {
  detail::begin_polygon(machine, no_polygon);
  machine.pair = event;
}

inline void apply_method_state(const NodeMake& event, MethodState& machine) {
  detail::must_be_due("node", event.node, machine.tree.size());
  detail::leave_polygon(machine);
  if (event.parent != -1) detail::must_exist<NodeMake>("node", event.parent, machine.tree.size());
  if (event.parent != -1) {
    TreeNode& parent = machine.tree.edit(static_cast<std::size_t>(event.parent));
    (event.front ? parent.front_child : parent.back_child) = event.node;
  }
  TreeNode node;
  node.parent = event.parent;
  node.pieces.push_back(event.piece);
  machine.tree.push_back(std::move(node));
  machine.node = event.node;
}
inline void apply_method_state(const NodeAdd& event, MethodState& machine) {
  detail::must_exist<NodeMake>("node", event.node, machine.tree.size());
  machine.tree.edit(static_cast<std::size_t>(event.node)).pieces.push_back(event.piece);
}
inline void apply_method_state(const EyeSide& event, MethodState& machine) {
  detail::must_exist<NodeMake>("node", event.node, machine.tree.size());
  machine.tree.edit(static_cast<std::size_t>(event.node)).eye = event;
  machine.node = event.node;
}
inline void apply_method_state(const NodeSkip& event, MethodState& machine) {
  detail::must_exist<NodeMake>("node", event.node, machine.tree.size());
  TreeNode& node = machine.tree.edit(static_cast<std::size_t>(event.node));
  (event.front ? node.front_skipped : node.back_skipped) = true;
}

// --- The sweep along a scan line

inline void apply_method_state(const FlagFlip& event, MethodState& machine) {
  std::vector<std::int32_t>& inside = machine.sweep.inside;
  std::erase(inside, event.piece);
  if (event.inside) inside.push_back(event.piece);
  machine.sweep.flip = event;
}
inline void apply_method_state(const SpanFlags& event, MethodState& machine) { machine.sweep.interval = event; }
inline void apply_method_state(const ImpliedEdge& event, MethodState& machine) {
  machine.sweep.implied.push_back(event);
}
inline void apply_method_state(const SpanWinner& event, MethodState& machine) {
  machine.sweep.winners.push_back(event);
}
inline void apply_method_state(const CoverageAdd& event, MethodState& machine) {
  std::vector<CoverageAdd>& covered = machine.sweep.covered;
  if (!covered.empty() && (covered.back().x != event.x || covered.back().y != event.y)) covered.clear();
  covered.push_back(event);
}

// --- Areas

inline void apply_method_state(const AreaBegin& event, MethodState& machine) {
  detail::must_be_due("area", event.area, machine.areas.size());
  detail::begin_polygon(machine, no_polygon);  // all are gathered
  machine.areas.push_back({event, std::nullopt});
  machine.area = event.area;
  machine.bins.clear();
}
inline void apply_method_state(const AreaBin& event, MethodState& machine) { machine.bins.push_back(event); }
inline void apply_method_state(const AreaDecide& event, MethodState& machine) {
  detail::must_exist<AreaBegin>("area", event.area, machine.areas.size());
  machine.areas.edit(static_cast<std::size_t>(event.area)).decided = event;
}

// --- Rays and boxes

inline constexpr std::size_t most_rays_of_pixel = std::size_t{1} << 16;

inline void apply_method_state(const BoxMake& event, MethodState& machine) {
  detail::must_be_due("box", event.box, machine.boxes.size());
  detail::leave_polygon(machine);
  machine.boxes.push_back({event, {}});
}
inline void apply_method_state(const BoxHold& event, MethodState& machine) {
  detail::must_exist<BoxMake>("box", event.box, machine.boxes.size());
  machine.boxes.edit(static_cast<std::size_t>(event.box)).facets.push_back(event.facet);
}
inline void apply_method_state(const GridMake& event, MethodState& machine) {
  detail::leave_polygon(machine);
  machine.grid = event;
}
inline void apply_method_state(const CellHold& event, MethodState& machine) { machine.cells.push_back(event); }
inline void apply_method_state(const RayBegin& event, MethodState& machine) {
  detail::leave_polygon(machine);
  RayWork& rays = machine.rays;
  if (event.role == RayRole::eye) rays.tree.clear();
  if (!rays.tree.empty() && event.ray <= rays.tree.back().entry.ray)
    throw Impossible(fmt::format("ray {} begins after ray {}, though rays are numbered in the order of work", event.ray,
                                 rays.tree.back().entry.ray));
  if (rays.tree.size() >= most_rays_of_pixel)
    throw Impossible(fmt::format("one pixel has more than {} rays", most_rays_of_pixel));
  rays.tree.push_back({event, std::nullopt});
  rays.ray = event.ray;
  rays.boxes.clear();
  rays.cells.clear();
  rays.hits.clear();
  rays.plane_test.reset();
  rays.planes_tested = 0;
}
inline void apply_method_state(const CellVisit& event, MethodState& machine) { machine.rays.cells.push_back(event); }
inline void apply_method_state(const BoxTest& event, MethodState& machine) { machine.rays.boxes.push_back(event); }
inline void apply_method_state(const RayPlane& event, MethodState& machine) {
  machine.rays.plane_test = event;
  ++machine.rays.planes_tested;
}
inline void apply_method_state(const RayHit& event, MethodState& machine) { machine.rays.hits.push_back(event); }
inline void apply_method_state(const RayEnd& event, MethodState& machine) {
  std::vector<RayRow>& rows = machine.rays.tree;
  const auto row = std::lower_bound(rows.begin(), rows.end(), event.ray,
                                    [](const RayRow& one, std::int32_t ray) { return one.entry.ray < ray; });
  if (!machine.rays_told) return;
  if (row == rows.end() || row->entry.ray != event.ray)
    throw Impossible(fmt::format("ray {} ends but did not begin", event.ray));
  row->end = event;
  machine.rays.ray = row->entry.parent >= 0 ? row->entry.parent : row->entry.ray;
}

// --- Curves and lines

inline void apply_method_state(const CurveBegin& event, MethodState& machine) {
  machine.horizon.curve = event;
  machine.horizon.segment.reset();
  machine.horizon.test.reset();
  machine.horizon.cross.reset();
  machine.horizon.before.reset(), machine.horizon.here.reset();
}
inline void apply_method_state(const CurveSegment& event, MethodState& machine) {
  machine.horizon.segment = event;
  machine.horizon.cross.reset();
}
inline void apply_method_state(const HorizonTest& event, MethodState& machine) {
  HorizonWork& work = machine.horizon;
  work.test = event;
  work.cross.reset();
  const auto of_column = [&](const std::vector<double>& horizon) {
    const auto column = static_cast<std::size_t>(event.x);
    return event.x >= 0 && column < horizon.size() ? horizon[column] : std::numeric_limits<double>::quiet_NaN();
  };
  work.before = work.here;
  work.here = HorizonPassage{event, of_column(work.upper), of_column(work.lower)};
}
inline void apply_method_state(const HorizonCross& event, MethodState& machine) { machine.horizon.cross = event; }
inline void apply_method_state(const HorizonMove& event, MethodState& machine) {
  std::vector<double>& horizon = event.upper ? machine.horizon.upper : machine.horizon.lower;
  const auto column = static_cast<std::size_t>(event.x);
  if (horizon.size() <= column) horizon.resize(column + 1, std::numeric_limits<double>::quiet_NaN());
  horizon[column] = event.y_curve;
}

inline void apply_method_state(const LineBegin& event, MethodState& machine) {
  detail::must_be_due("line", event.line, machine.lines.size());
  detail::begin_polygon(machine, no_polygon);
  machine.lines.push_back({event, {}, {}});
  machine.line = event.line;
  machine.against.reset();
}
inline void apply_method_state(const LineAgainst& event, MethodState& machine) { machine.against = event; }
inline void apply_method_state(const LineHide& event, MethodState& machine) {
  detail::must_exist<LineBegin>("line", event.line, machine.lines.size());
  machine.lines.edit(static_cast<std::size_t>(event.line)).hidden.push_back(event);
}
inline void apply_method_state(const LinePiece& event, MethodState& machine) {
  detail::must_exist<LineBegin>("line", event.line, machine.lines.size());
  machine.lines.edit(static_cast<std::size_t>(event.line)).pieces.push_back(event);
}

// --- Passes

inline void apply_method_state(const PassBegin& event, MethodState& machine) {
  detail::begin_polygon(machine, no_polygon);
  machine.pass = event.pass;
}
inline void apply_method_state(const ShadowCompare& event, MethodState& machine) {
  if (!machine.shadow) detail::begin_polygon(machine, no_polygon);  // the polygons are all drawn
  machine.shadow = event;
}

/// The same where the step is known: where a plane was found is asked for long after, and nothing else says it.
template <class E>
void apply_method_state(const E& event, MethodState& machine, std::int64_t step) {
  apply_method_state(event, machine);
  if constexpr (std::is_same_v<E, PlaneEquation>)
    machine.pieces.edit(static_cast<std::size_t>(event.piece)).plane_step = step;
}

}  // namespace zstep
