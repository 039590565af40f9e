// Triangles as three half-planes, and what is linear on them: J. Pineda, "A Parallel Algorithm for Polygon
// Rasterization", SIGGRAPH 1988; barycentric weights; the top-left rule of Foley et al., section 3.6.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::formulas {

/// Twice the area of a triangle on the raster; positive where the vertices run so that all edge functions are positive
/// inside.
template <class T>
T twice_area(const T& x_0, const T& y_0, const T& x_1, const T& y_1, const T& x_2, const T& y_2) {
  return (x_1 - x_0) * (y_2 - y_0) - (x_2 - x_0) * (y_1 - y_0);
}

/// Is the first of an edge's ends the one by which its function is computed? So triangles that share an edge have
/// functions of it that are opposite to the last bit, and at both ends exactly 0.
template <class T>
bool is_first_end(const T& x_0, const T& y_0, const T& x_1, const T& y_1) {
  return y_0 < y_1 || (y_0 == y_1 && x_0 <= x_1);
}

/// E(x, y) of the edge with these A and B through (X, Y).
template <class T>
T edge_value(const T& a, const T& b, const T& x, const T& end_x, const T& y, const T& end_y) {
  return a * (x - end_x) + b * (y - end_y);
}
/// C in E(x, y) = A x + B y + C.
template <class T>
T edge_constant(const T& a, const T& b, const T& end_x, const T& end_y) {
  return -(a * end_x + b * end_y);
}

/// The side of a tile, in pixels. Where E is stepped it is computed anew at the corner of each tile of the raster, so
/// that triangles that share an edge add the same numbers.
inline constexpr std::int32_t tile_side = 8;
constexpr std::int32_t tile_start(std::int32_t pixel) { return pixel - pixel % tile_side; }

/// E at a pixel's centre, by B from line to line and by A from pixel to pixel.
template <class T>
T edge_value_stepped(const T& a, const T& b, std::int32_t x, const T& end_x, std::int32_t y, const T& end_y) {
  T e = edge_value(a, b, T(static_cast<double>(tile_start(x))), end_x, T(static_cast<double>(tile_start(y))), end_y);
  for (std::int32_t row = tile_start(y); row < y; ++row) e = e + b;
  for (std::int32_t column = tile_start(x); column < x; ++column) e = e + a;
  return e;
}

/// The first column, or row, of a bounding box, and the one just beyond it, within the raster.
inline std::int32_t box_first(double least, std::int32_t size) { return row_from(least, size); }
inline std::int32_t box_end(double greatest, std::int32_t size) {
  if (!(greatest >= 0)) return 0;
  return greatest >= size ? size : floor_int(greatest) + 1;
}

/// A centre on the line belongs to the triangle to the right of it, or below.
inline bool owns_line(double a, double b) { return a > 0 || (a == 0 && b > 0); }
inline bool is_on_side(double e, bool owns) { return e > 0 || (e == 0 && owns); }

/// What is linear on a triangle, from its values at the vertices: w_0 p_0 + w_1 p_1 + w_2 p_2. As w_0 is 1 - w_1 - w_2
/// but for rounding, it is computed from vertex 0, so that what is the same at all vertices is so at each pixel.
template <class T>
T by_weights(const T& p_0, const T& w_1, const T& p_1, const T& w_2, const T& p_2) {
  return p_0 + (w_1 * (p_1 - p_0) + w_2 * (p_2 - p_0));
}

namespace detail {

/// Of an option of the run.
inline bool has_option(const Situation& at, const char* name, const char* value) {
  const auto& options = at.header.conventions.options;
  const auto found = options.find(name);
  return found != options.end() && found->second == value;
}

/// The places of what belongs to the triangle at work, by number; its edge functions have 0 to 2.
inline constexpr std::int64_t setup_place = 3, test_place = 4, weights_place = 5;
inline Place triangle_place(std::int64_t number, std::string_view field = {}) {
  return {Place::In::triangle, number, field};
}
inline std::string numbered(const char* name, std::size_t number) { return name + std::to_string(number); }

inline bool has_edges(const Situation& at) { return at.method().triangle.edges.size() == 3; }

/// E_i at a pixel's centre; nothing where its ends are not known.
template <class Out>
auto edge_value_at(Out& out, const Situation& at, std::size_t i, std::int32_t x, std::int32_t y)
    -> std::optional<typename Out::Number> {
  const EdgeFunction& edge = at.method().triangle.edges[i];
  const auto from = at.on_raster(edge.vertex_0), to = at.on_raster(edge.vertex_1);
  if (!from || !to) return std::nullopt;
  const bool first = is_first_end(from->x, from->y, to->x, to->y);
  const Place end{Place::In::vertex, first ? edge.vertex_0 : edge.vertex_1};
  const auto index = static_cast<std::int64_t>(i);
  const auto a = out.number(numbered("A_", i), edge.edge_a, triangle_place(index, "edge_a"));
  const auto b = out.number(numbered("B_", i), edge.edge_b, triangle_place(index, "edge_b"));
  const auto end_x = out.number(numbered("X_", i), first ? from->x : to->x, end["x_s"]);
  const auto end_y = out.number(numbered("Y_", i), first ? from->y : to->y, end["y_s"]);
  if (has_option(at, "stepping", "increments")) return edge_value_stepped(a, b, x, end_x, y, end_y);
  return edge_value(a, b, out.number("x", x, Place{}), end_x, out.number("y", y, Place{}), end_y);
}

/// The depths of the triangle's vertices; nothing where the run does not have them.
template <class Out>
auto depths_of_triangle(Out& out, const Situation& at) -> std::optional<std::array<typename Out::Number, 3>> {
  const auto& setup = at.method().triangle.setup;
  if (!setup) return std::nullopt;
  const std::array<std::int32_t, 3> vertices{setup->vertex_0, setup->vertex_1, setup->vertex_2};
  for (const std::int32_t vertex : vertices)
    if (!at.on_raster(vertex) || !at.has_depth(vertex)) return std::nullopt;
  const auto depth = [&](std::size_t i) {
    return out.number(numbered("z_", i), at.on_raster(vertices[i])->z, Place{Place::In::vertex, vertices[i], "z"});
  };
  const auto z_0 = depth(0), z_1 = depth(1), z_2 = depth(2);
  return std::array{z_0, z_1, z_2};
}

/// The weights of a pixel, where it is the one at work.
inline const BarycentricWeights* weights_at(const Situation& at, std::int32_t x, std::int32_t y) {
  const auto& weights = at.method().triangle.weights;
  return weights && weights->x == x && weights->y == y ? &*weights : nullptr;
}
/// Those of vertices 1 and 2.
template <class Out>
auto weight_numbers(Out& out, const BarycentricWeights& weights) {
  const auto w_1 = out.number("w_1", weights.w_1, triangle_place(weights_place, "w_1"));
  const auto w_2 = out.number("w_2", weights.w_2, triangle_place(weights_place, "w_2"));
  return std::array{w_1, w_2};
}

}  // namespace detail

}  // namespace zstep::formulas
