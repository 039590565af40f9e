// The small half of applying an event: what each kind does to a MethodState. Here stands what one polygon goes through,
// its edges and spans; apply_structures.hpp has what methods keep of all polygons. It never looks at buffers or
// vertices, so that it can be applied again from a copy. A trace from elsewhere may say impossible things (retire an
// edge that is not active): apply_method_state then throws Impossible and has changed nothing.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "traces/replay/state.hpp"

namespace zstep {

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
  if (edge < 0 || static_cast<std::size_t>(edge) >= machine.edge_table.size())
    throw Impossible(fmt::format("edge {} is not in the edge table", edge));
}
inline void set_stage(MethodState& machine, std::int32_t edge, EdgeStage stage) {
  must_be_in_table(machine, edge);
  machine.edge_stages.set(static_cast<std::size_t>(edge), stage);
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
  if (event.edge != static_cast<std::int32_t>(machine.edge_table.size())) {
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
  if (machine.edge_stages[static_cast<std::size_t>(event.edge)] == EdgeStage::active)
    throw Impossible(fmt::format("edge {} enters the active edge list twice", event.edge));
  if (event.place < 0 || static_cast<std::size_t>(event.place) > machine.active.size())
    throw Impossible(fmt::format("the active edge list has no place {}", event.place));
  detail::set_stage(machine, event.edge, EdgeStage::active);
  const EdgeTableInsert& entry = machine.edge_table[static_cast<std::size_t>(event.edge)];
  machine.active.insert(machine.active.begin() + event.place, ActiveEdge{event.edge, entry.x_edge, entry.z_edge});
}
inline void apply_method_state(const EdgeRetire& event, MethodState& machine) {
  if (!machine.enters_told) return;
  const std::size_t place = detail::place_of(machine, event.edge);
  detail::set_stage(machine, event.edge, EdgeStage::retired);
  machine.active.erase(machine.active.begin() + static_cast<std::ptrdiff_t>(place));
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
  std::swap(machine.active[static_cast<std::size_t>(event.place)],
            machine.active[static_cast<std::size_t>(event.place) + 1]);
}
inline void apply_method_state(const AttributeInterpolate& event, MethodState& machine) { machine.attribute = event; }
inline void apply_method_state(const PlaneSlopes& event, MethodState& machine) { machine.slopes = event; }
inline void apply_method_state(const SpanBegin& event, MethodState& machine) {
  if (machine.edges_told) {
    detail::must_be_in_table(machine, event.left_edge);
    detail::must_be_in_table(machine, event.right_edge);
  }
  machine.span = event;
}

}  // namespace zstep
