// What happens to a polygon before it is drawn: its vertices' way to the raster (000, "Viewing"), the back-face test in
// the four formulations of the notes, outcodes, clipping (000, 001, 003; Sutherland and Hodgman 1974).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/vectors.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::formulas {

// What the numbers of a vertex follow from, from the world to the raster (000, "Viewing"; 003 for pseudodepth).

namespace detail {

/// The operands that stand in the scene, its camera or the header.
template <class Out>
auto of_scene(Out& out, std::string_view name, double value) {
  return out.number(name, value, Place{Place::In::scene, 0});
}

}  // namespace detail

namespace detail {

/// The scale of a camera's depths, the near and the far distance being given already.
template <class Out, class T>
DepthScale<T> depth_scale_of(Out& out, const Camera& camera, Conventions::Depth depth, const T& near, const T& far) {
  const Camera::DepthRange& range = camera.depth_range;
  const bool parallel = camera.kind == Camera::Kind::orthographic;
  if (range.is_standard()) return {depth, parallel, near, far, false, near, far};
  return {depth, parallel, near, far, true, of_scene(out, "low", range.low), of_scene(out, "high", range.high)};
}

/// The farthest depth that the scene can have: at the far plane, or of its points.
inline std::optional<double> farthest_depth(const Situation& at) {
  if (!at.header.declares(Convention::depth) || !at.header.declares(Convention::nearer)) return std::nullopt;
  if (at.camera && !at.on_screen())
    return vertex_depth(depth_scale(*at.camera, at.header.conventions.depth, [](double number) { return number; }),
                        at.camera->far);
  std::optional<double> farthest;
  for (const glm::dvec3& point : at.scene.points)
    if (!farthest || at.header.comparison.behind(point.z, *farthest) > 0) farthest = point.z;
  return farthest;
}

}  // namespace detail

template <class Out>
void derive(const BuffersClear& e, const Situation& at, Out& out) {
  if (at.header.initial_depth) return out.is(&BuffersClear::z, *at.header.initial_depth);
  // A header that says nothing leaves it to the program; what is farther than everything is right with any, and so is
  // what nothing in view is farther than.
  if (e.z == at.header.empty_depth()) return out.is(&BuffersClear::z, e.z);
  const auto farthest = detail::farthest_depth(at);
  if (!farthest) return;
  constexpr double rounding = 1e-5;
  const bool is_wrong =
      std::isnan(e.z) || at.header.comparison.behind(*farthest, e.z) > rounding * (1 + std::abs(*farthest));
  out.is(&BuffersClear::z, is_wrong ? at.header.empty_depth() : e.z);
}

namespace detail {

/// A point of the scene in view coordinates.
template <class Out>
auto view_of_point(Out& out, const Situation& at, std::int32_t point) -> std::array<typename Out::Number, 3> {
  const auto w = vector_of(out, "", at.scene.points[point], Place{Place::In::point, point}, world_stage);
  const glm::dmat4& t_v = at.camera->view;
  const auto row = [&](int i, std::string_view a, std::string_view b, std::string_view c, std::string_view d) {
    return matrix_row(of_scene(out, a, t_v[0][i]), of_scene(out, b, t_v[1][i]), of_scene(out, c, t_v[2][i]),
                      of_scene(out, d, t_v[3][i]), w.x, w.y, w.z);
  };
  return {row(0, "t_11", "t_12", "t_13", "t_14"), row(1, "t_21", "t_22", "t_23", "t_24"),
          row(2, "t_31", "t_32", "t_33", "t_34")};
}

/// A vertex on the projection plane: as the run has it, or else from its view coordinates, or from the scene's point.
template <class Out>
auto on_plane(Out& out, const Situation& at, std::int32_t vertex)
    -> std::optional<std::array<typename Out::Number, 2>> {
  const Place place{Place::In::vertex, vertex};
  const VertexStages* known = at.vertex(vertex);
  if (known && at.records<Projection>() && known->stage >= VertexStages::projected)
    return std::array{out.number("x_p", known->plane.x, place["x_p"]), out.number("y_p", known->plane.y, place["y_p"])};
  std::optional<std::array<typename Out::Number, 3>> view;
  double z_v = 0;
  if (const VertexStages* viewed = at.viewed(vertex)) {
    z_v = viewed->view.z;
    view = std::array{out.number("x_v", viewed->view.x, place["x_v"]), out.number("y_v", viewed->view.y, place["y_v"]),
                      out.number("z_v", viewed->view.z, place["z_v"])};
  } else if (at.is_point(vertex)) {
    z_v = (at.camera->view * glm::dvec4(at.scene.points[vertex], 1)).z;
    const auto rows = view_of_point(out, at, vertex);
    view = std::array{out.named("x_v", rows[0]), out.named("y_v", rows[1]), out.named("z_v", rows[2])};
  }
  if (!view) return std::nullopt;
  if (at.camera->kind == Camera::Kind::orthographic) return std::array{(*view)[0], (*view)[1]};
  if (!(z_v > 0)) return std::nullopt;
  const auto d = of_scene(out, "d", at.camera->d);
  return std::array{out.named("x_p", projected(d, (*view)[0], (*view)[2])),
                    out.named("y_p", projected(d, (*view)[1], (*view)[2]))};
}

}  // namespace detail

template <class Out>
void derive(const ViewTransform& e, const Situation& at, Out& out) {
  if (!at.camera || at.on_screen() || !at.is_point(e.vertex)) return;
  const auto [x_v, y_v, z_v] = detail::view_of_point(out, at, e.vertex);
  out.gives(&ViewTransform::x_v, x_v);
  out.gives(&ViewTransform::y_v, y_v);
  out.gives(&ViewTransform::z_v, z_v);
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
    return out.gives(&Projection::z, other_depth(detail::depth_scale_of(out, camera, depth, near, far), z_v));
  out.gives(&Projection::z, parallel ? parallel_pseudodepth(near, far, z_v)
                                     : pseudodepth(near, out.named("a", pseudodepth_a(near, far)),
                                                   out.named("b", pseudodepth_b(near, far)), z_v));
}

template <class Out>
void derive(const ViewportTransform& e, const Situation& at, Out& out) {
  const Raster& raster = at.scene.raster;
  if (!at.camera || at.on_screen() || !(at.camera->window > 0) || raster.height <= 0) return;
  const auto plane = detail::on_plane(out, at, e.vertex);
  if (!plane) return;
  const auto width = detail::of_scene(out, "W", raster.width), height = detail::of_scene(out, "H", raster.height),
             w_y = detail::of_scene(out, "w_y", at.camera->window);
  const auto x = screen_x((*plane)[0], out.named("w_x", window_width(w_y, width, height)), width, raster);
  const auto y = screen_y((*plane)[1], w_y, height, raster);
  out.gives(&ViewportTransform::x_s, snapped(x, at.header.conventions.positions));
  out.gives(&ViewportTransform::y_s, snapped(y, at.header.conventions.positions));
}

namespace detail {

inline std::span<const std::int32_t> corners_of(const Situation& at, std::int32_t facet) {
  if (facet < 0 || facet >= std::ssize(at.scene.facets)) return {};
  const Facet& found = at.scene.facets[facet];
  return std::span(at.scene.corners).subspan(found.first_corner, found.corner_count);
}

inline constexpr int clip_planes = 6;

/// How far inside a plane of the view volume a vertex is.
template <class Out>
auto distance_of_vertex(Out& out, const Situation& at, ClipPlane plane, std::int32_t vertex, std::string_view suffix)
    -> std::optional<typename Out::Number> {
  const VertexStages* found = at.viewed(vertex);
  if (!found || !at.camera || at.on_screen()) return std::nullopt;
  const Camera& camera = *at.camera;
  const Place scene{Place::In::scene, 0};
  const auto number = [&](std::string_view name, double value) { return out.number(name, value, scene); };
  const auto w_y = number("w_y", camera.window);
  const ViewVolume<typename Out::Number> volume{
      camera.kind == Camera::Kind::orthographic,
      number("f", camera.near),
      number("F", camera.far),
      number("d", camera.d),
      out.named("w_x", window_width(w_y, number("W", at.scene.raster.width), number("H", at.scene.raster.height))),
      w_y};
  const auto view = vector_of(out, suffix, found->view, Place{Place::In::vertex, vertex}, view_stage);
  return distance_inside(volume, plane, view.x, view.y, view.z);
}

/// Does anything remain of an outline inside of all these? inside(i, p) is how far p is inside of the ith, linearly.
template <class Inside>
bool remains_inside(std::vector<glm::dvec3> outline, int count, const Inside& inside) {
  for (int i = 0; i < count; ++i) {
    std::vector<glm::dvec3> kept;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const glm::dvec3 &from = outline[k], &to = outline[k + 1 < outline.size() ? k + 1 : 0];
      const double d_from = inside(i, from), d_to = inside(i, to);
      if (d_from >= 0) kept.push_back(from);
      if ((d_from >= 0) != (d_to >= 0)) kept.push_back(part_of_way(from, to, d_from / (d_from - d_to)));
    }
    outline = std::move(kept);
  }
  return outline.size() > 2;
}

/// Takes operands as they stand.
struct Plainly {
  using Number = Rounded;
  Number number(std::string_view, double value, const Place&) { return value; }
  Number named(std::string_view, const Number& formula) { return formula; }
};

/// Has the facet at work its whole outline, where nothing is clipped off?
inline bool outline_is_whole(const Situation& at) {
  const MethodState& method = at.method();
  const std::size_t corners = corners_of(at, method.facet).size();
  const bool clipped = method.clip_test && method.clip_test->outside_some != 0;
  return method.outline.empty() || corners == 0 || clipped || (!method.clip_test && !at.on_screen()) ||
         method.outline.size() == corners;
}
/// Are these neighbours of the outline at work? Where there is none, of the facet's corners.
inline bool joined_in_outline(const Situation& at, std::int32_t one, std::int32_t other) {
  const MethodState& method = at.method();
  const std::span<const std::int32_t> outline =
      method.outline.empty() ? corners_of(at, method.facet) : std::span<const std::int32_t>(method.outline);
  if (outline.empty() || (method.outline.empty() && !(at.is_point(one) && at.is_point(other)))) return true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::int32_t a = outline[i], b = outline[(i + 1) % outline.size()];
    if ((a == one && b == other) || (a == other && b == one)) return true;
  }
  return false;
}

}  // namespace detail

template <class Out>
void derive(const FacingTest& e, const Situation& at, Out& out) {
  using T = typename Out::Number;
  // What is seen edge-on is decided by a tolerance of the program's own.
  if (e.facing != Facing::edge_on && e.view_dot_normal != 0)
    out.is(&FacingTest::facing, e.view_dot_normal > 0 ? Facing::back : Facing::front);
  const std::span<const std::int32_t> corners = detail::corners_of(at, at.method().facet);
  if (corners.size() < 3 || !at.camera || at.on_screen()) return;
  const bool parallel = at.camera->kind == Camera::Kind::orthographic;
  const Place scene{Place::In::scene, 0};
  const auto point = [&](std::size_t i) {
    return vector_of(out, "_" + std::to_string(i), at.scene.points[corners[i]], Place{Place::In::point, corners[i]},
                     world_stage);
  };
  const auto vertex = [&](std::size_t i) { return at.vertex(corners[i < corners.size() ? i : 0]); };
  const auto view = [&](std::size_t i) {
    const std::size_t n = i < corners.size() ? i : 0;
    return vector_of(out, "_v" + std::to_string(n), vertex(n)->view, Place{Place::In::vertex, corners[n]}, view_stage);
  };
  const T zero = out.number("0", 0, scene);
  const Vector<T> first = point(0);
  const Vector<T> none{zero, zero, zero}, normal = newell_normal(none, corners.size(), point);
  const Vector<T> eye = vector_of(out, "_eye", at.camera->eye, scene, world_stage);
  const Vector<T> sight = parallel ? Vector<T>{-eye.x, -eye.y, -eye.z} : first - eye;
  out.gives(&FacingTest::view_dot_normal, dot(sight, normal));
  const T d = parallel ? zero : -dot(normal, first);
  out.gives(&FacingTest::plane_at_eye, plane_value(normal.x, normal.y, normal.z, d, eye.x, eye.y, eye.z));

  bool all_viewed = true, on_raster = true, before_eye = true;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    all_viewed = all_viewed && at.viewed(corners[i]);
    before_eye = before_eye && all_viewed && vertex(i)->view.z >= at.camera->near;
    on_raster = on_raster && all_viewed && vertex(i)->stage >= VertexStages::on_raster;
  }
  if (all_viewed) {
    const Vector<T> sum = newell_about_origin(none, corners.size(), view);
    const T one = out.number("1", 1, scene);
    out.gives(&FacingTest::determinant, dot(parallel ? Vector<T>{zero, zero, one} : view(0), sum));
  }
  if (all_viewed && !before_eye) {
    out.is(&FacingTest::projected_normal_z, std::numeric_limits<double>::quiet_NaN());
  } else if (on_raster) {
    const auto x = [&](std::size_t k) {
      return out.number("x_s" + std::to_string(k), vertex(k)->raster.x, Place{Place::In::vertex, corners[k], "x_s"});
    };
    const auto y = [&](std::size_t k) {
      return out.number("y_s" + std::to_string(k), vertex(k)->raster.y, Place{Place::In::vertex, corners[k], "y_s"});
    };
    out.gives(&FacingTest::projected_normal_z, newell_z(zero, corners.size(), x, y));
  }
}

template <class Out>
void derive(const PolygonBegin& e, const Situation& at, Out& out) {
  // Of the polygon before, no edge is active whose end was come to.
  bool all_left = true;
  if (const auto& line = at.method().scan_line; line && !at.method().keeps_all)
    for (const ActiveEdge& active : at.method().active)
      if (const EdgeTableInsert* entry = at.edge(active.edge)) all_left = all_left && entry->end_row > *line;
  if (at.tells_leaving()) out.rule(Rule::edge_left_behind, all_left);
  const std::size_t facet = e.facet;
  if (e.facet < 0 || facet >= at.scene.facets.size()) return;
  out.rule(Rule::facet_of_polygon, at.scene.facets[facet].polygon == e.polygon);
}

namespace detail {

/// The facet that is dropped: the one at work, or the polygon's only one; -1 where it has several.
inline std::int32_t facet_dropped(const Situation& at, std::int32_t polygon) {
  const MethodState& method = at.method();
  if (method.facet >= 0 && method.polygon == polygon) return method.facet;
  const auto& facets = at.scene.facets;
  const auto first = std::lower_bound(facets.begin(), facets.end(), polygon,
                                      [](const Facet& facet, std::int32_t number) { return facet.polygon < number; });
  const bool only_one = first != facets.end() && first->polygon == polygon &&
                        (first + 1 == facets.end() || (first + 1)->polygon != polygon);
  return only_one ? static_cast<std::int32_t>(first - facets.begin()) : -1;
}

/// How clear a reason has to be: by what share of itself, or as a sine, a number that should be 0 may be off. What is
/// seen edge-on, or has no area, is decided by a tolerance of the program's own.
inline constexpr double clearly_off = 1e-3;

/// Does a facet on the raster cover an area, beyond what a program may take for none?
inline bool has_area_on_screen(const Situation& at, std::span<const std::int32_t> corners) {
  constexpr double most = 1e9;  // pixels: no raster holds more
  double twice = 0, size = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 &a = at.scene.points[corners[i]], &b = at.scene.points[corners[(i + 1) % corners.size()]];
    if (!(std::abs(a.x) < most && std::abs(a.y) < most)) return false;
    twice += a.x * b.y - b.x * a.y;
    size = std::max({size, std::abs(b.x - a.x), std::abs(b.y - a.y)});
  }
  return std::abs(twice) > clearly_off * size * size;
}

/// Is a facet turned away from the eye, in world coordinates? The cosine between the line of sight and the normal;
/// nothing where it has no area.
inline std::optional<double> turned_away(const Situation& at, std::span<const std::int32_t> corners) {
  const auto point = [&](std::size_t i) { return at.scene.points[corners[i]]; };
  const glm::dvec3 normal = newell_normal(glm::dvec3(0), corners.size(), point);
  const glm::dvec3 sight = at.camera->kind == Camera::Kind::orthographic ? -at.camera->eye : point(0) - at.camera->eye;
  double size = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) size = std::max(size, glm::length(point(i) - point(0)));
  const double length = glm::length(normal), away = glm::length(sight);
  if (!(length > clearly_off * size * size) || !(away > 0)) return std::nullopt;
  return glm::dot(sight, normal) / (away * length);
}

/// Does a part of a facet surely lie in view?
inline bool is_in_view(const Situation& at, std::span<const std::int32_t> corners) {
  std::vector<glm::dvec3> outline;
  for (const std::int32_t corner : corners) {
    const glm::dvec3& world = at.scene.points[corner];
    const VertexStages* viewed = at.viewed(corner);
    outline.push_back(at.on_screen() ? world
                      : viewed       ? viewed->view
                                     : glm::dvec3(at.camera->view * glm::dvec4(world, 1)));
  }
  const Raster& raster = at.scene.raster;
  if (at.on_screen()) {
    constexpr int sides = 4;
    return remains_inside(std::move(outline), sides, [&](int side, const glm::dvec3& p) {
      const double along = side < 2 ? p.x : p.y, last = (side < 2 ? raster.width : raster.height) - 1;
      return side % 2 == 0 ? along : last - along;
    });
  }
  const Camera& camera = *at.camera;
  const ViewVolume<Rounded> volume{camera.kind == Camera::Kind::orthographic,
                                   camera.near,
                                   camera.far,
                                   camera.d,
                                   window_width<Rounded>(camera.window, raster.width, raster.height),
                                   camera.window};
  return remains_inside(std::move(outline), clip_planes, [&](int plane, const glm::dvec3& p) {
    const Rounded distance = distance_inside<Rounded>(volume, static_cast<ClipPlane>(plane), p.x, p.y, p.z);
    return distance.value - rounding_of_float32 * distance.spread;
  });
}

/// Is a facet dropped for this reason rightly? Nothing where that is not known, or not clear. What the run's own tests
/// say goes before what its vertices do: those tests are judged themselves.
inline std::optional<bool> drops_rightly(const Situation& at, std::int32_t facet, Reject reason) {
  const MethodState& method = at.method();
  const std::span<const std::int32_t> corners = corners_of(at, facet);
  const bool kept_back = at.header.declares(Convention::cull) && !at.header.conventions.cull;
  if (reason == Reject::back_facing && kept_back) return false;
  const bool by_facing = reason == Reject::back_facing || reason == Reject::edge_on;
  // A piece of a facet may lie, and a tree may see it, where the facet as a whole does not.
  const bool whole = method.pieces.empty() && method.tree.empty();
  if (by_facing && !whole) return std::nullopt;
  if (by_facing && method.facing)
    return method.facing->facing == (reason == Reject::edge_on ? Facing::edge_on : Facing::back);
  if (reason == Reject::outside) {
    if (method.facing && method.facing->facing == Facing::back && at.header.conventions.cull) return false;
    if (method.clip_test && method.clip_test->outside_all != 0) return true;
    if (method.clip_test && method.clip_test->outside_some == 0) return false;
  }
  if (corners.empty() || (!at.camera && !at.on_screen())) return std::nullopt;
  if (reason == Reject::outside) return whole ? std::optional(!is_in_view(at, corners)) : std::nullopt;
  if (at.on_screen())
    return reason == Reject::back_facing ? std::nullopt : std::optional(!has_area_on_screen(at, corners));
  const std::optional<double> away = turned_away(at, corners);
  if (reason == Reject::edge_on) return !away || std::abs(*away) <= clearly_off;
  if (reason == Reject::back_facing) return !away || *away > -rounding_of_float64;
  // What clipping leaves may have none, or coordinates that no raster holds.
  const bool may_be_cut = !whole || !method.clip_test || method.clip_test->outside_some != 0;
  if (!away || std::abs(*away) <= clearly_off) return true;
  return may_be_cut ? std::nullopt : std::optional(false);
}

}  // namespace detail

template <class Out>
void derive(const PolygonReject& e, const Situation& at, Out& out) {
  const MethodState& method = at.method();
  // A tree is gone through without one polygon at work.
  const bool is_another = method.polygon != no_polygon && method.facet >= 0 && e.polygon != method.polygon;
  const auto rightly = detail::drops_rightly(at, detail::facet_dropped(at, e.polygon), e.reason);
  if (is_another || rightly) out.rule(Rule::reject_is_right, !is_another && *rightly);
}

/// On the outside of which planes of the view volume some, and all, corners lie.
template <class Out>
void derive(const ClipTest& e, const Situation& at, Out& out) {
  const std::span<const std::int32_t> corners = detail::corners_of(at, at.method().facet);
  if (corners.empty() || !at.camera || at.on_screen()) return;
  std::int32_t some = 0, all = (1 << detail::clip_planes) - 1, open = 0;
  for (const std::int32_t corner : corners) {
    if (!at.viewed(corner)) return;
    out.reads(Place{Place::In::vertex, corner});
    for (int plane = 0; plane < detail::clip_planes; ++plane) {
      detail::Plainly plainly;
      const Rounded inside = *detail::distance_of_vertex(plainly, at, static_cast<ClipPlane>(plane), corner, "");
      if (std::abs(inside.value) <= rounding_of_float32 * inside.spread) open |= 1 << plane;
      if (inside.value < 0) some |= 1 << plane;
      else all &= ~(1 << plane);
    }
  }
  // What touches a plane may be on either side of it.
  out.is(&ClipTest::outside_some, (some & ~open) | (e.outside_some & open));
  out.is(&ClipTest::outside_all, (all & ~open) | (e.outside_all & open));
}

template <class Out>
void derive(const OutlineVertex& e, const Situation& at, Out& out) {
  const std::span<const std::int32_t> corners = detail::corners_of(at, at.method().facet);
  if (corners.empty() || !at.is_point(e.vertex)) return;
  const auto here = std::find(corners.begin(), corners.end(), e.vertex);
  bool goes_on = here != corners.end();
  const auto& outline = at.method().outline;
  // From corner to corner; where it is clipped some may be left out, but then others are made between.
  if (goes_on && !outline.empty() && at.is_point(outline.back())) {
    const std::size_t i = static_cast<std::size_t>(here - corners.begin()), n = corners.size();
    const std::int32_t last = outline.back();
    goes_on = corners[(i + n - 1) % n] == last || corners[(i + 1) % n] == last;
  }
  out.rule(Rule::outline_of_facet, goes_on);
}

template <class Out>
void derive(const ClipVertex& e, const Situation& at, Out& out) {
  if (const auto distance = detail::distance_of_vertex(out, at, e.plane, e.vertex, "_v"))
    out.gives(&ClipVertex::distance, *distance);
  out.is(&ClipVertex::inside, e.distance >= 0);
}

template <class Out>
void derive(const ClipCross& e, const Situation& at, Out& out) {
  const auto in = detail::distance_of_vertex(out, at, e.plane, e.vertex_inside, "_in"),
             outside = detail::distance_of_vertex(out, at, e.plane, e.vertex_outside, "_out");
  if (!in || !outside) return;
  out.gives(&ClipCross::t, where_zero(out.named("d_in", *in), out.named("d_out", *outside)));
  const auto from = vector_of(out, "_in", at.vertex(e.vertex_inside)->view, Place{Place::In::vertex, e.vertex_inside},
                              view_stage),
             to = vector_of(out, "_out", at.vertex(e.vertex_outside)->view, Place{Place::In::vertex, e.vertex_outside},
                            view_stage);
  const auto t = out.number("t", e.t, Place{});
  out.gives(&ClipCross::x_v, part_of_way(from.x, to.x, t));
  out.gives(&ClipCross::y_v, part_of_way(from.y, to.y, t));
  out.gives(&ClipCross::z_v, part_of_way(from.z, to.z, t));
}

}  // namespace zstep::formulas
