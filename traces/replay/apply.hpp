// What each kind of event does to a state.
//
// Two halves. apply_method_state changes what is small and can be
// re-applied from a copy. apply_stores changes buffers, vertices and the pixel at work, and tells a log the old value
// of whatever it changes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "traces/codec/runs.hpp"
#include "traces/replay/state.hpp"
#include "traces/scene.hpp"

namespace zstep {

// The small half of applying an event: what each kind does to a MethodState. Here stands what one polygon goes through,
// its edges and spans; further below stands what methods keep of all polygons. It never looks at buffers or
// vertices, so that it can be applied again from a copy. A trace from elsewhere may say impossible things (retire an
// edge that is not active): apply_method_state then throws Impossible and has changed nothing.

/// `needs`: the kind of step that alone makes what is missing. A run that never has that kind only does not say so.
struct Impossible : std::runtime_error {
  explicit Impossible(const std::string& what, std::optional<std::uint8_t> kind = {})
      : std::runtime_error(what), needs(kind) {}
  std::optional<std::uint8_t> needs;
};

namespace detail {

/// Edges step and retire from left to right, so the next one that is asked for mostly stands beside the last.
inline std::size_t place_of(MethodState& machine, std::int32_t edge) {
  const std::size_t count = machine.active.size();
  for (std::size_t looked = 0, place = machine.looked_up; looked < count; ++looked, ++place) {
    if (place >= count) place = 0;
    if (machine.active[place].edge != edge) continue;
    machine.looked_up = place;
    return place;
  }
  throw Impossible(fmt::format("edge {} is not in the active edge list", edge));
}

inline void must_be_in_table(const MethodState& machine, std::int32_t edge) {
  if (edge < 0 || edge >= std::ssize(machine.edge_table))
    throw Impossible(fmt::format("edge {} is not in the edge table", edge));
}
inline void set_stage(MethodState& machine, std::int32_t edge, EdgeStage stage) {
  must_be_in_table(machine, edge);
  machine.edge_stages.set(edge, stage);
}

/// `Maker`: the event that makes such.
template <class Maker>
void must_exist(const char* what, std::int32_t number, std::size_t count) {
  if (number < 0 || static_cast<std::size_t>(number) >= count)
    throw Impossible(fmt::format("there is no {} {}", what, number), kind_of<Maker>);
}
inline void must_be_due(const char* what, std::int32_t number, std::size_t count) {
  if (number < 0 || static_cast<std::size_t>(number) != count)
    throw Impossible(fmt::format("{} {} is made where {} {} is due", what, number, what, count));
}

/// What belongs to one polygon starts anew; the fragment is the stores' half's.
inline void begin_polygon(MethodState& machine, std::int32_t polygon) {
  machine.polygon = polygon;
  machine.facet = machine.piece = -1;
  machine.facing.reset();
  machine.clip_test.reset();
  machine.rejected.reset();
  machine.outline.clear();
  machine.scan_line.reset();
  machine.slopes.reset();
  machine.span.reset();
  machine.triangle = {};
  machine.attribute.reset();
  if (machine.keeps_all) return;
  machine.edge_table.clear();
  machine.edge_stages.clear();
  machine.active.clear();
}

}  // namespace detail

// --- One polygon and its scan conversion

template <class E>
void apply_method_state(const E&, MethodState&) {}  // most kinds of event change nothing small

inline void apply_method_state(const PolygonBegin& event, MethodState& machine) {
  detail::begin_polygon(machine, event.polygon);
  machine.facet = event.facet;
}
inline void apply_method_state(const FacingTest& event, MethodState& machine) { machine.facing = event; }
inline void apply_method_state(const ClipTest& event, MethodState& machine) { machine.clip_test = event; }
inline void apply_method_state(const PolygonReject& event, MethodState& machine) { machine.rejected = event.reason; }
inline void apply_method_state(const OutlineVertex& event, MethodState& machine) {
  machine.outline.push_back(event.vertex);
}

inline void apply_method_state(const EdgeTableInsert& event, MethodState& machine) {
  // Where a run does not say that another polygon begins, its first edge does.
  if (!machine.polygons_told && event.edge == 0 && machine.edge_table.size() > 0) {
    detail::begin_polygon(machine, no_polygon);
    machine.edge_table.clear();
    machine.edge_stages.clear();
    machine.active.clear();
  }
  if (event.edge != size32(machine.edge_table)) {
    throw Impossible(
        fmt::format("edge {} enters the edge table where edge {} is due", event.edge, machine.edge_table.size()));
  }
  machine.edge_table.push_back(event);
  machine.edge_stages.push_back(EdgeStage::waiting);
}
inline void apply_method_state(const ScanLineBegin& event, MethodState& machine) {
  if (machine.keeps_all && machine.piece == -1) detail::begin_polygon(machine, no_polygon);  // a line of them all
  machine.scan_line = event.y;
  machine.span.reset();
  machine.sweep = {};
}
inline void apply_method_state(const EdgeEnter& event, MethodState& machine) {
  if (!machine.edges_told) return;
  detail::must_be_in_table(machine, event.edge);
  if (machine.edge_stages[event.edge] == EdgeStage::active)
    throw Impossible(fmt::format("edge {} enters the active edge list twice", event.edge));
  if (event.place < 0 || event.place > std::ssize(machine.active))
    throw Impossible(fmt::format("the active edge list has no place {}", event.place));
  detail::set_stage(machine, event.edge, EdgeStage::active);
  const EdgeTableInsert& entry = machine.edge_table[event.edge];
  machine.active.insert(machine.active.begin() + event.place, ActiveEdge{event.edge, entry.x_edge, entry.z_edge});
}
inline void apply_method_state(const EdgeRetire& event, MethodState& machine) {
  if (!machine.enters_told) return;
  const std::size_t place = detail::place_of(machine, event.edge);
  detail::set_stage(machine, event.edge, EdgeStage::retired);
  machine.active.erase(machine.active.begin() + place);
}
inline void apply_method_state(const EdgeStep& event, MethodState& machine) {
  if (!machine.enters_told) return;
  ActiveEdge& active = machine.active[detail::place_of(machine, event.edge)];
  active.x = event.x_edge;
  active.z = event.z_edge;
}
inline void apply_method_state(const EdgeSwap& event, MethodState& machine) {
  if (!machine.enters_told) return;
  if (event.place < 0 || static_cast<std::size_t>(event.place) + 1 >= machine.active.size())
    throw Impossible(fmt::format("the active edge list has no places {} and {}", event.place, event.place + 1));
  std::swap(machine.active[event.place], machine.active[static_cast<std::size_t>(event.place) + 1]);
}
inline void apply_method_state(const AttributeInterpolate& event, MethodState& machine) {
  machine.component = next_component(machine, event.x, event.y);
  machine.components[static_cast<std::size_t>(machine.component)] = event.attribute;
  machine.attribute = event;
}
inline void apply_method_state(const PlaneSlopes& event, MethodState& machine) { machine.slopes = event; }
inline void apply_method_state(const SpanBegin& event, MethodState& machine) {
  if (machine.edges_told) {
    detail::must_be_in_table(machine, event.left_edge);
    detail::must_be_in_table(machine, event.right_edge);
  }
  machine.span = event;
}

// --- One triangle

inline void apply_method_state(const TriangleSetup& event, MethodState& machine) {
  machine.triangle = {};
  machine.triangle.setup = event;
}
inline void apply_method_state(const EdgeFunction& event, MethodState& machine) {
  std::vector<EdgeFunction>& edges = machine.triangle.edges;
  if (event.edge_function < 0 || event.edge_function > 2)
    throw Impossible(fmt::format("a triangle has no edge function {}", event.edge_function));
  // Where a run does not say that another triangle begins, its first edge does.
  const bool again = event.edge_function == 0 && edges.size() == 3;
  if (!again) detail::must_be_due("edge function", event.edge_function, edges.size());
  if (again) machine.triangle = {};
  machine.triangle.edges.push_back(event);
}
inline void apply_method_state(const TileTest& event, MethodState& machine) {
  machine.triangle.tile = event;
  machine.triangle.tile_depth.reset();
  machine.triangle.leave_pixel();
}
inline void apply_method_state(const TileDepthTest& event, MethodState& machine) {
  machine.triangle.tile_depth = event;
  machine.triangle.leave_pixel();
}
inline void apply_method_state(const InsideTest& event, MethodState& machine) {
  machine.triangle.leave_pixel();
  machine.triangle.test = event;
}
inline void apply_method_state(const BarycentricWeights& event, MethodState& machine) {
  machine.triangle.weights = event;
}
inline void apply_method_state(const SampleTest& event, MethodState& machine) { machine.triangle.sample = event; }
inline void apply_method_state(const SampleDepth& event, MethodState& machine) {
  if (event.sample < 0 || event.sample >= machine.samples_a_pixel)
    throw Impossible(fmt::format("there is no sample {} of a pixel", event.sample));
  machine.triangle.before = machine.sample(event.x, event.y, event.sample);
  if (!event.nearer) return;
  const auto in_pixel = static_cast<std::size_t>(machine.samples_a_pixel);
  const std::size_t at = machine.pixel(event.x, event.y) * in_pixel + static_cast<std::size_t>(event.sample);
  if (at >= machine.samples.size()) machine.samples.resize(at + 1);
  machine.samples.edit(at) = {machine.polygon, event.z};
}
inline void apply_method_state(const SampleMask& event, MethodState& machine) {
  machine.triangle.mask = event;
  const std::size_t at = machine.pixel(event.x, event.y);
  if (at >= machine.masks.size()) machine.masks.resize(at + 1);
  formulas::add_mask(machine.masks.edit(at), {machine.polygon, machine.facet, formulas::samples_of(event), event.z});
}

// What each kind of event does to the structures that a method keeps of all polygons: pieces, lists, trees, flags,
// areas, boxes, rays, curves, lines, the light. The rest of the small half of applying an event stands
// above.

// --- Pieces and planes

inline void apply_method_state(const TablesBegin&, MethodState& machine) { machine.keeps_all = true; }
inline void apply_method_state(const PieceMake& event, MethodState& machine) {
  detail::must_be_due("piece", event.piece, machine.pieces.size());
  if (event.parent != -1) detail::must_exist<PieceMake>("piece", event.parent, machine.pieces.size());
  if (event.parent != -1) machine.pieces.edit(event.parent).cut = true;
  Piece piece;
  piece.polygon = event.polygon;
  piece.parent = event.parent;
  piece.outline.swap(machine.outline);
  machine.pieces.push_back(std::move(piece));
}
inline void apply_method_state(const PlaneEquation& event, MethodState& machine) {
  detail::must_exist<PieceMake>("piece", event.piece, machine.pieces.size());
  machine.pieces.edit(event.piece).plane = event;
}
inline void apply_method_state(const Extent& event, MethodState& machine) {
  detail::must_exist<PieceMake>("piece", event.piece, machine.pieces.size());
  machine.pieces.edit(event.piece).extent = event;
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
  machine.saved[event.coherence] += event.tests;
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
  if (event.place < 0 || event.place > std::ssize(machine.list))
    throw Impossible(fmt::format("the list has no place {}", event.place));
  if (machine.list.contains(event.piece))
    throw Impossible(fmt::format("piece {} is in the list already", event.piece), kind_of<ListRemove>);
  detail::leave_polygon(machine);
  machine.list.insert(event.place, ListEntry{event.piece, false});
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
    TreeNode& parent = machine.tree.edit(event.parent);
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
  machine.tree.edit(event.node).pieces.push_back(event.piece);
}
inline void apply_method_state(const EyeSide& event, MethodState& machine) {
  detail::must_exist<NodeMake>("node", event.node, machine.tree.size());
  machine.tree.edit(event.node).eye = event;
  machine.node = event.node;
}
inline void apply_method_state(const NodeSkip& event, MethodState& machine) {
  detail::must_exist<NodeMake>("node", event.node, machine.tree.size());
  TreeNode& node = machine.tree.edit(event.node);
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
  machine.areas.edit(event.area).decided = event;
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
  machine.boxes.edit(event.box).facets.push_back(event.facet);
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
    const std::size_t column = event.x;
    return event.x >= 0 && column < horizon.size() ? horizon[column] : std::numeric_limits<double>::quiet_NaN();
  };
  work.before = work.here;
  work.here = HorizonPassage{event, of_column(work.upper), of_column(work.lower)};
}
inline void apply_method_state(const HorizonCross& event, MethodState& machine) { machine.horizon.cross = event; }
inline void apply_method_state(const HorizonMove& event, MethodState& machine) {
  std::vector<double>& horizon = event.upper ? machine.horizon.upper : machine.horizon.lower;
  const std::size_t column = event.x;
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
  machine.lines.edit(event.line).hidden.push_back(event);
}
inline void apply_method_state(const LinePiece& event, MethodState& machine) {
  detail::must_exist<LineBegin>("line", event.line, machine.lines.size());
  machine.lines.edit(event.line).pieces.push_back(event);
}

// --- Passes

inline void apply_method_state(const PassBegin& event, MethodState& machine) {
  detail::begin_polygon(machine, no_polygon);
  machine.pass = event.pass;
}
inline void apply_method_state(const ShadowBias& event, MethodState& machine) {
  if (!machine.shadow) detail::begin_polygon(machine, no_polygon);  // the polygons are all drawn
  machine.shadow_bias = event;
}
inline void apply_method_state(const ShadowCompare& event, MethodState& machine) {
  if (!machine.shadow) detail::begin_polygon(machine, no_polygon);
  machine.shadow = event;
  machine.neighbours.clear();
}
inline void apply_method_state(const ShadowNeighbour& event, MethodState& machine) {
  machine.neighbours.push_back(event);
}
inline void apply_method_state(const LightShare& event, MethodState& machine) { machine.light_share = event; }

/// The same where the step is known: where a plane was found is asked for long after, and nothing else says it.
template <class E>
void apply_method_state(const E& event, MethodState& machine, std::int64_t step) {
  apply_method_state(event, machine);
  if constexpr (std::is_same_v<E, PlaneEquation>) machine.pieces.edit(event.piece).plane_step = step;
}

/// A log that forgets: for running ahead where nobody will step back to.
struct NoLog {
  void depth(bool, std::size_t, double) {}
  void polygon(bool, std::size_t, std::int32_t) {}
  void ink(std::size_t, std::uint32_t) {}
  void vertex(std::size_t, const VertexStages&) {}
  void vertex_added() {}
  void vertices_dropped(const SharedChunks<VertexStages>&, std::size_t) {}
  void fragment(const std::optional<Fragment>&) {}
  void picture(bool, const Picture&) {}
};

namespace detail {

template <class Log>
void set_depth(State& state, Log& log, std::int32_t x, std::int32_t y, double z) {
  double& depth = state.picture_of_pass().depth[state.picture.at(x, y)];
  log.depth(state.machine.pass == Pass::light, state.picture.at(x, y), depth);
  depth = z;
}
template <class Log>
void set_polygon(State& state, Log& log, std::int32_t x, std::int32_t y, std::int32_t number) {
  std::int32_t& polygon = state.picture_of_pass().polygon[state.picture.at(x, y)];
  log.polygon(state.machine.pass == Pass::light, state.picture.at(x, y), polygon);
  polygon = number;
}

}  // namespace detail

/// `points`: the number of the scene's points; vertices beyond them belong to the polygon at work.
template <class E, class Log>
void apply_stores(const E& event, State& state, std::size_t points, Log& log) {
  const auto vertex = [&](std::int32_t index) -> VertexStages& {
    if (index < 0 || index >= std::ssize(state.vertices)) throw Impossible(fmt::format("there is no vertex {}", index));
    log.vertex(static_cast<std::size_t>(index), state.vertices[index]);
    return state.vertices.edit(index);
  };
  const auto set_fragment = [&](const std::optional<Fragment>& fragment) {
    log.fragment(state.machine.fragment);
    state.machine.fragment = fragment;
  };
  const auto fragment_at = [&](std::int32_t x, std::int32_t y, double z) {
    const std::size_t pixel = state.picture.at(x, y);
    const Picture& picture = state.picture_of_pass();
    const std::uint32_t ink = picture.ink.empty() ? no_ink : picture.ink[pixel];
    return Fragment{x, y, z, picture.depth[pixel], picture.polygon[pixel], ink, std::nullopt};
  };

  if constexpr (std::is_same_v<E, BuffersClear>) {
    Picture& picture = state.picture_of_pass();
    log.picture(state.machine.pass == Pass::light, picture);
    const bool ink = !picture.ink.empty();
    picture = Picture(picture.width, picture.height);
    if (ink) picture.use_ink();
    for (double& depth : picture.depth) depth = event.z;
    set_fragment(std::nullopt);
  } else if constexpr (std::is_same_v<E, ViewTransform>) {
    VertexStages& way = vertex(event.vertex);
    way.view = {event.x_v, event.y_v, event.z_v};
    way.stage = VertexStages::viewed;
  } else if constexpr (std::is_same_v<E, Projection>) {
    VertexStages& way = vertex(event.vertex);
    way.plane = {event.x_p, event.y_p, event.z};
    way.stage = VertexStages::projected;
  } else if constexpr (std::is_same_v<E, ViewportTransform>) {
    VertexStages& way = vertex(event.vertex);
    way.raster = {event.x_s, event.y_s};
    way.stage = VertexStages::on_raster;
  } else if constexpr (std::is_same_v<E, ClipCross> || std::is_same_v<E, SplitVertex>) {
    // Where a run does not say that another polygon begins, the first vertex that is made for it does.
    const std::size_t number = event.vertex;
    if (!state.machine.polygons_told && event.vertex >= 0 && number >= points && number < state.vertices.size()) {
      log.vertices_dropped(state.vertices, number);
      state.vertices.resize(number);
    }
    detail::must_be_due("vertex", event.vertex, state.vertices.size());
    log.vertex_added();
    VertexStages way;
    if constexpr (std::is_same_v<E, ClipCross>) {
      way.stage = VertexStages::viewed;
      way.view = {event.x_v, event.y_v, event.z_v};
    } else if (event.space == Space::world) {
      way.world = {event.x_cut, event.y_cut, event.z_cut};
    } else {
      way.stage = VertexStages::on_raster;
      way.raster = {event.x_cut, event.y_cut};
      way.plane.z = event.z_cut;
    }
    state.vertices.push_back(way);
  } else if constexpr (std::is_same_v<E, OutlineVertex>) {
    if (event.vertex < 0 || event.vertex >= std::ssize(state.vertices))
      throw Impossible(fmt::format("there is no vertex {}", event.vertex));
  } else if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw> ||
                       std::is_same_v<E, TablesBegin>) {
    if (state.vertices.size() > points && !state.machine.keeps_all) {
      log.vertices_dropped(state.vertices, points);
      state.vertices.resize(points);
    }
    set_fragment(std::nullopt);
  } else if constexpr (std::is_same_v<E, ScanLineBegin> || std::is_same_v<E, SpanBegin> ||
                       std::is_same_v<E, AreaBegin> || std::is_same_v<E, RayBegin> ||
                       std::is_same_v<E, TriangleSetup> || std::is_same_v<E, TileTest> ||
                       std::is_same_v<E, TileDepthTest> || std::is_same_v<E, InsideTest> ||
                       std::is_same_v<E, SampleTest> || std::is_same_v<E, SampleMask>) {
    set_fragment(std::nullopt);
  } else if constexpr (std::is_same_v<E, DepthInterpolate>) {
    set_fragment(fragment_at(event.x, event.y, event.z));
  } else if constexpr (std::is_same_v<E, DepthCompare>) {
    auto& now = state.machine.fragment;
    log.fragment(now);
    if (!now || now->x != event.x || now->y != event.y) now = fragment_at(event.x, event.y, event.z);
    now->z = event.z;
    now->nearer = event.nearer;
    if (event.nearer && state.machine.compares_write) detail::set_depth(state, log, event.x, event.y, event.z);
  } else if constexpr (std::is_same_v<E, DepthWrite>) {
    detail::set_depth(state, log, event.x, event.y, event.z);
  } else if constexpr (std::is_same_v<E, PixelWrite>) {
    detail::set_polygon(state, log, event.x, event.y, event.polygon);
  } else if constexpr (std::is_same_v<E, PixelPaint>) {
    set_fragment(fragment_at(event.x, event.y, event.z));
    detail::set_depth(state, log, event.x, event.y, event.z);
    detail::set_polygon(state, log, event.x, event.y, event.polygon);
  } else if constexpr (std::is_same_v<E, ColorWrite> || std::is_same_v<E, ColorBlend>) {
    std::uint32_t& ink = state.picture.ink[state.picture.at(event.x, event.y)];
    log.ink(state.picture.at(event.x, event.y), ink);
    ink = ink_of({static_cast<std::uint8_t>(event.r8), static_cast<std::uint8_t>(event.g8),
                  static_cast<std::uint8_t>(event.b8)});
  } else if constexpr (std::is_same_v<E, ShadowBias> || std::is_same_v<E, ShadowCompare> ||
                       std::is_same_v<E, ShadowNeighbour> || std::is_same_v<E, LightShare>) {
    set_fragment(fragment_at(event.x, event.y, state.picture.depth[state.picture.at(event.x, event.y)]));
  } else if constexpr (std::is_same_v<E, PassBegin>) {
    set_fragment(std::nullopt);
  }
}

// What a run of pixels does to a state, all at once: the same as its events one by one, without a log.

namespace detail {

/// What stood at a pixel before the fragment that comes now.
inline Fragment fragment_before(const Picture& picture, std::size_t pixel, std::int32_t x, std::int32_t y, double z) {
  return {x,
          y,
          z,
          picture.depth[pixel],
          picture.polygon[pixel],
          picture.ink.empty() ? no_ink : picture.ink[pixel],
          std::nullopt};
}

}  // namespace detail

inline void apply_run(const codec::FragmentRun& run, State& state) {
  Picture& picture = state.picture_of_pass();
  const std::size_t first = picture.at(run.x, run.y), last = first + run.count - 1;
  const auto write = [&](std::size_t pixel, double z) {
    picture.depth[pixel] = z;
    picture.polygon[pixel] = run.polygon;
  };
  const std::uint64_t before_last = run.nearer & ~(std::uint64_t{1} << (run.count - 1));
  if (run.increments) {
    run.for_each([&](std::uint32_t k, std::int32_t, double z, bool nearer) {
      if (nearer && k + 1 < run.count) write(first + k, z);
      return true;
    });
  } else {
    for (std::uint64_t bits = before_last; bits != 0; bits &= bits - 1) {
      const std::uint32_t k = std::countr_zero(bits);
      write(first + k, run.depth(k));
    }
  }
  const double z = run.depth(run.count - 1);
  state.machine.fragment = detail::fragment_before(picture, last, run.end() - 1, run.y, z);
  state.machine.fragment->nearer = run.is_nearer(run.count - 1);
  if (run.is_nearer(run.count - 1)) write(last, z);
}

inline void apply_run(const codec::PaintRun& run, State& state) {
  Picture& picture = state.picture_of_pass();
  const std::size_t first = picture.at(run.x, run.y);
  run.for_each([&](std::uint32_t k, std::int32_t x, double z) {
    if (k + 1 == run.count) state.machine.fragment = detail::fragment_before(picture, first + k, x, run.y, z);
    picture.depth[first + k] = z;
    picture.polygon[first + k] = run.polygon;
    return true;
  });
}

}  // namespace zstep
