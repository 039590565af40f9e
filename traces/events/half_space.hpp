// Triangles by half-planes: edge functions, the tests of tiles and of pixels, barycentric weights.
// Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

enum class TileCover : std::uint8_t { outside, inside, partly };

template <>
inline constexpr std::array<std::string_view, 3> words_of<TileCover>{"outside", "inside", "partly"};

// clang-format off

struct TriangleSetup {
  std::int32_t vertex_0, vertex_1, vertex_2; double twice_area;
  std::int32_t first_column, first_row, end_column, end_row;
};
struct EdgeFunction {
  std::int32_t edge_function, vertex_0, vertex_1; double edge_a, edge_b, edge_c; bool owns;
};
struct TileTest { std::int32_t first_column, first_row, end_column, end_row; TileCover cover; };
struct TileDepthTest {
  std::int32_t first_column, first_row, end_column, end_row; double z_nearest, z_farthest; bool nearer;
};
struct InsideTest { std::int32_t x, y; double e_0, e_1, e_2; bool inside; };
struct BarycentricWeights { std::int32_t x, y; double w_0, w_1, w_2; };
struct SampleTest { std::int32_t x, y, sample; double s_0, s_1, s_2; bool inside; };
struct SampleDepth { std::int32_t x, y, sample; double z; bool nearer; };
struct SampleMask { std::int32_t x, y, row_0, row_1, row_2, row_3; double z; };

// clang-format on

template <>
inline constexpr Description description_of<TriangleSetup>{
    .name = "triangle_setup",
    .meaning = "a triangle of the polygon: its area, and its bounding box within the raster",
    .work = WorkKind::planes,
    .called = "triangle of the vertices {vertex_0}, {vertex_1}, {vertex_2}",
    .within = Within::polygon,
    .begins = {Unit::scan_line, "triangle"}};
template <>
inline constexpr auto fields_of<TriangleSetup> = Fields{
    Field{"vertex_0", &TriangleSetup::vertex_0, Measure::vertex, "vertex 0; the order is that of a positive area",
          As::subject, Guess::told},
    Field{"vertex_1", &TriangleSetup::vertex_1, Measure::vertex, "vertex 1", As::subject, Guess::told},
    Field{"vertex_2", &TriangleSetup::vertex_2, Measure::vertex, "vertex 2", As::subject, Guess::told},
    Field{"twice_area", &TriangleSetup::twice_area, "px^2",
          "twice its area on the raster, (x_1 - x_0)(y_2 - y_0) - (x_2 - x_0)(y_1 - y_0)", As::formula, Guess::formula},
    Field{"first_column", &TriangleSetup::first_column, Measure::column_or_end, "the first column of its bounding box",
          As::formula, Guess::formula},
    Field{"first_row", &TriangleSetup::first_row, Measure::row_or_end, "the first row of it", As::formula,
          Guess::formula},
    Field{"end_column", &TriangleSetup::end_column, Measure::column_or_end, "the column just beyond it", As::formula,
          Guess::formula},
    Field{"end_row", &TriangleSetup::end_row, Measure::row_or_end, "the row just beyond it", As::formula,
          Guess::formula}};

template <>
inline constexpr Description description_of<EdgeFunction>{
    .name = "edge_function",
    .meaning = "an edge as E(x, y) = A x + B y + C, positive on the triangle's side",
    .work = WorkKind::edges,
    .called = "edge function E_{edge_function} of the edge from {vertex_0} to {vertex_1}",
    .within = Within::polygon | Within::triangle};
template <>
inline constexpr auto fields_of<EdgeFunction> =
    Fields{Field{"edge_function", &EdgeFunction::edge_function, "index",
                 "which of the three, 0 to 2: the edge opposite the vertex of that number", As::aside, Guess::next},
           Field{"vertex_0", &EdgeFunction::vertex_0, Measure::vertex, "the vertex it comes from",
                 As::formula | As::subject, Guess::formula},
           Field{"vertex_1", &EdgeFunction::vertex_1, Measure::vertex, "the vertex it goes to",
                 As::formula | As::subject, Guess::formula},
           Field{"edge_a", &EdgeFunction::edge_a, "px", "A = y_0 - y_1: what E gains from pixel to pixel", As::formula,
                 Guess::formula},
           Field{"edge_b", &EdgeFunction::edge_b, "px", "B = x_1 - x_0: what E gains from scan line to scan line",
                 As::formula, Guess::formula},
           Field{"edge_c", &EdgeFunction::edge_c, "px^2",
                 "C = -(A X + B Y), (X, Y) being the end with the smaller y, of equal ones the smaller x", As::formula,
                 Guess::formula},
           Field{"owns", &EdgeFunction::owns, "1",
                 "a centre on the line belongs to the triangle: a left edge, A > 0, or a top one, A = 0 and B > 0",
                 As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<TileTest>{
    .name = "tile_test",
    .meaning =
        "a tile of pixels is held against the three edges, by the corner farthest inside and the one farthest "
        "outside of each",
    .work = WorkKind::tests,
    .called = "tile at ({first_column}, {first_row})",
    .within = Within::polygon | Within::triangle};
template <>
inline constexpr auto fields_of<TileTest> = Fields{
    Field{"first_column", &TileTest::first_column, Measure::column_or_end,
          "the first column of what the tile has of the bounding box", As::subject, Guess::told},
    Field{"first_row", &TileTest::first_row, Measure::row_or_end, "the first row of that", As::subject, Guess::told},
    Field{"end_column", &TileTest::end_column, Measure::column_or_end, "the column just beyond it", As::formula,
          Guess::formula},
    Field{"end_row", &TileTest::end_row, Measure::row_or_end, "the row just beyond it", As::formula, Guess::formula},
    Field{"cover", &TileTest::cover, "1",
          "outside: beyond one edge, and rejected; inside: within all, and accepted; partly: its pixels are tested",
          As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<TileDepthTest>{
    .name = "tile_depth_test",
    .meaning = "the nearest depth that the triangle has in a tile is held against the farthest that is stored in it",
    .work = WorkKind::tests,
    .called = "depths of the tile at ({first_column}, {first_row})",
    .within = Within::polygon | Within::triangle};
template <>
inline constexpr auto fields_of<TileDepthTest> = Fields{
    Field{"first_column", &TileDepthTest::first_column, Measure::column_or_end,
          "the first column of what the tile has of the bounding box", As::subject},
    Field{"first_row", &TileDepthTest::first_row, Measure::row_or_end, "the first row of that", As::subject},
    Field{"end_column", &TileDepthTest::end_column, Measure::column_or_end, "the column just beyond it", As::formula},
    Field{"end_row", &TileDepthTest::end_row, Measure::row_or_end, "the row just beyond it", As::formula},
    Field{"z_nearest", &TileDepthTest::z_nearest, "depth",
          "the nearest depth of the triangle's plane at its corners, and not nearer than the triangle's vertices",
          As::formula},
    Field{"z_farthest", &TileDepthTest::z_farthest, "depth", "the farthest depth stored in the whole tile",
          As::formula},
    Field{"nearer", &TileDepthTest::nearer, "1", "it may be seen; else the tile is rejected", As::formula}};

template <>
inline constexpr Description description_of<InsideTest>{.name = "inside_test",
                                                        .meaning = "a pixel's centre is held against the three edges",
                                                        .work = WorkKind::tests,
                                                        .called = "inside test of pixel ({x}, {y})",
                                                        .within = Within::polygon | Within::triangle};
template <>
inline constexpr auto fields_of<InsideTest> =
    Fields{Field{"x", &InsideTest::x, Measure::column, "column", As::subject, Guess::told},
           Field{"y", &InsideTest::y, Measure::pixel_row, "row", As::subject, Guess::told},
           Field{"e_0", &InsideTest::e_0, "px^2", "E_0 at the centre", As::formula, Guess::formula},
           Field{"e_1", &InsideTest::e_1, "px^2", "E_1", As::formula, Guess::formula},
           Field{"e_2", &InsideTest::e_2, "px^2", "E_2", As::formula, Guess::formula},
           Field{"inside", &InsideTest::inside, "1", "each is positive, or 0 on an edge that owns its line",
                 As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<BarycentricWeights>{
    .name = "barycentric_weights",
    .meaning = "how much of each vertex a pixel inside has: w_i = E_i / twice the area",
    .work = WorkKind::depths,
    .called = "weights at pixel ({x}, {y})",
    .within = Within::polygon | Within::triangle};
template <>
inline constexpr auto fields_of<BarycentricWeights> =
    Fields{Field{"x", &BarycentricWeights::x, Measure::column, "column", As::subject, Guess::told},
           Field{"y", &BarycentricWeights::y, Measure::pixel_row, "row", As::subject, Guess::told},
           Field{"w_0", &BarycentricWeights::w_0, "1", "the weight of vertex 0", As::formula, Guess::formula},
           Field{"w_1", &BarycentricWeights::w_1, "1", "of vertex 1", As::formula, Guess::formula},
           Field{"w_2", &BarycentricWeights::w_2, "1", "of vertex 2", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<SampleTest>{
    .name = "sample_test",
    .meaning = "one of a pixel's samples is held against the three edges",
    .work = WorkKind::tests,
    .called = "inside test of sample {sample} of pixel ({x}, {y})",
    .within = Within::polygon | Within::triangle};
template <>
inline constexpr auto fields_of<SampleTest> =
    Fields{Field{"x", &SampleTest::x, Measure::column, "column", As::subject, Guess::told},
           Field{"y", &SampleTest::y, Measure::pixel_row, "row", As::subject, Guess::told},
           Field{"sample", &SampleTest::sample, "index", "which of the pixel's samples, from 0",
                 As::formula | As::subject, Guess::told},
           Field{"s_0", &SampleTest::s_0, "px^2", "E_0 at the sample: that at the centre, and A_0 dx + B_0 dy",
                 As::formula, Guess::formula},
           Field{"s_1", &SampleTest::s_1, "px^2", "E_1 there", As::formula, Guess::formula},
           Field{"s_2", &SampleTest::s_2, "px^2", "E_2 there", As::formula, Guess::formula},
           Field{"inside", &SampleTest::inside, "1", "each is positive, or 0 on an edge that owns its line",
                 As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<SampleDepth>{
    .name = "sample_depth",
    .meaning = "the depth at a sample is held against the sample's own; a nearer one is kept, and with it the polygon",
    .work = WorkKind::compares,
    .called = "compare at sample {sample} of pixel ({x}, {y})",
    .within = Within::polygon | Within::triangle};
template <>
inline constexpr auto fields_of<SampleDepth> = Fields{
    Field{"x", &SampleDepth::x, Measure::column, "column", As::subject, Guess::same},
    Field{"y", &SampleDepth::y, Measure::pixel_row, "row", As::subject, Guess::same},
    Field{"sample", &SampleDepth::sample, "index", "which of the pixel's samples, from 0", As::subject, Guess::same},
    Field{"z", &SampleDepth::z, "depth", "depth of the polygon at the sample", As::formula, Guess::formula},
    Field{"nearer", &SampleDepth::nearer, "1", "the polygon's depth is nearer, so it is kept", As::formula,
          Guess::formula}};

template <>
inline constexpr Description description_of<SampleMask>{
    .name = "sample_mask",
    .meaning = "which of a pixel's 32 samples lie in the triangle: a row of the pixel's list, with its depth",
    .work = WorkKind::writes,
    .called = "mask of pixel ({x}, {y})",
    .within = Within::polygon | Within::triangle};
template <>
inline constexpr auto fields_of<SampleMask> =
    Fields{Field{"x", &SampleMask::x, Measure::column, "column", As::subject, Guess::same},
           Field{"y", &SampleMask::y, Measure::pixel_row, "row", As::subject, Guess::same},
           Field{"row_0", &SampleMask::row_0, "bits",
                 "the eight samples of the first row, the first one in the lowest bit", As::formula, Guess::formula},
           Field{"row_1", &SampleMask::row_1, "bits", "of the second row", As::formula, Guess::formula},
           Field{"row_2", &SampleMask::row_2, "bits", "of the third", As::formula, Guess::formula},
           Field{"row_3", &SampleMask::row_3, "bits", "of the last", As::formula, Guess::formula},
           Field{"z", &SampleMask::z, "depth", "depth of the polygon in the middle of these samples", As::formula,
                 Guess::formula}};

}  // namespace zstep
