// What happens at one pixel: z–x interpolation, the compare, the two writes (000, "The algorithm"; 004 for the tie).
#pragma once

#include <cmath>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "traces/formulas/attributes.hpp"
#include "traces/formulas/shading.hpp"
#include "traces/formulas/half_space.hpp"
#include "traces/formulas/of_pieces.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/situation.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::formulas {

namespace detail {

/// What is interpolated to a depth on the raster, and back: itself, but where 1/z_v is interpolated to get z_v.
template <class T>
T interpolated(const Situation& at, const T& z) {
  return at.header.conventions.depth == Conventions::Depth::corrected ? T(1) / z : z;
}

/// The depth that the scene has at a pixel of the facet at work, on the plane through its vertices as they are drawn.
template <class E, class Out>
void derive_depth_in_scene(const E& e, const Situation& at, Out& out) {
  const DrawnFacet* facet = at.drawn_facet();
  if (!facet || !facet->has_depth_at(e.x, e.y)) return;
  const DrawnCorner& corner = facet->origin();
  const Place scene{Place::In::scene};
  const Place from = corner.vertex >= 0 ? Place{Place::In::vertex, corner.vertex} : scene;
  const auto z = interpolated(
      at, along_plane(out.number("z_0", corner.z, from["z"]), out.number("dz/dx", facet->dz_dx(), scene["dz_dx"]),
                      out.number("x", e.x, Place{}), out.number("x_0", corner.x, from["x_s"]),
                      out.number("dz/dy", facet->dz_dy(), scene["dz_dy"]), out.number("y", e.y, Place{}),
                      out.number("y_0", corner.y, from["y_s"])));
  // Of 1/z_v, which is what is linear, z_v is off by z_v^2 times as much.
  const double linear = facet->linear_at(e.x, e.y);
  const bool divides = at.header.conventions.depth == Conventions::Depth::corrected;
  out.within(&E::z, z, divides ? facet->off() / (linear * linear) : facet->off());
}

/// The depth of a pixel from the slopes of its polygon's plane: from its left neighbour's, or from a vertex. Where
/// slopes are added from line to line, the first one of a span follows from a line that is gone: then nothing is said.
/// A run without spans has no such lines.
template <class E, class Out>
void derive_depth_on_plane(const E& e, const Situation& at, Out& out) {
  const auto& slopes = at.method().slopes;
  if (!slopes && !at.records<SpanBegin>()) return derive_depth_in_scene(e, at, out);
  if (!slopes || (at.method().polygon != no_polygon && slopes->polygon != at.method().polygon)) return;
  const Place plane{Place::In::plane, 0}, from{Place::In::vertex, slopes->vertex_0};
  const auto dz_dx = out.number("dz/dx", slopes->dz_dx, plane["dz_dx"]);
  const Fragment* left = at.fragment(e.x - 1, e.y);
  if (at.adds_slopes() && (left || at.records<SpanBegin>())) {
    if (!left) return;
    const auto z = interpolated(at, out.number("z", left->z, Place{Place::In::fragment, 0, "z"}));
    return out.gives(&E::z, interpolated(at, z + dz_dx));
  }
  const auto vertex = at.on_raster(slopes->vertex_0);
  if (!vertex || !at.has_depth(slopes->vertex_0)) return;
  const auto z =
      along_plane(out.number("z_0", vertex->z, from["z"]), dz_dx, out.number("x", e.x, Place{}),
                  out.number("x_0", vertex->x, from["x_s"]), out.number("dz/dy", slopes->dz_dy, plane["dz_dy"]),
                  out.number("y", e.y, Place{}), out.number("y_0", vertex->y, from["y_s"]));
  out.gives(&E::z, interpolated(at, z));
}

/// The depth of a pixel from those of its triangle's vertices, by its weights.
template <class E, class Out>
void derive_depth_by_weights(const BarycentricWeights& weights, const Situation& at, Out& out) {
  const auto z = depths_of_triangle(out, at);
  if (!z) return;
  const auto w = weight_numbers(out, weights);
  out.gives(&E::z, interpolated(at, by_weights((*z)[0], w[0], (*z)[1], w[1], (*z)[2])));
}

/// The depth that the span at work has at a pixel; in a run without spans, what its triangle, or the plane of the
/// polygon, has there.
template <class E, class Out>
void derive_depth_on_span(const E& e, const Situation& at, Out& out) {
  if (const BarycentricWeights* weights = weights_at(at, e.x, e.y))
    return derive_depth_by_weights<E>(*weights, at, out);
  if (!at.records<SpanBegin>()) return derive_depth_on_plane(e, at, out);
  const auto span = at.span_of(e);
  if (!span) return;
  const Place& place = span.place;
  out.rule(Rule::pixel_in_span, Situation::covers(*span.span, e.x, e.y));
  if (span->y != e.y) return;
  using enum Conventions::Interpolation;
  const auto how = at.header.conventions.interpolation;
  if (how == plane || how == plane_increments) {
    if (!span.is_of_other(at)) derive_depth_on_plane(e, at, out);
    return;
  }
  const auto z_left = out.number("z_L", span->z_left, place["z_left"]);
  if (how == increments) {
    // The first pixel of a span has nothing to be added to: its depth is computed directly.
    const Fragment* left = at.fragment(e.x - 1, e.y);
    const bool known = span.open ? span.open->x_last == e.x - 1 : left != nullptr;
    if (span.open && !known && e.x != span->first) return;
    if (known) {
      const bool is_last = left && (!span.open || left->z == span.open->z_last);
      const Place from = is_last ? Place{Place::In::fragment, 0, "z"} : Place{};
      const auto z = interpolated(at, out.number("z", is_last ? left->z : span.open->z_last, from));
      return out.gives(&E::z, interpolated(at, z + out.number("dz/dx", span->dz_dx, place["dz_dx"])));
    }
  }
  if (span->x_right == span->x_left) return out.gives(&E::z, interpolated(at, z_left));
  const auto z =
      on_line(z_left, out.number("z_R", span->z_right, place["z_right"]), out.number("x", e.x, Place{}),
              out.number("x_L", span->x_left, place["x_left"]), out.number("x_R", span->x_right, place["x_right"]));
  out.gives(&E::z, interpolated(at, z));
}

/// The pixel at work was nearer, so that its depth has to be written before another pixel's turn comes. Glass is mixed
/// in and writes no depth.
inline bool has_won(const Situation& at) {
  const auto& last = at.method().fragment;
  return last && last->nearer && *last->nearer && at.has_step<DepthWrite>() && !at.method().compares_write &&
         !at.has_step<ColorBlend>();
}
/// And it has not been written.
template <class Out>
bool last_win_is_missing(const Situation& at, const Out& out) {
  if (!has_won(at)) return false;
  const Fragment& last = *at.method().fragment;
  const double stored = at.stored(last.x, last.y);
  return stored != last.z && !out.equal(stored, last.z) && stored == last.stored;
}

/// Nothing of the pixel that comes next follows from that one.
template <class Out>
void derive_last_win(const Situation& at, Out& out) {
  if (has_won(at)) out.rule(Rule::win_is_written, !last_win_is_missing(at, out));
}

}  // namespace detail

template <class Out>
void derive(const DepthInterpolate& e, const Situation& at, Out& out) {
  detail::derive_last_win(at, out);
  detail::derive_depth_on_span(e, at, out);
}

namespace detail {

/// The piece that pixels are being painted with where it is its plane that gives the depths; -1 where none is.
inline std::int32_t piece_painted(const Situation& at) {
  const MethodState& method = at.method();
  const std::size_t area = method.area;
  if (method.area >= 0 && area < method.areas.size())
    return method.areas[area].decided ? method.areas[area].decided->piece : -1;
  return method.sweep.winners.empty() ? -1 : method.sweep.winners.back().piece;
}

template <class Out>
void derive_painted_by_plane(const PixelPaint& e, const Situation& at, Out& out) {
  const std::int32_t number = piece_painted(at);
  const Piece* piece = at.piece(number);
  if (!piece || !piece->plane) return;
  const auto plane = plane_of(out, at, number);
  out.is(&PixelPaint::polygon, piece->polygon);
  out.gives(&PixelPaint::z, plane_depth(plane->a, plane->b, plane->c, plane->d, out.number("x", e.x, Place{}),
                                        out.number("y", e.y, Place{})));
  if (!at.method().sweep.winners.empty()) {
    const SpanWinner& winner = at.method().sweep.winners.back();
    const bool on_line = at.method().scan_line.value_or(e.y) == e.y;
    out.rule(Rule::pixel_in_span, e.x >= winner.first && e.x <= winner.last && on_line);
  } else if (at.method().area >= 0) {
    const AreaBegin& area = at.method().areas[at.method().area].entry;
    out.rule(Rule::pixel_in_area,
             e.x >= area.first_column && e.x < area.end_column && e.y >= area.first_row && e.y < area.end_row);
  }
}

/// What the ray of a pixel met: its depth as the buffer has it.
template <class Out>
void derive_painted_by_ray(const PixelPaint& e, const Situation& at, Out& out) {
  const auto& tree = at.method().rays.tree;
  if (tree.empty() || !tree.front().end) return;
  out.reads(Place{Place::In::ray, 0});
  const RayBegin& ray = tree.front().entry;
  const RayEnd& end = *tree.front().end;
  out.rule(Rule::ray_paints_own, ray.x == e.x && ray.y == e.y);
  const std::size_t facet = end.nearest_facet;
  if (end.nearest_facet < 0 || facet >= at.scene.facets.size()) return;
  out.is(&PixelPaint::polygon, at.scene.facets[facet].polygon);
  if (!at.camera || !at.header.declares(Convention::depth)) return;
  if (at.on_screen()) return out.near(&PixelPaint::z, Rounded(ray.z_0) + Rounded(end.t) * Rounded(ray.dir_z));
  const Camera& camera = *at.camera;
  // z_v of the point that is met: row 3 of T_v.
  const auto& view = camera.view;
  const Rounded t(end.t);
  const Rounded z_v =
      matrix_row<Rounded>(view[0][2], view[1][2], view[2][2], view[3][2], Rounded(ray.x_0) + t * Rounded(ray.dir_x),
                          Rounded(ray.y_0) + t * Rounded(ray.dir_y), Rounded(ray.z_0) + t * Rounded(ray.dir_z));
  out.near(&PixelPaint::z,
           vertex_depth(depth_scale(camera, at.header.conventions.depth, [](double number) { return Rounded(number); }),
                        z_v));
}

}  // namespace detail

template <class Out>
void derive(const PixelPaint& e, const Situation& at, Out& out) {
  if (at.span_of(e)) {
    const bool one_at_work = !at.of_any() && !at.ahead.of_all;
    if (at.method().polygon != no_polygon && one_at_work) out.is(&PixelPaint::polygon, at.method().polygon);
    return detail::derive_depth_on_span(e, at, out);
  }
  detail::derive_painted_by_plane(e, at, out);
  detail::derive_painted_by_ray(e, at, out);
}

template <class Out>
void derive(const DepthCompare& e, const Situation& at, Out& out) {
  const Place buffer = at.depth_place(e.x, e.y);
  if (const Fragment* fragment = at.fragment(e.x, e.y); fragment && !fragment->nearer) {
    out.gives(&DepthCompare::z, out.number("z", fragment->z, Place{Place::In::fragment, 0, "z"}));
  } else {
    if (!at.records<DepthInterpolate>()) detail::derive_last_win(at, out);
    detail::derive_depth_on_span(e, at, out);
  }
  // Of glass a win writes no depth: which do is known of a run that says so.
  if (at.has_step<ColorBlend>() && !at.records<DepthWrite>()) return;
  const auto z = out.number("z", e.z, Place{}), stored = out.number("zbuffer[x,y]", at.stored(e.x, e.y), buffer["z"]);
  out.verdict(&DepthCompare::nearer, z, stored);
}

template <class Out>
void derive(const DepthWrite& e, const Situation& at, Out& out) {
  const Fragment* fragment = at.fragment(e.x, e.y);
  if (!fragment && !at.records<DepthCompare>() && !at.records<DepthInterpolate>() && !at.records<SpanBegin>())
    return detail::derive_depth_in_scene(e, at, out);
  if (!fragment || !fragment->nearer) return;
  out.rule(Rule::write_after_win, *fragment->nearer);
  out.gives(&DepthWrite::z, out.number("z", fragment->z, Place{Place::In::fragment, 0, "z"}));
}

template <class Out>
void derive(const PixelWrite& e, const Situation& at, Out& out) {
  const Fragment* fragment = at.fragment(e.x, e.y);
  if (fragment && fragment->nearer) {
    out.reads(Place{Place::In::fragment, 0});
    out.rule(Rule::write_after_win, *fragment->nearer);
  }
  if (at.ahead.of_all) {
    if (const auto polygon = at.polygon_of_pixel(e.x, e.y)) {
      const bool right = fragment && at.ahead.may_be(e.polygon, e.x, e.y, fragment->z);
      out.is(&PixelWrite::polygon, right ? e.polygon : *polygon);
    }
    return;
  }
  if (at.method().polygon != no_polygon && !at.method().keeps_all) out.is(&PixelWrite::polygon, at.method().polygon);
}

namespace detail {

/// Which number of the attribute the next one at this pixel is: they come one after the other.
inline std::int32_t component_at_work(const Situation& at, const Shading& shading, std::int32_t x, std::int32_t y) {
  const std::int32_t next = next_component(at.method(), x, y);
  return next < shading.components() ? next : 0;
}
/// As attribute_of(), for the facet at work.
inline double attribute_at(const Situation& at, const Shading& shading, std::int32_t component, std::int32_t vertex,
                           const glm::dvec3& view) {
  return attribute_of(at.scene, shading, component, at.method().facet, vertex, view, [&](std::int32_t point) {
    const VertexStages* stages = at.vertex(point);
    return stages ? stages->view : glm::dvec3(0);
  });
}

/// A component of a vertex's attribute and where its formula finds it, with the viewing depth; nothing before it was
/// viewed.
template <class Out>
auto over_depth_of_vertex(Out& out, const Situation& at, const AttributeInterpolate& e, std::int32_t vertex,
                          const std::string& suffix) {
  using T = typename Out::Number;
  const VertexStages* stages = at.viewed(vertex);
  if (!stages && !at.on_screen()) return std::optional<OverDepth<T>>();
  const Shading shading = shading_of(at.scene, at.header.conventions);
  if (!shading.is_known() || (shading.attribute && !at.is_facet(at.method().facet)))
    return std::optional<OverDepth<T>>();
  // What clipping made has its value by view coordinates of the facet's own vertices.
  if (shading.attribute && !at.is_point(vertex)) {
    const Facet& facet = at.scene.facets[at.method().facet];
    for (std::int32_t k = 0; k < facet.corner_count; ++k)
      if (!at.viewed(at.scene.corners[facet.first_corner + k])) return std::optional<OverDepth<T>>();
  }
  const std::int32_t component = component_at_work(at, shading, e.x, e.y);
  const double value = attribute_at(at, shading, component, vertex, stages ? stages->view : glm::dvec3(0));
  const std::string_view name = shading.name(component);
  const T a = out.number("a_" + suffix, value, at.is_point(vertex) ? Place{Place::In::point, vertex, name} : Place{});
  if (!attribute_over_depth(at.scene, at.header.conventions)) return std::optional(OverDepth<T>{a, T(1)});
  const Place seen{Place::In::vertex, vertex, "z_v"};
  return std::optional(over_depth(a, out.number("z_" + suffix, stages->view.z, seen)));
}

/// Along an edge to the scan line at work.
template <class Out>
auto over_depth_on_edge(Out& out, const Situation& at, const AttributeInterpolate& e, std::int32_t edge,
                        const char* suffix_0, const char* suffix_1) {
  using T = typename Out::Number;
  const EdgeTableInsert* entry = at.edge(edge);
  if (!entry) return std::optional<OverDepth<T>>();
  const auto p_0 = over_depth_of_vertex(out, at, e, entry->vertex_0, suffix_0),
             p_1 = over_depth_of_vertex(out, at, e, entry->vertex_1, suffix_1);
  const auto from = at.on_raster(entry->vertex_0), to = at.on_raster(entry->vertex_1);
  if (!p_0 || !p_1 || !from || !to) return std::optional<OverDepth<T>>();
  const T y_0 = out.number(std::string("y_") + suffix_0, from->y, Place{Place::In::vertex, entry->vertex_0, "y_s"}),
          y_1 = out.number(std::string("y_") + suffix_1, to->y, Place{Place::In::vertex, entry->vertex_1, "y_s"});
  return std::optional(on_line(*p_0, *p_1, out.number("y", e.y, Place{}), y_0, y_1));
}

}  // namespace detail

namespace detail {

/// The same from the vertices of a triangle, by the weights of the pixel.
template <class Out>
void derive_attribute_by_weights(const AttributeInterpolate& e, const BarycentricWeights& weights, bool divides,
                                 const Situation& at, Out& out) {
  const auto& setup = at.method().triangle.setup;
  if (!setup || (divides && !attribute_over_depth(at.scene, at.header.conventions))) return;
  const auto p_0 = over_depth_of_vertex(out, at, e, setup->vertex_0, "0"),
             p_1 = over_depth_of_vertex(out, at, e, setup->vertex_1, "1"),
             p_2 = over_depth_of_vertex(out, at, e, setup->vertex_2, "2");
  if (!p_0 || !p_1 || !p_2) return;
  const auto w = weight_numbers(out, weights);
  out.gives(&AttributeInterpolate::over_z, by_weights(p_0->over_z, w[0], p_1->over_z, w[1], p_2->over_z));
  if (divides)
    out.gives(&AttributeInterpolate::one_over_z,
              by_weights(p_0->one_over_z, w[0], p_1->one_over_z, w[1], p_2->one_over_z));
  else out.is(&AttributeInterpolate::one_over_z, 1.0);
}

}  // namespace detail

/// Blinn's hyperbolic interpolation: a/z_v and 1/z_v along the two edges and the span between them, and their quotient.
template <class Out>
void derive(const AttributeInterpolate& e, const Situation& at, Out& out) {
  if (const Fragment* fragment = at.fragment(e.x, e.y); fragment && fragment->nearer) {
    out.reads(Place{Place::In::fragment, 0});
    out.rule(Rule::write_after_win, *fragment->nearer);
  }
  if (!at.header.declares(Convention::depth) || at.header.conventions.attribute == Conventions::Attribute::none) return;
  const bool divides = at.header.conventions.attribute == Conventions::Attribute::perspective;
  const Place event{};
  const auto above = out.number(divides ? "a/z_v" : "a", e.over_z, event["over_z"]);
  out.gives(&AttributeInterpolate::attribute,
            divides ? above / out.number("1/z_v", e.one_over_z, event["one_over_z"]) : above);
  if (const BarycentricWeights* weights = detail::weights_at(at, e.x, e.y))
    return detail::derive_attribute_by_weights(e, *weights, divides, at, out);
  const auto span = at.span_of(e);
  if (!span) return;
  out.rule(Rule::pixel_in_span, Situation::covers(*span.span, e.x, e.y));
  if (span->y != e.y || span.is_of_other(at)) return;
  // Of points on the screen only the program knows z_v.
  if (divides && !attribute_over_depth(at.scene, at.header.conventions)) return;
  const auto left = detail::over_depth_on_edge(out, at, e, span->left_edge, "0", "1"),
             right = detail::over_depth_on_edge(out, at, e, span->right_edge, "2", "3");
  if (!left || !right) return;
  const Place& place = span.place;
  const auto here = span->x_right == span->x_left ? *left
                                                  : on_line(*left, *right, out.number("x", e.x, Place{}),
                                                            out.number("x_L", span->x_left, place["x_left"]),
                                                            out.number("x_R", span->x_right, place["x_right"]));
  out.gives(&AttributeInterpolate::over_z, here.over_z);
  if (divides) out.gives(&AttributeInterpolate::one_over_z, here.one_over_z);
  else out.is(&AttributeInterpolate::one_over_z, 1.0);
}

}  // namespace zstep::formulas
