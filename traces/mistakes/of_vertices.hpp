// Mistakes on the way from the scene to the raster, and in telling front from back (000, "Viewing"; 003).
#pragma once

#include <cmath>

#include "traces/formulas/viewing.hpp"
#include "traces/mistakes/supposed.hpp"

namespace zstep::mistakes {

namespace detail {

/// z_v of a vertex of the scene, as its place there gives it; nothing of one that clipping has made.
inline std::optional<Rounded> true_z_v(const Situation& at, std::int32_t vertex) {
  if (!at.camera || !at.is_point(vertex)) return std::nullopt;
  const glm::dvec3& w = at.scene.points[static_cast<std::size_t>(vertex)];
  const glm::dmat4& t_v = at.camera->view;
  return formulas::matrix_row<Rounded>(t_v[0][2], t_v[1][2], t_v[2][2], t_v[3][2], w.x, w.y, w.z);
}
/// Is the vertex before the near plane, and not only where a wrong z_v has put it?
inline bool is_before_near(const Situation& at, std::int32_t vertex) {
  const auto z_v = true_z_v(at, vertex);
  return z_v && z_v->value < at.camera->near * (1 - formulas::rounding_of_float32);
}

}  // namespace detail

inline void suppose(const ViewTransform& e, const Situation& at, Supposed& out) {
  if (at.on_screen()) return;
  if (const auto z_v = detail::true_z_v(at, e.vertex)) out.number(depth_axis_reversed, "z_v", e.z_v, {-*z_v}, *z_v);
}

inline void suppose(const Projection& e, const Situation& at, Supposed& out) {
  const VertexStages* vertex = at.viewed(e.vertex);
  if (!vertex || !at.camera) return;
  const Rounded z_v = vertex->view.z, d = at.camera->d;
  const bool parallel = at.camera->kind == Camera::Kind::orthographic;
  const double on_plane[2] = {e.x_p, e.y_p}, viewed[2] = {vertex->view.x, vertex->view.y};
  for (int axis = 0; axis < 2 && !parallel; ++axis) {
    const std::string_view name = axis == 0 ? "x_p" : "y_p";
    const Rounded v = viewed[axis], right = formulas::projected(d, v, z_v);
    out.number(no_divide, name, on_plane[axis], {v, d * v}, right);
    out.number(divide_twice, name, on_plane[axis], {right / z_v, d * right / z_v}, right);
  }
  if (!parallel && detail::is_before_near(at, e.vertex)) out.says(not_clipped_near, true, false);
  if (!at.header.declares(Convention::depth) || !(at.camera->near < at.camera->far)) return;
  const Rounded near = at.camera->near, far = at.camera->far;
  using enum Conventions::Depth;
  const auto depth = at.header.conventions.depth;
  if (depth == view) return;
  const Rounded right = depth != pseudodepth ? formulas::other_depth(depth, parallel, near, far, z_v)
                        : parallel           ? formulas::parallel_pseudodepth(near, far, z_v)
                                             : formulas::pseudodepth(near, formulas::pseudodepth_a(near, far),
                                                                     formulas::pseudodepth_b(near, far), z_v);
  out.number(z_v_for_depth, "z", e.z, {z_v}, right);
}

inline void suppose(const ViewportTransform& e, const Situation& at, Supposed& out) {
  const VertexStages* vertex = at.viewed(e.vertex);
  const Raster& raster = at.scene.raster;
  if (!at.camera || !vertex || vertex->stage < VertexStages::projected || !(at.camera->window > 0) ||
      raster.height <= 0 || at.header.conventions.positions == Conventions::Positions::integer)
    return;
  const Rounded height = raster.height, w_y = at.camera->window, w_x = at.camera->window * raster.width / raster.height;
  const Rounded x = formulas::screen_x(Rounded(vertex->plane.x), w_x, Rounded(raster.width)),
                y = formulas::screen_y(Rounded(vertex->plane.y), w_y, height);
  const Rounded half = 0.5, turned = height - y - Rounded(1.0);
  out.number(y_upside_down, "y_s", e.y_s, {turned, turned + half, turned - half}, y);
  out.number(centres_half_off, "x_s", e.x_s, {x + half}, x);
  out.number(centres_half_off, "y_s", e.y_s, {y + half}, y);
}

inline void suppose(const FacingTest& e, const Situation&, Supposed& out) {
  if (e.facing == Facing::edge_on || e.view_dot_normal == 0) return;
  const Facing right = e.view_dot_normal > 0 ? Facing::back : Facing::front;
  out.says(clockwise_front, e.facing != right, e.facing == right, "facing");
}

inline void suppose(const ClipCross& e, const Situation&, Supposed& out) {
  if (e.plane == ClipPlane::near) out.rules_out(not_clipped_near);
}

}  // namespace zstep::mistakes
