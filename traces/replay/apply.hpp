// What each kind of event does to a state.
//
// Two halves. apply_machine changes what is small and can be re-applied from a copy; it never looks at buffers or
// vertices. apply_stores changes buffers, vertices and the pixel at work, and tells a log the old value of whatever it
// changes. A trace from elsewhere may say impossible things (retire an edge that is not active): apply_machine then
// throws Impossible and has changed nothing.
#pragma once

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "traces/replay/state.hpp"

namespace zstep {

struct Impossible : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A log that forgets: for running ahead where nobody will step back to.
struct NoLog {
  void depth(std::size_t, double) {}
  void polygon(std::size_t, std::int32_t) {}
  void vertex(std::size_t, const VertexWay&) {}
  void vertex_added() {}
  void vertices_dropped(const std::vector<VertexWay>&, std::size_t) {}
  void fragment(const std::optional<Fragment>&) {}
  void picture(const Picture&) {}
};

namespace detail {

inline std::size_t place_of(const Machine& machine, std::int32_t edge) {
  for (std::size_t place = 0; place < machine.active.size(); ++place) {
    if (machine.active[place].edge == edge) return place;
  }
  throw Impossible(fmt::format("edge {} is not in the active edge list", edge));
}

inline EdgeRow& edge_row(Machine& machine, std::int32_t edge) {
  if (edge < 0 || static_cast<std::size_t>(edge) >= machine.edge_table.size())
    throw Impossible(fmt::format("edge {} is not in the edge table", edge));
  return machine.edge_table[static_cast<std::size_t>(edge)];
}

}  // namespace detail

// --- Small

template <class E>
void apply_machine(const E&, Machine&) {}  // most kinds of event change nothing small

inline void apply_machine(const PolygonBegin& event, Machine& machine) {
  auto fragment = machine.fragment;  // the stores' half resets it
  machine = Machine{};
  machine.fragment = fragment;
  machine.polygon = event.polygon;
  machine.facet = event.facet;
}
inline void apply_machine(const FacingTest& event, Machine& machine) { machine.facing = event; }
inline void apply_machine(const ClipTest& event, Machine& machine) { machine.clip_test = event; }
inline void apply_machine(const PolygonReject& event, Machine& machine) { machine.rejected = event.reason; }
inline void apply_machine(const OutlineVertex& event, Machine& machine) { machine.outline.push_back(event.vertex); }

inline void apply_machine(const EdgeTableInsert& event, Machine& machine) {
  if (event.edge != static_cast<std::int32_t>(machine.edge_table.size())) {
    throw Impossible(
        fmt::format("edge {} enters the edge table where edge {} is due", event.edge, machine.edge_table.size()));
  }
  machine.edge_table.push_back({event, EdgeRow::Where::waiting});
}
inline void apply_machine(const ScanLineBegin& event, Machine& machine) {
  machine.scan_line = event.y;
  machine.span.reset();
}
inline void apply_machine(const EdgeEnter& event, Machine& machine) {
  EdgeRow& row = detail::edge_row(machine, event.edge);
  if (row.where == EdgeRow::Where::active)
    throw Impossible(fmt::format("edge {} enters the active edge list twice", event.edge));
  if (event.place < 0 || static_cast<std::size_t>(event.place) > machine.active.size())
    throw Impossible(fmt::format("the active edge list has no place {}", event.place));
  row.where = EdgeRow::Where::active;
  machine.active.insert(machine.active.begin() + event.place,
                        ActiveEdge{event.edge, row.entry.x_edge, row.entry.z_edge});
}
inline void apply_machine(const EdgeRetire& event, Machine& machine) {
  const std::size_t place = detail::place_of(machine, event.edge);
  detail::edge_row(machine, event.edge).where = EdgeRow::Where::retired;
  machine.active.erase(machine.active.begin() + static_cast<std::ptrdiff_t>(place));
}
inline void apply_machine(const EdgeStep& event, Machine& machine) {
  ActiveEdge& active = machine.active[detail::place_of(machine, event.edge)];
  active.x = event.x_edge;
  active.z = event.z_edge;
}
inline void apply_machine(const EdgeSwap& event, Machine& machine) {
  if (event.place < 0 || static_cast<std::size_t>(event.place) + 1 >= machine.active.size())
    throw Impossible(fmt::format("the active edge list has no places {} and {}", event.place, event.place + 1));
  std::swap(machine.active[static_cast<std::size_t>(event.place)],
            machine.active[static_cast<std::size_t>(event.place) + 1]);
}
inline void apply_machine(const SpanBegin& event, Machine& machine) {
  detail::edge_row(machine, event.left_edge);
  detail::edge_row(machine, event.right_edge);
  machine.span = event;
}

// --- Large

/// `points`: the number of the scene's points; vertices beyond them belong to the polygon at work.
template <class E, class Log>
void apply_stores(const E& event, State& state, std::size_t points, Log& log) {
  const auto vertex = [&](std::int32_t index) -> VertexWay& {
    if (index < 0 || static_cast<std::size_t>(index) >= state.vertices.size())
      throw Impossible(fmt::format("there is no vertex {}", index));
    log.vertex(static_cast<std::size_t>(index), state.vertices[static_cast<std::size_t>(index)]);
    return state.vertices[static_cast<std::size_t>(index)];
  };
  const auto set_fragment = [&](const std::optional<Fragment>& fragment) {
    log.fragment(state.machine.fragment);
    state.machine.fragment = fragment;
  };
  const auto fragment_at = [&](std::int32_t x, std::int32_t y, double z) {
    const std::size_t pixel = state.picture.at(x, y);
    return Fragment{x, y, z, state.picture.depth[pixel], state.picture.polygon[pixel], std::nullopt};
  };

  if constexpr (std::is_same_v<E, BuffersClear>) {
    log.picture(state.picture);
    state.picture = Picture(state.picture.width, state.picture.height);
    for (double& depth : state.picture.depth) depth = event.z;
  } else if constexpr (std::is_same_v<E, ViewTransform>) {
    VertexWay& way = vertex(event.vertex);
    way.view = {event.x_v, event.y_v, event.z_v};
    way.stage = VertexWay::viewed;
  } else if constexpr (std::is_same_v<E, Projection>) {
    VertexWay& way = vertex(event.vertex);
    way.plane = {event.x_p, event.y_p, event.z};
    way.stage = VertexWay::projected;
  } else if constexpr (std::is_same_v<E, ViewportTransform>) {
    VertexWay& way = vertex(event.vertex);
    way.raster = {event.x_s, event.y_s};
    way.stage = VertexWay::on_raster;
  } else if constexpr (std::is_same_v<E, ClipCross>) {
    if (event.vertex < 0 || static_cast<std::size_t>(event.vertex) != state.vertices.size())
      throw Impossible(fmt::format("vertex {} is made where vertex {} is due", event.vertex, state.vertices.size()));
    log.vertex_added();
    VertexWay way;
    way.stage = VertexWay::viewed;
    way.view = {event.x_v, event.y_v, event.z_v};
    state.vertices.push_back(way);
  } else if constexpr (std::is_same_v<E, OutlineVertex>) {
    if (event.vertex < 0 || static_cast<std::size_t>(event.vertex) >= state.vertices.size())
      throw Impossible(fmt::format("there is no vertex {}", event.vertex));
  } else if constexpr (std::is_same_v<E, PolygonBegin>) {
    if (state.vertices.size() > points) {
      log.vertices_dropped(state.vertices, points);
      state.vertices.resize(points);
    }
    set_fragment(std::nullopt);
  } else if constexpr (std::is_same_v<E, ScanLineBegin> || std::is_same_v<E, SpanBegin>) {
    set_fragment(std::nullopt);
  } else if constexpr (std::is_same_v<E, DepthInterpolate>) {
    set_fragment(fragment_at(event.x, event.y, event.z));
  } else if constexpr (std::is_same_v<E, DepthCompare>) {
    const auto& now = state.machine.fragment;
    Fragment fragment = now && now->x == event.x && now->y == event.y ? *now : fragment_at(event.x, event.y, event.z);
    fragment.z = event.z;
    fragment.nearer = event.nearer;
    set_fragment(fragment);
  } else if constexpr (std::is_same_v<E, DepthWrite>) {
    double& depth = state.picture.depth[state.picture.at(event.x, event.y)];
    log.depth(state.picture.at(event.x, event.y), depth);
    depth = event.z;
  } else if constexpr (std::is_same_v<E, PixelWrite>) {
    std::int32_t& polygon = state.picture.polygon[state.picture.at(event.x, event.y)];
    log.polygon(state.picture.at(event.x, event.y), polygon);
    polygon = event.polygon;
  }
}

}  // namespace zstep
