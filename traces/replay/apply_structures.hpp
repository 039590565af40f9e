// What each kind of event does to the structures that a method keeps of all polygons: pieces, lists, trees, flags, areas,
// boxes, rays, curves, lines, the light. The rest of the small half of applying an event stands in apply_machine.hpp.
#pragma once

#include "traces/replay/apply_machine.hpp"

namespace zstep {

// --- Pieces and planes

inline void apply_machine(const TablesBegin&, Machine& machine) { machine.keeps_all = true; }
inline void apply_machine(const PieceMake& event, Machine& machine) {
  detail::must_be_due("piece", event.piece, machine.pieces.size());
  if (event.parent != -1) detail::must_exist("piece", event.parent, machine.pieces.size());
  if (event.parent != -1) machine.pieces.edit(static_cast<std::size_t>(event.parent)).cut = true;
  Piece piece;
  piece.polygon = event.polygon;
  piece.parent = event.parent;
  piece.outline.swap(machine.outline);
  machine.pieces.push_back(std::move(piece));
}
inline void apply_machine(const PlaneEquation& event, Machine& machine) {
  detail::must_exist("piece", event.piece, machine.pieces.size());
  machine.pieces.edit(static_cast<std::size_t>(event.piece)).plane = event;
}
inline void apply_machine(const Extent& event, Machine& machine) {
  detail::must_exist("piece", event.piece, machine.pieces.size());
  machine.pieces.edit(static_cast<std::size_t>(event.piece)).extent = event;
}
inline void apply_machine(const PieceDraw& event, Machine& machine) {
  detail::must_exist("piece", event.piece, machine.pieces.size());
  detail::begin_polygon(machine, event.polygon);
  machine.edge_table.clear();
  machine.edge_stages.clear();
  machine.active.clear();
  machine.piece = event.piece;
  machine.drawn.push_back(event.piece);
}
inline void apply_machine(const Saved& event, Machine& machine) {
  machine.saved[static_cast<std::size_t>(event.coherence)] += event.tests;
}

// --- Orders

inline void apply_machine(const ListInsert& event, Machine& machine) {
  if (event.place < 0 || static_cast<std::size_t>(event.place) > machine.list.size())
    throw Impossible(fmt::format("the list has no place {}", event.place));
  machine.list.insert(static_cast<std::size_t>(event.place), ListEntry{event.piece, false});
}
namespace detail {
inline std::size_t place_in_list(const Machine& machine, std::int32_t piece) {
  std::size_t place = 0;
  for (const ListEntry& entry : machine.list) {
    if (entry.piece == piece) return place;
    ++place;
  }
  throw Impossible(fmt::format("piece {} is not in the list", piece));
}
}  // namespace detail
inline void apply_machine(const ListRemove& event, Machine& machine) {
  const std::size_t place = detail::place_in_list(machine, event.piece);
  machine.list.erase(place);
}
inline void apply_machine(const ListMark& event, Machine& machine) {
  machine.list.edit(detail::place_in_list(machine, event.piece)).marked = true;
}
namespace detail {
/// What follows is about all polygons, or two of them.
inline void leave_polygon(Machine& machine) {
  if (machine.polygon != no_polygon) begin_polygon(machine, no_polygon);
}
}  // namespace detail
inline void apply_machine(const VertexSide&, Machine& machine) { detail::leave_polygon(machine); }
inline void apply_machine(const SideTest&, Machine& machine) { detail::leave_polygon(machine); }
inline void apply_machine(const RootCandidate&, Machine& machine) { detail::leave_polygon(machine); }
inline void apply_machine(const PairBegin& event, Machine& machine) {
  detail::begin_polygon(machine, no_polygon);
  machine.pair = event;
}

inline void apply_machine(const NodeMake& event, Machine& machine) {
  detail::must_be_due("node", event.node, machine.tree.size());
  detail::leave_polygon(machine);
  if (event.parent != -1) detail::must_exist("node", event.parent, machine.tree.size());
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
inline void apply_machine(const NodeAdd& event, Machine& machine) {
  detail::must_exist("node", event.node, machine.tree.size());
  machine.tree.edit(static_cast<std::size_t>(event.node)).pieces.push_back(event.piece);
}
inline void apply_machine(const EyeSide& event, Machine& machine) {
  detail::must_exist("node", event.node, machine.tree.size());
  machine.tree.edit(static_cast<std::size_t>(event.node)).eye = event;
  machine.node = event.node;
}
inline void apply_machine(const NodeSkip& event, Machine& machine) {
  detail::must_exist("node", event.node, machine.tree.size());
  TreeNode& node = machine.tree.edit(static_cast<std::size_t>(event.node));
  (event.front ? node.front_skipped : node.back_skipped) = true;
}

// --- The sweep along a scan line

inline void apply_machine(const FlagFlip& event, Machine& machine) {
  std::vector<std::int32_t>& inside = machine.sweep.inside;
  std::erase(inside, event.piece);
  if (event.inside) inside.push_back(event.piece);
  machine.sweep.flip = event;
}
inline void apply_machine(const SpanFlags& event, Machine& machine) { machine.sweep.stretch = event; }
inline void apply_machine(const ImpliedEdge& event, Machine& machine) { machine.sweep.implied.push_back(event); }
inline void apply_machine(const SpanWinner& event, Machine& machine) { machine.sweep.winners.push_back(event); }
inline void apply_machine(const CoverageAdd& event, Machine& machine) {
  std::vector<CoverageAdd>& covered = machine.sweep.covered;
  if (!covered.empty() && (covered.back().x != event.x || covered.back().y != event.y)) covered.clear();
  covered.push_back(event);
}

// --- Areas

inline void apply_machine(const AreaBegin& event, Machine& machine) {
  detail::must_be_due("area", event.area, machine.areas.size());
  detail::begin_polygon(machine, no_polygon);  // all are gathered
  machine.areas.push_back({event, std::nullopt});
  machine.area = event.area;
  machine.bins.clear();
}
inline void apply_machine(const AreaBin& event, Machine& machine) { machine.bins.push_back(event); }
inline void apply_machine(const AreaDecide& event, Machine& machine) {
  detail::must_exist("area", event.area, machine.areas.size());
  machine.areas.edit(static_cast<std::size_t>(event.area)).decided = event;
}

// --- Rays and boxes

inline void apply_machine(const BoxMake& event, Machine& machine) {
  detail::must_be_due("box", event.box, machine.boxes.size());
  detail::leave_polygon(machine);
  machine.boxes.push_back({event, {}});
}
inline void apply_machine(const BoxHold& event, Machine& machine) {
  detail::must_exist("box", event.box, machine.boxes.size());
  machine.boxes.edit(static_cast<std::size_t>(event.box)).facets.push_back(event.facet);
}
inline void apply_machine(const GridMake& event, Machine& machine) {
  detail::leave_polygon(machine);
  machine.grid = event;
}
inline void apply_machine(const CellHold& event, Machine& machine) { machine.cells.push_back(event); }
inline void apply_machine(const RayBegin& event, Machine& machine) {
  detail::leave_polygon(machine);
  RayWork& rays = machine.rays;
  if (event.role == RayRole::eye) rays.tree.clear();
  rays.tree.push_back({event, std::nullopt});
  rays.ray = event.ray;
  rays.boxes.clear();
  rays.cells.clear();
  rays.hits.clear();
  rays.plane_test.reset();
  rays.planes_tested = 0;
}
inline void apply_machine(const CellVisit& event, Machine& machine) { machine.rays.cells.push_back(event); }
inline void apply_machine(const BoxTest& event, Machine& machine) { machine.rays.boxes.push_back(event); }
inline void apply_machine(const RayPlane& event, Machine& machine) {
  machine.rays.plane_test = event;
  ++machine.rays.planes_tested;
}
inline void apply_machine(const RayHit& event, Machine& machine) { machine.rays.hits.push_back(event); }
inline void apply_machine(const RayEnd& event, Machine& machine) {
  for (RayRow& row : machine.rays.tree) {
    if (row.entry.ray != event.ray) continue;
    row.end = event;
    machine.rays.ray = row.entry.parent >= 0 ? row.entry.parent : row.entry.ray;
    return;
  }
  throw Impossible(fmt::format("ray {} ends but did not begin", event.ray));
}

// --- Curves and lines

inline void apply_machine(const CurveBegin& event, Machine& machine) {
  machine.horizon.curve = event;
  machine.horizon.segment.reset();
  machine.horizon.test.reset();
  machine.horizon.cross.reset();
}
inline void apply_machine(const CurveSegment& event, Machine& machine) {
  machine.horizon.segment = event;
  machine.horizon.cross.reset();
}
inline void apply_machine(const HorizonTest& event, Machine& machine) {
  machine.horizon.test = event;
  machine.horizon.cross.reset();
}
inline void apply_machine(const HorizonCross& event, Machine& machine) { machine.horizon.cross = event; }
inline void apply_machine(const HorizonMove& event, Machine& machine) {
  std::vector<double>& horizon = event.upper ? machine.horizon.upper : machine.horizon.lower;
  const auto column = static_cast<std::size_t>(event.x);
  if (horizon.size() <= column) horizon.resize(column + 1, std::numeric_limits<double>::quiet_NaN());
  horizon[column] = event.y_curve;
}

inline void apply_machine(const LineBegin& event, Machine& machine) {
  detail::must_be_due("line", event.line, machine.lines.size());
  detail::begin_polygon(machine, no_polygon);
  machine.lines.push_back({event, {}, {}});
  machine.line = event.line;
  machine.against.reset();
}
inline void apply_machine(const LineAgainst& event, Machine& machine) { machine.against = event; }
inline void apply_machine(const LineHide& event, Machine& machine) {
  detail::must_exist("line", event.line, machine.lines.size());
  machine.lines.edit(static_cast<std::size_t>(event.line)).hidden.push_back(event);
}
inline void apply_machine(const LinePiece& event, Machine& machine) {
  detail::must_exist("line", event.line, machine.lines.size());
  machine.lines.edit(static_cast<std::size_t>(event.line)).pieces.push_back(event);
}

// --- Passes

inline void apply_machine(const PassBegin& event, Machine& machine) {
  detail::begin_polygon(machine, no_polygon);
  machine.pass = event.pass;
}
inline void apply_machine(const ShadowCompare& event, Machine& machine) {
  if (!machine.shadow) detail::begin_polygon(machine, no_polygon);  // the polygons are all drawn
  machine.shadow = event;
}

/// The same where the step is known: where a plane was found is asked for long after, and nothing else says it.
template <class E>
void apply_machine(const E& event, Machine& machine, std::int64_t step) {
  apply_machine(event, machine);
  if constexpr (std::is_same_v<E, PlaneEquation>) machine.pieces.edit(static_cast<std::size_t>(event.piece)).plane_step = step;
}

}  // namespace zstep
