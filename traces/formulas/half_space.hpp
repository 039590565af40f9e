// What a run has told of the triangle at work, for the formulas of edge_functions.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "traces/formulas/edge_functions.hpp"
#include "traces/formulas/of_polygons.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep::formulas {

namespace detail {

/// Of an option of the run.
inline bool has_option(const Situation& at, const char* name, const char* value) {
  const auto& options = at.header.conventions.options;
  const auto found = options.find(name);
  return found != options.end() && found->second == value;
}

/// The places of what belongs to the triangle at work, by number; its edge functions have 0 to 2.
inline constexpr std::int64_t setup_place = 3, test_place = 4, weights_place = 5, sample_place = 6, mask_place = 7;
inline Place triangle_place(std::int64_t number, std::string_view field = {}) {
  return {Place::In::triangle, number, field};
}
/// One of three names, "A_0 A_1 A_2".
constexpr std::string_view numbered(std::string_view names, std::size_t number) { return names.substr(4 * number, 3); }

inline bool has_edges(const Situation& at) { return at.method().triangle.edges.size() == 3; }

/// E_i at a pixel's centre; nothing where its ends are not known.
template <class Out>
[[gnu::always_inline]] inline auto edge_value_at(Out& out, const Situation& at, std::size_t i, std::int32_t x,
                                                 std::int32_t y) -> std::optional<typename Out::Number> {
  const Situation::TriangleNow::End& from = at.triangle().ends[i];
  if (from.vertex < 0) return std::nullopt;
  const EdgeFunction& edge = at.method().triangle.edges[i];
  const Place end{Place::In::vertex, from.vertex};
  const auto index = static_cast<std::int64_t>(i);
  const auto a = out.number(numbered("A_0 A_1 A_2", i), edge.edge_a, triangle_place(index, "edge_a"));
  const auto b = out.number(numbered("B_0 B_1 B_2", i), edge.edge_b, triangle_place(index, "edge_b"));
  const auto end_x = out.number(numbered("X_0 X_1 X_2", i), from.x, end["x_s"]);
  const auto end_y = out.number(numbered("Y_0 Y_1 Y_2", i), from.y, end["y_s"]);
  if (at.steps_edges) return edge_value_stepped(a, b, x, end_x, y, end_y);
  return edge_value(a, b, out.number("x", x, Place{}), end_x, out.number("y", y, Place{}), end_y);
}

/// The depths of the triangle's vertices; nothing where the run does not have them.
template <class Out>
auto depths_of_triangle(Out& out, const Situation& at) -> std::optional<std::array<typename Out::Number, 3>> {
  const Situation::TriangleNow& triangle = at.triangle();
  if (!triangle.depths) return std::nullopt;
  const auto depth = [&](std::size_t i) {
    return out.number(numbered("z_0 z_1 z_2", i), (*triangle.depths)[i],
                      Place{Place::In::vertex, triangle.vertices[i], "z"});
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
