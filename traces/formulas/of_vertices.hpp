// What the numbers of a vertex follow from, from the world to the raster (000, "Viewing"; 003 for pseudodepth).
#pragma once

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/vectors.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::formulas {

namespace detail {

/// The operands that stand in the scene, its camera or the header.
template <class Out>
auto of_scene(Out& out, std::string_view name, double value) {
  return out.number(name, value, Place{Place::In::scene, 0});
}

}  // namespace detail

template <class Out>
void derive(const BuffersClear& e, const Situation& at, Out& out) {
  // A header that says nothing leaves it to the program; what is farther than everything is right with any.
  if (at.header.initial_depth) out.is(&BuffersClear::z, *at.header.initial_depth);
  else if (e.z == at.header.empty_depth()) out.is(&BuffersClear::z, e.z);
}

template <class Out>
void derive(const ViewTransform& e, const Situation& at, Out& out) {
  if (!at.camera || at.on_screen() || !at.is_point(e.vertex)) return;
  const auto w = vector_of(out, "", at.scene.points[static_cast<std::size_t>(e.vertex)],
                           Place{Place::In::point, e.vertex}, world_stage);
  const glm::dmat4& t_v = at.camera->view;
  const auto row = [&](int i, std::string_view a, std::string_view b, std::string_view c, std::string_view d) {
    return matrix_row(detail::of_scene(out, a, t_v[0][i]), detail::of_scene(out, b, t_v[1][i]),
                      detail::of_scene(out, c, t_v[2][i]), detail::of_scene(out, d, t_v[3][i]), w.x, w.y, w.z);
  };
  out.gives(&ViewTransform::x_v, row(0, "t_11", "t_12", "t_13", "t_14"));
  out.gives(&ViewTransform::y_v, row(1, "t_21", "t_22", "t_23", "t_24"));
  out.gives(&ViewTransform::z_v, row(2, "t_31", "t_32", "t_33", "t_34"));
}

template <class Out>
void derive(const Projection& e, const Situation& at, Out& out) {
  const VertexStages* vertex = at.viewed(e.vertex);
  if (!at.camera || !vertex) return;
  const Camera& camera = *at.camera;
  const Place place{Place::In::vertex, e.vertex};
  const auto x_v = out.number("x_v", vertex->view.x, place["x_v"]),
             y_v = out.number("y_v", vertex->view.y, place["y_v"]),
             z_v = out.number("z_v", vertex->view.z, place["z_v"]);
  const bool parallel = camera.kind == Camera::Kind::orthographic;
  if (parallel) {
    out.gives(&Projection::x_p, x_v);
    out.gives(&Projection::y_p, y_v);
  } else {
    const auto d = detail::of_scene(out, "d", camera.d);
    out.gives(&Projection::x_p, projected(d, x_v, z_v));
    out.gives(&Projection::y_p, projected(d, y_v, z_v));
  }
  if (!at.header.declares(Convention::depth)) return;
  const Conventions::Depth depth = at.header.conventions.depth;
  if (depth == Conventions::Depth::view) return out.gives(&Projection::z, z_v);
  if (!(camera.near < camera.far)) return;
  const auto near = detail::of_scene(out, "f", camera.near), far = detail::of_scene(out, "F", camera.far);
  if (depth != Conventions::Depth::pseudodepth)
    return out.gives(&Projection::z, other_depth(depth, parallel, near, far, z_v));
  out.gives(&Projection::z, parallel ? parallel_pseudodepth(near, far, z_v)
                                     : pseudodepth(near, out.named("a", pseudodepth_a(near, far)),
                                                   out.named("b", pseudodepth_b(near, far)), z_v));
}

template <class Out>
void derive(const ViewportTransform& e, const Situation& at, Out& out) {
  const VertexStages* vertex = at.vertex(e.vertex);
  if (!at.camera || !vertex || !at.records<Projection>() || vertex->stage < VertexStages::projected) return;
  const Raster& raster = at.scene.raster;
  if (!(at.camera->window > 0) || raster.height <= 0) return;
  const Place place{Place::In::vertex, e.vertex};
  const auto width = detail::of_scene(out, "W", raster.width), height = detail::of_scene(out, "H", raster.height),
             w_y = detail::of_scene(out, "w_y", at.camera->window);
  const auto x = screen_x(out.number("x_p", vertex->plane.x, place["x_p"]),
                          out.named("w_x", window_width(w_y, width, height)), width);
  const auto y = screen_y(out.number("y_p", vertex->plane.y, place["y_p"]), w_y, height);
  const bool whole = at.header.conventions.positions == Conventions::Positions::integer;
  out.gives(&ViewportTransform::x_s, whole ? to_nearest(x) : x);
  out.gives(&ViewportTransform::y_s, whole ? to_nearest(y) : y);
}

}  // namespace zstep::formulas
