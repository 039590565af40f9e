// Guesses about triangles: their edge functions, the tests of tiles and pixels, and weights. Part of foreteller.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

#include "traces/codec/foreteller.hpp"
#include "traces/formulas/edge_functions.hpp"
#include "traces/formulas/samples.hpp"

namespace zstep::codec {

inline void Foreteller::tell(TriangleSetup& event) const {
  const std::span<const std::int32_t> outline = outline_.empty() ? corners_ : std::span<const std::int32_t>(outline_);
  const std::size_t next = triangle_.of_polygon + 1;
  const bool in_fan = next + 1 < outline.size();
  event.vertex_0 = in_fan ? outline[0] : whole_[slot_of("vertex_0")];
  event.vertex_1 = in_fan ? outline[next] : whole_[slot_of("vertex_1")];
  event.vertex_2 = in_fan ? outline[next + 1] : whole_[slot_of("vertex_2")];
  glm::dvec3 p, q, r;
  if (find_raster(event.vertex_0, p) && find_raster(event.vertex_1, q) && find_raster(event.vertex_2, r) &&
      formulas::twice_area(p.x, p.y, q.x, q.y, r.x, r.y) < 0)
    std::swap(event.vertex_1, event.vertex_2);
}

inline void Foreteller::evaluate(TriangleSetup& event) {
  event.twice_area = 0, event.first_column = event.first_row = event.end_column = event.end_row = 0;
  glm::dvec3 p, q, r;
  if (!find_raster(event.vertex_0, p) || !find_raster(event.vertex_1, q) || !find_raster(event.vertex_2, r)) return;
  const Raster& raster = facts_->scene().raster;
  event.twice_area = formulas::twice_area(p.x, p.y, q.x, q.y, r.x, r.y);
  const double reach = facts_->reach();
  event.first_column = formulas::box_first(std::min({p.x, q.x, r.x}) - reach, raster.width);
  event.first_row = formulas::box_first(std::min({p.y, q.y, r.y}) - reach, raster.height);
  event.end_column = formulas::box_end(std::max({p.x, q.x, r.x}) + reach, raster.width);
  event.end_row = formulas::box_end(std::max({p.y, q.y, r.y}) + reach, raster.height);
}

template <>
inline void Foreteller::note(const TriangleSetup& event) {
  const std::size_t before = triangle_.of_polygon;
  triangle_ = {};
  triangle_.of_polygon = before + 1;
  triangle_.vertices = {event.vertex_0, event.vertex_1, event.vertex_2};
  triangle_.twice_area = event.twice_area;
  triangle_.known = true;
  for (std::size_t i = 0; i < 3; ++i)
    triangle_.known = find_raster(triangle_.vertices[i], triangle_.corners[i]) && triangle_.known;
  triangle_.box = {event.first_column, event.first_row, event.end_column, event.end_row, TileCover::partly};
  whole_[slot_of("edge_function")] = -1;
  walk_from(triangle_.box);
}

/// So the first pixel, or tile, of these is "one more".
inline void Foreteller::walk_from(const TileTest& box) {
  triangle_.walked = box;
  whole_[slot_of("x")] = static_cast<std::int32_t>(static_cast<std::uint32_t>(box.first_column) - 1u);
  whole_[slot_of("y")] = box.first_row;
}

/// The pixel after the last one, line by line.
inline std::pair<std::int32_t, std::int32_t> Foreteller::next_pixel() const {
  const auto x = static_cast<std::int32_t>(static_cast<std::uint32_t>(whole_[slot_of("x")]) + 1u);
  const std::int32_t y = whole_[slot_of("y")];
  const TileTest& box = triangle_.walked;
  if (x < box.end_column || box.end_column <= box.first_column) return {x, y};
  return {box.first_column, static_cast<std::int32_t>(static_cast<std::uint32_t>(y) + 1u)};
}

inline void Foreteller::evaluate(EdgeFunction& event) {
  event.vertex_0 = event.vertex_1 = 0, event.edge_a = event.edge_b = event.edge_c = 0, event.owns = false;
  if (event.edge_function < 0 || event.edge_function > 2) return;
  const auto i = static_cast<std::size_t>(event.edge_function);
  event.vertex_0 = triangle_.vertices[(i + 1) % 3], event.vertex_1 = triangle_.vertices[(i + 2) % 3];
  if (!triangle_.known) return;
  const KnownTriangle::Edge edge = triangle_.edge(i);
  event.edge_a = edge.a, event.edge_b = edge.b;
  event.edge_c = formulas::edge_constant(edge.a, edge.b, edge.x, edge.y);
  event.owns = formulas::owns_line(edge.a, edge.b);
}

template <>
inline void Foreteller::note(const EdgeFunction& event) {
  if (event.edge_function < 0 || event.edge_function > 2) return;
  const auto i = static_cast<std::size_t>(event.edge_function);
  triangle_.edges[i] = triangle_.edge(i);
  triangle_.told = true;
  triangle_.edges[i].a = event.edge_a, triangle_.edges[i].b = event.edge_b, triangle_.edges[i].owns = event.owns;
}

/// What is linear along a scan line, at the pixel right of `last`, which is right of `before`.
inline double Foreteller::carried_on(double last, double before) { return last + (last - before); }

inline double Foreteller::edge_value(std::size_t i, std::int32_t x, std::int32_t y) const {
  const KnownTriangle::Edge& edge = triangle_.edges[i];
  if (!triangle_.told) {
    const InsideTest &last = triangle_.test, &before = triangle_.test_before;
    const auto value = [&](const InsideTest& test) { return i == 0 ? test.e_0 : i == 1 ? test.e_1 : test.e_2; };
    const bool follows =
        last.y == y && before.y == y && last.x + std::int64_t{1} == x && before.x + std::int64_t{2} == x;
    return follows ? carried_on(value(last), value(before)) : value(last);
  }
  if (!facts_->steps_edges()) return formulas::edge_value<double>(edge.a, edge.b, x, edge.x, y, edge.y);
  const InsideTest& last = triangle_.test;
  if (last.y == y && last.x + std::int64_t{1} == x && x != formulas::tile_start(x))
    return (i == 0 ? last.e_0 : i == 1 ? last.e_1 : last.e_2) + edge.a;
  return formulas::edge_value_stepped<double>(edge.a, edge.b, x, edge.x, y, edge.y);
}

// --- Tiles

inline void Foreteller::tell(TileTest& event) const {
  const TileTest &box = triangle_.box, &last = triangle_.walked;
  const bool is_first = last.first_row == box.first_row && last.end_row == box.end_row && !triangle_.in_tiles;
  const bool along = !is_first && last.end_column < box.end_column;
  event.first_column = along ? last.end_column : box.first_column;
  event.first_row = is_first ? box.first_row : along ? last.first_row : last.end_row;
}

inline void Foreteller::evaluate(TileTest& event) {
  const auto end = [](std::int32_t first, std::int32_t of_box) {
    return static_cast<std::int32_t>(
        std::min<std::int64_t>(of_box, std::int64_t{formulas::tile_start(first)} + formulas::tile_side));
  };
  event.end_column = end(event.first_column, triangle_.box.end_column);
  event.end_row = end(event.first_row, triangle_.box.end_row);
  const auto before = [](std::int32_t beyond) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(beyond) - 1u);
  };
  const std::int32_t last_column = before(event.end_column), last_row = before(event.end_row);
  bool inside = true, outside = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const KnownTriangle::Edge& edge = triangle_.edges[i];
    const auto covers = [&](bool right, bool down) {
      const double e = edge_value(i, right ? last_column : event.first_column, down ? last_row : event.first_row);
      return formulas::is_on_side(e, edge.owns);
    };
    outside = outside || !covers(edge.a > 0, edge.b > 0);
    inside = inside && covers(!(edge.a > 0), !(edge.b > 0));
  }
  event.cover = outside ? TileCover::outside : inside ? TileCover::inside : TileCover::partly;
}

template <>
inline void Foreteller::note(const TileTest& event) {
  walk_from(event);
  triangle_.in_tiles = true;
}

// --- Pixels

inline void Foreteller::tell(InsideTest& event) const { std::tie(event.x, event.y) = next_pixel(); }

inline void Foreteller::evaluate(InsideTest& event) {
  event.e_0 = edge_value(0, event.x, event.y);
  event.e_1 = edge_value(1, event.x, event.y);
  event.e_2 = edge_value(2, event.x, event.y);
  const auto& edges = triangle_.edges;
  event.inside = formulas::is_on_side(event.e_0, edges[0].owns) && formulas::is_on_side(event.e_1, edges[1].owns) &&
                 formulas::is_on_side(event.e_2, edges[2].owns);
}

template <>
inline void Foreteller::note(const InsideTest& event) {
  if (!triangle_.told) triangle_.test_before = triangle_.test;
  keep(triangle_.test, event);
}

/// Where its tile was accepted a pixel is not tested.
inline void Foreteller::tell(BarycentricWeights& event) const {
  const bool accepted = triangle_.in_tiles && triangle_.walked.cover == TileCover::inside;
  if (accepted) std::tie(event.x, event.y) = next_pixel();
  else event.x = whole_[slot_of("x")], event.y = whole_[slot_of("y")];
}

/// The values of the edge functions at the pixel that was tested last; where none was they are computed.
inline InsideTest Foreteller::tested_at(std::int32_t x, std::int32_t y) const {
  if (triangle_.test.x == x && triangle_.test.y == y) return triangle_.test;
  return {x, y, edge_value(0, x, y), edge_value(1, x, y), edge_value(2, x, y), true};
}

inline void Foreteller::evaluate(BarycentricWeights& event) {
  const InsideTest test = tested_at(event.x, event.y);
  event.w_0 = test.e_0 / triangle_.twice_area;
  event.w_1 = test.e_1 / triangle_.twice_area;
  event.w_2 = test.e_2 / triangle_.twice_area;
}

template <>
inline void Foreteller::note(const BarycentricWeights& event) {
  if (triangle_.test.x != event.x || triangle_.test.y != event.y) triangle_.test = tested_at(event.x, event.y);
  keep(triangle_.weights, event);
  if (!triangle_.told && event.w_0 != 0) triangle_.twice_area = triangle_.test.e_0 / event.w_0;
}

template <>
inline void Foreteller::note(const DepthInterpolate& event) {
  triangle_.depth_before = triangle_.depth;
  keep(triangle_.depth, event);
}

inline double Foreteller::depth_by_weights(std::int32_t x, std::int32_t y) const {
  const auto& [p, q, r] = triangle_.corners;
  const BarycentricWeights& w = triangle_.weights;
  if (triangle_.known && w.x == x && w.y == y) return formulas::by_weights(p.z, w.w_1, q.z, w.w_2, r.z);
  const DepthInterpolate &last = triangle_.depth, &before = triangle_.depth_before;
  const bool follows = w.x == x && w.y == y && last.y == y && before.y == y && last.x + std::int64_t{1} == x &&
                       before.x + std::int64_t{2} == x;
  return follows ? carried_on(last.z, before.z) : real_[slot_of("z")];
}

// --- Samples

inline void Foreteller::tell(SampleTest& event) const {
  event.x = whole_[slot_of("x")], event.y = whole_[slot_of("y")];
  const SampleTest& last = triangle_.sample;
  const bool follows = last.x == event.x && last.y == event.y;
  event.sample = follows ? static_cast<std::int32_t>(static_cast<std::uint32_t>(last.sample) + 1u) : 0;
}

/// The edge functions beside the centre of the pixel that was tested last.
inline std::array<double, 3> Foreteller::edge_values_beside(std::int32_t x, std::int32_t y, double dx,
                                                            double dy) const {
  const InsideTest centre = tested_at(x, y);
  const auto beside = [&](std::size_t i, double e) {
    return formulas::edge_value_beside(e, triangle_.edges[i].a, dx, triangle_.edges[i].b, dy);
  };
  return {beside(0, centre.e_0), beside(1, centre.e_1), beside(2, centre.e_2)};
}
inline bool Foreteller::is_within(const std::array<double, 3>& e) const {
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) inside = inside && formulas::is_on_side(e[i], triangle_.edges[i].owns);
  return inside;
}
/// The depth where the edge functions are these.
inline double Foreteller::depth_by_edges(double e_1, double e_2) const {
  const auto& [p, q, r] = triangle_.corners;
  return formulas::by_weights(p.z, e_1 / triangle_.twice_area, q.z, e_2 / triangle_.twice_area, r.z);
}

inline void Foreteller::evaluate(SampleTest& event) {
  const std::span<const formulas::SampleOffset> offsets = facts_->samples();
  const bool known = event.sample >= 0 && event.sample < std::ssize(offsets);
  const formulas::SampleOffset offset =
      known ? offsets[static_cast<std::size_t>(event.sample)] : formulas::SampleOffset{};
  const std::array<double, 3> e = edge_values_beside(event.x, event.y, offset.dx(), offset.dy());
  event.s_0 = e[0], event.s_1 = e[1], event.s_2 = e[2];
  event.inside = is_within(e);
}
template <>
inline void Foreteller::note(const SampleTest& event) {
  triangle_.sample = event;
}

inline void Foreteller::evaluate(SampleDepth& event) {
  event.z = depth_by_edges(triangle_.sample.s_1, triangle_.sample.s_2);
  event.nearer = whole_[slot_of("nearer")] != 0;
}

inline void Foreteller::evaluate(SampleMask& event) {
  std::uint32_t samples = 0;
  for (std::int32_t bit = 0; bit < formulas::mask_rows * formulas::mask_columns; ++bit) {
    const formulas::SampleOffset offset = formulas::mask_offset(bit);
    if (is_within(edge_values_beside(event.x, event.y, offset.dx(), offset.dy()))) samples |= std::uint32_t{1} << bit;
  }
  event.row_0 = formulas::row_of(samples, 0), event.row_1 = formulas::row_of(samples, 1);
  event.row_2 = formulas::row_of(samples, 2), event.row_3 = formulas::row_of(samples, 3);
  const auto [dx, dy] = formulas::middle_of(samples);
  const std::array<double, 3> e = edge_values_beside(event.x, event.y, dx, dy);
  event.z = depth_by_edges(e[1], e[2]);
}

}  // namespace zstep::codec
