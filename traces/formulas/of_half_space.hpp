// What a triangle's edge functions, the tests of its tiles and pixels, its weights and its samples follow from
// (half_space.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/half_space.hpp"
#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/samples.hpp"

namespace zstep::formulas {

namespace detail {

/// A coordinate as the run has it: in float32 it was rounded to one.
inline double as_computed(const Situation& at, double coordinate) {
  const bool narrow = at.header.conventions.number_format == NumberFormat::float32;
  return narrow ? static_cast<double>(static_cast<float>(coordinate)) : coordinate;
}

/// Of what a tile has in common with the bounding box, the end; where the run says that tiles are of this size.
template <class E, class Out>
void derive_tile_end(const E& e, const Situation& at, Out& out) {
  const auto& setup = at.method().triangle.setup;
  if (!setup || !(has_option(at, "tiles", "8") || has_option(at, "hierarchical-z", "on"))) return;
  out.is(&E::end_column, std::min(setup->end_column, tile_start(e.first_column) + tile_side));
  out.is(&E::end_row, std::min(setup->end_row, tile_start(e.first_row) + tile_side));
}

/// How a tile lies to the three edges. `wanted`: of what rounding leaves open, this one is taken.
inline std::optional<TileCover> cover_of(const TileTest& e, const Situation& at, TileCover wanted) {
  bool outside = false, may_be_outside = false, inside = true, may_be_inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const EdgeFunction& edge = at.method().triangle.edges[i];
    Plainly plainly;
    const auto value = [&](bool farthest_inside) {
      const std::int32_t x = (edge.edge_a > 0) == farthest_inside ? e.end_column - 1 : e.first_column,
                         y = (edge.edge_b > 0) == farthest_inside ? e.end_row - 1 : e.first_row;
      return edge_value_at(plainly, at, i, x, y);
    };
    const auto greatest = value(true), least = value(false);
    if (!greatest || !least) return std::nullopt;
    const double rounding = rounding_of(at.header);
    const auto open = [&](const Rounded& number) { return std::abs(number.value) <= rounding * number.spread; };
    outside = outside || (!is_on_side(greatest->value, edge.owns) && !open(*greatest));
    may_be_outside = may_be_outside || !is_on_side(greatest->value, edge.owns) || open(*greatest);
    inside = inside && is_on_side(least->value, edge.owns) && !open(*least);
    may_be_inside = may_be_inside && (is_on_side(least->value, edge.owns) || open(*least));
  }
  const bool possible = wanted == TileCover::outside  ? may_be_outside
                        : wanted == TileCover::inside ? may_be_inside && !outside
                                                      : !outside && !inside;
  if (possible) return wanted;
  return outside ? TileCover::outside : inside ? TileCover::inside : TileCover::partly;
}

inline bool greatest_is_nearest(const Situation& at) {
  const bool greater = at.header.comparison.nearer == Comparison::Nearer::greater;
  // Of a corrected depth the reciprocal is interpolated.
  return greater != (at.header.conventions.depth == Conventions::Depth::corrected);
}

/// What is interpolated to depths at a corner of a tile, by the edge functions there.
template <class Out>
auto depth_at_corner(Out& out, const Situation& at, std::int32_t x, std::int32_t y)
    -> std::optional<typename Out::Number> {
  const auto& triangle = at.method().triangle;
  const auto z = depths_of_triangle(out, at);
  const auto e_1 = edge_value_at(out, at, 1, x, y), e_2 = edge_value_at(out, at, 2, x, y);
  if (!z || !e_1 || !e_2) return std::nullopt;
  const auto area = out.number("area2", triangle.setup->twice_area, triangle_place(setup_place, "twice_area"));
  return by_weights((*z)[0], *e_1 / area, (*z)[1], *e_2 / area, (*z)[2]);
}

template <class Out>
void derive_nearest_in_tile(const TileDepthTest& e, const Situation& at, Out& out) {
  if (!has_edges(at)) return;
  Plainly plainly;
  const bool greatest = greatest_is_nearest(at);
  const auto nearer = [&](double one, double other) { return greatest ? one > other : one < other; };
  const auto vertices = depths_of_triangle(plainly, at);
  if (!vertices) return;
  std::size_t vertex = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (nearer((*vertices)[i].value, (*vertices)[vertex].value)) vertex = i;
  std::optional<double> best;
  std::int32_t best_x = 0, best_y = 0;
  for (const std::int32_t y : {e.first_row, e.end_row - 1})
    for (const std::int32_t x : {e.first_column, e.end_column - 1}) {
      const auto z = depth_at_corner(plainly, at, x, y);
      if (!z) return;
      if (!best || nearer(z->value, *best)) best = z->value, best_x = x, best_y = y;
    }
  if (nearer(*best, (*vertices)[vertex].value)) {
    const auto all = depths_of_triangle(out, at);
    return out.gives(&TileDepthTest::z_nearest, interpolated(at, (*all)[vertex]));
  }
  out.gives(&TileDepthTest::z_nearest, interpolated(at, *depth_at_corner(out, at, best_x, best_y)));
}

/// The pixel of the whole tile with the farthest depth.
template <class Out>
void derive_farthest_in_tile(const TileDepthTest& e, const Situation& at, Out& out) {
  const Raster& raster = at.scene.raster;
  const std::int32_t left = tile_start(e.first_column), top = tile_start(e.first_row);
  if (left >= raster.width || top >= raster.height) return;
  std::int32_t column = left, row = top;
  for (std::int32_t y = top; y < std::min(raster.height, top + tile_side); ++y)
    for (std::int32_t x = left; x < std::min(raster.width, left + tile_side); ++x)
      if (at.header.comparison.behind(at.stored(x, y), at.stored(column, row)) > 0) column = x, row = y;
  out.gives(&TileDepthTest::z_farthest,
            out.number("zbuffer[x,y]", at.stored(column, row), at.depth_place(column, row)["z"]));
}

}  // namespace detail

template <class Out>
void derive(const TriangleSetup& e, const Situation& at, Out& out) {
  detail::derive_last_win(at, out);
  const std::array<std::int32_t, 3> vertices{e.vertex_0, e.vertex_1, e.vertex_2};
  for (const std::int32_t vertex : vertices)
    if (!at.on_raster(vertex)) return;
  const auto coordinate = [&](std::size_t i, bool of_x) {
    const Place place{Place::In::vertex, vertices[i]};
    const auto point = *at.on_raster(vertices[i]);
    return of_x ? out.number(detail::numbered("x_0 x_1 x_2", i), point.x, place["x_s"])
                : out.number(detail::numbered("y_0 y_1 y_2", i), point.y, place["y_s"]);
  };
  out.gives(&TriangleSetup::twice_area, twice_area(coordinate(0, true), coordinate(0, false), coordinate(1, true),
                                                   coordinate(1, false), coordinate(2, true), coordinate(2, false)));
  const auto side = [&](bool of_x) {
    std::size_t least = 0, greatest = 0;
    const auto value = [&](std::size_t i) {
      const auto point = *at.on_raster(vertices[i]);
      return detail::as_computed(at, of_x ? point.x : point.y);
    };
    for (std::size_t i = 1; i < 3; ++i) {
      if (value(i) < value(least)) least = i;
      if (value(i) > value(greatest)) greatest = i;
    }
    struct Side {
      typename Out::Number first, end;
      std::int32_t first_pixel, end_pixel;
    };
    using std::ceil, std::floor;
    const std::int32_t size = of_x ? at.scene.raster.width : at.scene.raster.height;
    // Where samples are looked at beside the centre, the box has all pixels that have some of its area.
    const double reach = reach_of(at.header.conventions);
    const auto from = coordinate(least, of_x), to = coordinate(greatest, of_x);
    using T = typename Out::Number;
    return Side{ceil(reach > 0 ? from - T(reach) : from), floor(reach > 0 ? to + T(reach) : to) + T(1.0),
                box_first(value(least) - reach, size), box_end(value(greatest) + reach, size)};
  };
  const auto columns = side(true), rows = side(false);
  out.whole(&TriangleSetup::first_column, columns.first, columns.first_pixel);
  out.whole(&TriangleSetup::first_row, rows.first, rows.first_pixel);
  out.whole(&TriangleSetup::end_column, columns.end, columns.end_pixel);
  out.whole(&TriangleSetup::end_row, rows.end, rows.end_pixel);
}

template <class Out>
void derive(const EdgeFunction& e, const Situation& at, Out& out) {
  if (const auto& setup = at.method().triangle.setup; setup && e.edge_function >= 0 && e.edge_function < 3) {
    const std::array<std::int32_t, 3> vertices{setup->vertex_0, setup->vertex_1, setup->vertex_2};
    const auto number = static_cast<std::size_t>(e.edge_function);
    out.is(&EdgeFunction::vertex_0, vertices[(number + 1) % 3]);
    out.is(&EdgeFunction::vertex_1, vertices[(number + 2) % 3]);
  }
  const Place event{};
  const auto from = at.on_raster(e.vertex_0), to = at.on_raster(e.vertex_1);
  // A line that is horizontal but for rounding may be taken for either.
  const bool open = e.edge_a != 0 && out.equal(e.edge_a, 0.0);
  if (!open) out.is(&EdgeFunction::owns, owns_line(e.edge_a, e.edge_b));
  if (!from || !to) return;
  const Place start{Place::In::vertex, e.vertex_0}, finish{Place::In::vertex, e.vertex_1};
  const auto x_0 = out.number("x_0", from->x, start["x_s"]), y_0 = out.number("y_0", from->y, start["y_s"]),
             x_1 = out.number("x_1", to->x, finish["x_s"]), y_1 = out.number("y_1", to->y, finish["y_s"]);
  out.gives(&EdgeFunction::edge_a, y_0 - y_1);
  out.gives(&EdgeFunction::edge_b, x_1 - x_0);
  const bool first = is_first_end(from->x, from->y, to->x, to->y);
  out.gives(&EdgeFunction::edge_c,
            edge_constant(out.number("A", e.edge_a, event["edge_a"]), out.number("B", e.edge_b, event["edge_b"]),
                          first ? x_0 : x_1, first ? y_0 : y_1));
}

template <class Out>
void derive(const TileTest& e, const Situation& at, Out& out) {
  detail::derive_last_win(at, out);
  detail::derive_tile_end(e, at, out);
  if (!detail::has_edges(at)) return;
  for (std::int64_t i = 0; i < 3; ++i) out.reads(detail::triangle_place(i));
  if (const auto cover = detail::cover_of(e, at, e.cover)) out.is(&TileTest::cover, *cover);
}

template <class Out>
void derive(const TileDepthTest& e, const Situation& at, Out& out) {
  detail::derive_last_win(at, out);
  detail::derive_tile_end(e, at, out);
  detail::derive_nearest_in_tile(e, at, out);
  detail::derive_farthest_in_tile(e, at, out);
  const Place event{};
  const auto nearest = out.number("z_nearest", e.z_nearest, event["z_nearest"]);
  out.verdict(&TileDepthTest::nearer, nearest, out.number("z_farthest", e.z_farthest, event["z_farthest"]));
}

template <class Out>
void derive(const InsideTest& e, const Situation& at, Out& out) {
  detail::derive_last_win(at, out);
  if (const auto& last = at.method().triangle.sample)
    out.rule(Rule::sample_is_tested, last->sample + std::int64_t{1} >= at.method().samples_a_pixel);
  if (!detail::has_edges(at)) return;
  const std::array<double InsideTest::*, 3> values{&InsideTest::e_0, &InsideTest::e_1, &InsideTest::e_2};
  bool inside = true, open = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = e.*values[i];
    inside = inside && is_on_side(value, at.method().triangle.edges[i].owns);
    open = open || (value != 0 && out.equal(value, 0.0));
    out.reads(detail::triangle_place(static_cast<std::int64_t>(i)));
  }
  if (const auto value = detail::edge_value_at(out, at, 0, e.x, e.y)) out.gives(&InsideTest::e_0, *value);
  if (const auto value = detail::edge_value_at(out, at, 1, e.x, e.y)) out.gives(&InsideTest::e_1, *value);
  if (const auto value = detail::edge_value_at(out, at, 2, e.x, e.y)) out.gives(&InsideTest::e_2, *value);
  if (!open) out.is(&InsideTest::inside, inside);
}

/// Of a pixel in a tile that was accepted, the edge functions are computed here.
template <class Out>
void derive(const BarycentricWeights& e, const Situation& at, Out& out) {
  const auto& triangle = at.method().triangle;
  const InsideTest* test =
      triangle.test && triangle.test->x == e.x && triangle.test->y == e.y ? &*triangle.test : nullptr;
  if (test) out.reads(detail::triangle_place(detail::test_place));
  // In a run that tests pixels, and no tile around this one was accepted, it has been found inside.
  const bool accepted = triangle.tile && triangle.tile->cover == TileCover::inside;
  const auto& options = at.header.conventions.options;
  const auto tiles = options.find("tiles");
  const bool tells_tiles = at.records<TileTest>() || tiles == options.end() || tiles->second == "off";
  if (at.records<InsideTest>() && tells_tiles && !accepted) out.rule(Rule::weights_inside, test && test->inside);
  if (!triangle.setup || !detail::has_edges(at)) return;
  const auto area =
      out.number("area2", triangle.setup->twice_area, detail::triangle_place(detail::setup_place, "twice_area"));
  const auto give = [&](std::size_t i, Follows<BarycentricWeights, double> weight, double tested,
                        std::string_view field) {
    if (test)
      return out.gives(weight, out.number(detail::numbered("E_0 E_1 E_2", i), tested,
                                          detail::triangle_place(detail::test_place, field)) /
                                   area);
    if (const auto value = detail::edge_value_at(out, at, i, e.x, e.y)) out.gives(weight, *value / area);
  };
  give(0, &BarycentricWeights::w_0, test ? test->e_0 : 0, "e_0");
  give(1, &BarycentricWeights::w_1, test ? test->e_1 : 0, "e_1");
  give(2, &BarycentricWeights::w_2, test ? test->e_2 : 0, "e_2");
}

namespace detail {

/// E_i at the centre of the pixel at work: as it was tested, or computed here where the run does not test centres.
template <class Out>
auto edge_value_at_centre(Out& out, const Situation& at, std::size_t i, std::int32_t x, std::int32_t y)
    -> std::optional<typename Out::Number> {
  const auto& test = at.method().triangle.test;
  if (!test || test->x != x || test->y != y) return edge_value_at(out, at, i, x, y);
  const double tested = i == 0 ? test->e_0 : i == 1 ? test->e_1 : test->e_2;
  return out.number(numbered("E_0 E_1 E_2", i), tested, triangle_place(test_place, numbered("e_0 e_1 e_2", i)));
}
/// E_i beside the centre.
template <class Out>
auto edge_value_beside_centre(Out& out, const Situation& at, std::size_t i, std::int32_t x, std::int32_t y, double dx,
                              double dy) -> std::optional<typename Out::Number> {
  const auto centre = edge_value_at_centre(out, at, i, x, y);
  if (!centre) return std::nullopt;
  const EdgeFunction& edge = at.method().triangle.edges[i];
  const auto index = static_cast<std::int64_t>(i);
  return edge_value_beside(*centre,
                           out.number(numbered("A_0 A_1 A_2", i), edge.edge_a, triangle_place(index, "edge_a")),
                           out.number("dx", dx, Place{}),
                           out.number(numbered("B_0 B_1 B_2", i), edge.edge_b, triangle_place(index, "edge_b")),
                           out.number("dy", dy, Place{}));
}

/// What is interpolated to depths, by the values of two edge functions.
template <class Out>
auto depth_by_edges(Out& out, const Situation& at, const typename Out::Number& e_1, const typename Out::Number& e_2)
    -> std::optional<typename Out::Number> {
  const auto z = depths_of_triangle(out, at);
  if (!z) return std::nullopt;
  const auto area =
      out.number("area2", at.method().triangle.setup->twice_area, triangle_place(setup_place, "twice_area"));
  return interpolated(at, by_weights((*z)[0], e_1 / area, (*z)[1], e_2 / area, (*z)[2]));
}

/// Which of the 32 samples are inside. What rounding leaves open is taken as `told` has it.
inline std::optional<std::uint32_t> mask_of(const Situation& at, std::int32_t x, std::int32_t y, std::uint32_t told) {
  Plainly plainly;
  std::uint32_t samples = 0;
  for (std::int32_t bit = 0; bit < mask_rows * mask_columns; ++bit) {
    const SampleOffset offset = mask_offset(bit);
    bool inside = true, open = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = edge_value_beside_centre(plainly, at, i, x, y, offset.dx(), offset.dy());
      if (!e) return std::nullopt;
      inside = inside && is_on_side(e->value, at.method().triangle.edges[i].owns);
      open = open || std::abs(e->value) <= rounding_of(at.header) * e->spread;
    }
    const std::uint32_t here = std::uint32_t{1} << bit;
    if (open ? (told & here) != 0 : inside) samples |= here;
  }
  return samples;
}

/// What share of a pixel each polygon has by its samples, where the run takes such.
inline std::vector<PixelShare> shares_at(const Situation& at, std::int32_t x, std::int32_t y) {
  const MethodState& method = at.method();
  if (method.samples_a_pixel > 0)
    return shares_of_samples(static_cast<std::size_t>(method.samples_a_pixel),
                             [&](std::size_t i) { return method.sample(x, y, static_cast<std::int32_t>(i)).polygon; });
  const std::size_t pixel = method.pixel(x, y);
  return shares_of_masks(pixel < method.masks.size() ? method.masks[pixel] : std::vector<PixelMask>{},
                         [&](double z, double other) { return at.header.comparison.wins(z, other); });
}

}  // namespace detail

/// The samples of a pixel have their turn one by one.
template <class Out>
void derive(const SampleTest& e, const Situation& at, Out& out) {
  detail::derive_last_win(at, out);
  const std::span<const SampleOffset> offsets = samples_of(at.header.conventions);
  const auto& last = at.method().triangle.sample;
  const bool follows = last && last->x == e.x && last->y == e.y;
  if (!offsets.empty()) out.is(&SampleTest::sample, follows ? last->sample + 1 : 0);
  const std::size_t number = e.sample;
  if (number >= offsets.size() || !detail::has_edges(at)) return;
  const std::array<double SampleTest::*, 3> values{&SampleTest::s_0, &SampleTest::s_1, &SampleTest::s_2};
  bool inside = true, open = false;
  for (std::size_t i = 0; i < 3; ++i) {
    inside = inside && is_on_side(e.*values[i], at.method().triangle.edges[i].owns);
    open = open || (e.*values[i] != 0 && out.equal(e.*values[i], 0.0));
  }
  const double dx = offsets[number].dx(), dy = offsets[number].dy();
  if (const auto value = detail::edge_value_beside_centre(out, at, 0, e.x, e.y, dx, dy))
    out.gives(&SampleTest::s_0, *value);
  if (const auto value = detail::edge_value_beside_centre(out, at, 1, e.x, e.y, dx, dy))
    out.gives(&SampleTest::s_1, *value);
  if (const auto value = detail::edge_value_beside_centre(out, at, 2, e.x, e.y, dx, dy))
    out.gives(&SampleTest::s_2, *value);
  if (!open) out.is(&SampleTest::inside, inside);
}

template <class Out>
void derive(const SampleDepth& e, const Situation& at, Out& out) {
  const auto& test = at.method().triangle.sample;
  const bool tested = test && test->x == e.x && test->y == e.y && test->sample == e.sample;
  if (at.records<SampleTest>()) out.rule(Rule::sample_inside, tested && test->inside);
  if (tested && detail::has_edges(at) && at.method().triangle.setup) {
    const auto value = [&](std::size_t i, double recorded, std::string_view field) {
      return out.number(detail::numbered("S_0 S_1 S_2", i), recorded,
                        detail::triangle_place(detail::sample_place, field));
    };
    if (const auto z = detail::depth_by_edges(out, at, value(1, test->s_1, "s_1"), value(2, test->s_2, "s_2")))
      out.gives(&SampleDepth::z, *z);
  }
  if (at.method().samples_a_pixel == 0 || !at.method().polygons_told) return;
  out.verdict(&SampleDepth::nearer, out.number("z", e.z, Place{}),
              out.number("stored", at.stored_at_sample(e.x, e.y, e.sample), at.sample_place(e.x, e.y, e.sample)["z"]));
}

template <class Out>
void derive(const SampleMask& e, const Situation& at, Out& out) {
  detail::derive_last_win(at, out);
  if (!detail::has_edges(at) || !keeps_masks(at.header.conventions)) return;
  const std::uint32_t told = samples_of(e);
  const auto samples = detail::mask_of(at, e.x, e.y, told);
  if (!samples) return;
  for (std::int64_t i = 0; i < 3; ++i) out.reads(detail::triangle_place(i));
  out.is(&SampleMask::row_0, row_of(*samples, 0)), out.is(&SampleMask::row_1, row_of(*samples, 1));
  out.is(&SampleMask::row_2, row_of(*samples, 2)), out.is(&SampleMask::row_3, row_of(*samples, 3));
  const auto [dx, dy] = middle_of(told);
  const auto e_1 = detail::edge_value_beside_centre(out, at, 1, e.x, e.y, dx, dy),
             e_2 = detail::edge_value_beside_centre(out, at, 2, e.x, e.y, dx, dy);
  if (!e_1 || !e_2 || !at.method().triangle.setup) return;
  if (const auto z = detail::depth_by_edges(out, at, *e_1, *e_2)) out.gives(&SampleMask::z, *z);
}

/// By samples the share is known; of areas only that they are no more than the pixel.
template <class Out>
void derive(const CoverageAdd& e, const Situation& at, Out& out) {
  const auto& covered = at.method().sweep.covered;
  double all = e.coverage;
  for (const CoverageAdd& share : covered)
    if (share.x == e.x && share.y == e.y) all += share.coverage;
  out.rule(Rule::share_of_pixel, e.coverage >= 0 && all <= 1 + rounding_of_float32);
  if (reach_of(at.header.conventions) == 0 || !at.method().polygons_told) return;
  if (!at.records<SampleDepth>() && !at.records<SampleMask>()) return;
  double right = 0;
  for (const PixelShare& share : detail::shares_at(at, e.x, e.y))
    if (share.polygon == e.owner) right = share.share;
  out.is(&CoverageAdd::coverage, right);
}

}  // namespace zstep::formulas
