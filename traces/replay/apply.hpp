// What each kind of event does to a state.
//
// Two halves. apply_method_state (apply_method_state.hpp, apply_structures.hpp) changes what is small and can be
// re-applied from a copy. apply_stores changes buffers, vertices and the pixel at work, and tells a log the old value
// of whatever it changes.
#pragma once

#include "traces/replay/apply_structures.hpp"

namespace zstep {

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
    if (index < 0 || static_cast<std::size_t>(index) >= state.vertices.size())
      throw Impossible(fmt::format("there is no vertex {}", index));
    log.vertex(static_cast<std::size_t>(index), state.vertices[static_cast<std::size_t>(index)]);
    return state.vertices.edit(static_cast<std::size_t>(index));
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
    const auto number = static_cast<std::size_t>(event.vertex);
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
    if (event.vertex < 0 || static_cast<std::size_t>(event.vertex) >= state.vertices.size())
      throw Impossible(fmt::format("there is no vertex {}", event.vertex));
  } else if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw> ||
                       std::is_same_v<E, TablesBegin>) {
    if (state.vertices.size() > points && !state.machine.keeps_all) {
      log.vertices_dropped(state.vertices, points);
      state.vertices.resize(points);
    }
    set_fragment(std::nullopt);
  } else if constexpr (std::is_same_v<E, ScanLineBegin> || std::is_same_v<E, SpanBegin> ||
                       std::is_same_v<E, AreaBegin> || std::is_same_v<E, RayBegin>) {
    set_fragment(std::nullopt);
  } else if constexpr (std::is_same_v<E, DepthInterpolate>) {
    set_fragment(fragment_at(event.x, event.y, event.z));
  } else if constexpr (std::is_same_v<E, DepthCompare>) {
    const auto& now = state.machine.fragment;
    Fragment fragment = now && now->x == event.x && now->y == event.y ? *now : fragment_at(event.x, event.y, event.z);
    fragment.z = event.z;
    fragment.nearer = event.nearer;
    set_fragment(fragment);
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
  } else if constexpr (std::is_same_v<E, ShadowCompare>) {
    set_fragment(fragment_at(event.x, event.y, state.picture.depth[state.picture.at(event.x, event.y)]));
  } else if constexpr (std::is_same_v<E, PassBegin>) {
    set_fragment(std::nullopt);
  }
}

}  // namespace zstep
