// Planes, pieces of polygons, and the tests between them: what the methods that order or cut polygons share.
//
// A piece is a facet, or what cutting left of one. Pieces are numbered from 0 in the order in which they are made, for
// the whole run. Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

enum class Side : std::uint8_t { front, behind, on, crossing };
enum class Axis : std::uint8_t { x, y, z };
enum class Space : std::uint8_t { world, raster };
enum class Coherence : std::uint8_t { object, face, edge, implied_edge, scan_line, area, depth, frame, extent, order };

template <>
inline constexpr std::array<std::string_view, 4> words_of<Side>{"front", "behind", "on", "crossing"};
template <>
inline constexpr std::array<std::string_view, 3> words_of<Axis>{"x", "y", "z"};
template <>
inline constexpr std::array<std::string_view, 2> words_of<Space>{"world", "raster"};
template <>
inline constexpr std::array<std::string_view, 10> words_of<Coherence>{
    "object", "face", "edge", "implied_edge", "scan_line", "area", "depth", "frame", "extent", "order"};

// clang-format off

struct TablesBegin { std::int32_t polygons; };
struct PieceMake { std::int32_t piece, polygon, parent; };
struct PlaneEquation { std::int32_t piece; double plane_a, plane_b, plane_c, plane_d; };
struct Extent { std::int32_t piece; double x_min, x_max, y_min, y_max, z_min, z_max; };
struct PlaneDepth { std::int32_t piece; double x_at, y_at, z; };
struct VertexSide { std::int32_t vertex, plane_of; double value; Side side; };
struct SideTest { std::int32_t piece, plane_of; double least, greatest; Side side; };
struct ExtentTest { std::int32_t piece, other; Axis axis; double low, high, other_low, other_high; bool overlap; };
struct OverlapTest { std::int32_t piece, other; bool overlap; double x_at, y_at; };
struct SplitVertex {
  std::int32_t vertex_0, vertex_1; double t; std::int32_t vertex; Space space; double x_cut, y_cut, z_cut;
};
struct PieceDraw { std::int32_t piece, polygon; };
struct Saved { Coherence coherence; std::int32_t tests; };

// clang-format on

template <>
inline constexpr Description description_of<TablesBegin>{
    .name = "tables_begin",
    .meaning = "edges, vertices and pieces of all polygons are kept from here on, until the run ends",
    .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<TablesBegin> =
    Fields{Field{"polygons", &TablesBegin::polygons, "1", "how many polygons the scene has", As::formula}};

template <>
inline constexpr Description description_of<PieceMake>{
    .name = "piece_make", .meaning = "the outline so far becomes a piece", .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<PieceMake> = Fields{
    Field{"piece", &PieceMake::piece, Measure::piece, "the piece, numbered in the order in which pieces are made",
          As::made, Guess::next},
    Field{"polygon", &PieceMake::polygon, Measure::polygon, "the polygon it is a piece of", As::formula | As::subject},
    Field{"parent", &PieceMake::parent, Measure::piece, "the piece it was cut from, -1 if it is whole", As::subject}};

template <>
inline constexpr Description description_of<PlaneEquation>{.name = "plane_equation",
                                                           .meaning = "the plane of a piece: A x + B y + C z + D = 0",
                                                           .work = WorkKind::planes,
                                                           .called = "plane of {piece}"};
template <>
inline constexpr auto fields_of<PlaneEquation> =
    Fields{Field{"piece", &PlaneEquation::piece, Measure::piece, "the piece", As::subject},
           Field{"plane_a", &PlaneEquation::plane_a, "1", "A", As::formula, Guess::formula},
           Field{"plane_b", &PlaneEquation::plane_b, "1", "B", As::formula, Guess::formula},
           Field{"plane_c", &PlaneEquation::plane_c, "1", "C", As::formula, Guess::formula},
           Field{"plane_d", &PlaneEquation::plane_d, "1", "D", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<Extent>{.name = "extent",
                                                    .meaning = "the bounding box of a piece",
                                                    .work = WorkKind::planes,
                                                    .called = "extents of {piece}"};
template <>
inline constexpr auto fields_of<Extent> =
    Fields{Field{"piece", &Extent::piece, Measure::piece, "the piece", As::subject},
           Field{"x_min", &Extent::x_min, "px", "its least x", As::formula, Guess::formula},
           Field{"x_max", &Extent::x_max, "px", "its greatest x", As::formula, Guess::formula},
           Field{"y_min", &Extent::y_min, "px", "its least y", As::formula, Guess::formula},
           Field{"y_max", &Extent::y_max, "px", "its greatest y", As::formula, Guess::formula},
           Field{"z_min", &Extent::z_min, "depth", "its least depth", As::formula, Guess::formula},
           Field{"z_max", &Extent::z_max, "depth", "its greatest depth", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<PlaneDepth>{
    .name = "plane_depth",
    .meaning = "the depth of a piece's plane at a point of the raster: z = -(A x + B y + D)/C",
    .work = WorkKind::depths,
    .called = "depth of the plane of {piece}",
    .within = Within::scan_line | Within::area};
template <>
inline constexpr auto fields_of<PlaneDepth> =
    Fields{Field{"piece", &PlaneDepth::piece, Measure::piece, "the piece", As::subject, Guess::told},
           Field{"x_at", &PlaneDepth::x_at, "px", "x of the point", As::input, Guess::told},
           Field{"y_at", &PlaneDepth::y_at, "px", "y of the point", As::input, Guess::told},
           Field{"z", &PlaneDepth::z, "depth", "the depth there", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<VertexSide>{.name = "vertex_side",
                                                        .meaning = "a vertex is held against the plane of a piece",
                                                        .work = WorkKind::tests,
                                                        .called = "vertex {vertex} against the plane of {plane_of}",
                                                        .within = Within::node,
                                                        .after_polygons = true};
template <>
inline constexpr auto fields_of<VertexSide> =
    Fields{Field{"vertex", &VertexSide::vertex, Measure::vertex, "the vertex", As::subject, Guess::told},
           Field{"plane_of", &VertexSide::plane_of, Measure::piece, "the piece whose plane it is", As::subject},
           Field{"value", &VertexSide::value, "1", "A x + B y + C z + D at the vertex", As::formula, Guess::formula},
           Field{"side", &VertexSide::side, "1", "where it lies", As::recorded, Guess::formula}};

template <>
inline constexpr Description description_of<SideTest>{.name = "side_test",
                                                      .meaning = "a piece is held against the plane of another",
                                                      .work = WorkKind::tests,
                                                      .called = "{piece} against the plane of {plane_of}",
                                                      .within = Within::node,
                                                      .after_polygons = true};
template <>
inline constexpr auto fields_of<SideTest> = Fields{
    Field{"piece", &SideTest::piece, Measure::piece, "the piece", As::subject, Guess::told},
    Field{"plane_of", &SideTest::plane_of, Measure::piece, "the piece whose plane it is", As::subject, Guess::told},
    Field{"least", &SideTest::least, "1", "the least of A x + B y + C z + D over its vertices", As::formula,
          Guess::formula},
    Field{"greatest", &SideTest::greatest, "1", "the greatest", As::formula, Guess::formula},
    Field{"side", &SideTest::side, "1", "where it lies; crossing is on both sides", As::recorded, Guess::formula}};

template <>
inline constexpr Description description_of<ExtentTest>{
    .name = "extent_test",
    .meaning = "the extents of two pieces along an axis: do they overlap?",
    .work = WorkKind::tests,
    .called = "{axis} extents of {piece} and {other}"};
template <>
inline constexpr auto fields_of<ExtentTest> = Fields{
    Field{"piece", &ExtentTest::piece, Measure::piece, "the one", As::subject},
    Field{"other", &ExtentTest::other, Measure::piece, "the other", As::subject},
    Field{"axis", &ExtentTest::axis, "1", "the axis", As::subject, Guess::told},
    Field{"low", &ExtentTest::low, "1", "least coordinate of the one", As::formula, Guess::formula},
    Field{"high", &ExtentTest::high, "1", "its greatest", As::formula, Guess::formula},
    Field{"other_low", &ExtentTest::other_low, "1", "least coordinate of the other", As::formula, Guess::formula},
    Field{"other_high", &ExtentTest::other_high, "1", "its greatest", As::formula, Guess::formula},
    Field{"overlap", &ExtentTest::overlap, "1", "they overlap", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<OverlapTest>{
    .name = "overlap_test", .meaning = "the projections of two pieces: do they overlap?", .work = WorkKind::tests};
template <>
inline constexpr auto fields_of<OverlapTest> = Fields{
    Field{"piece", &OverlapTest::piece, Measure::piece, "the one", As::subject},
    Field{"other", &OverlapTest::other, Measure::piece, "the other", As::subject},
    Field{"overlap", &OverlapTest::overlap, "1", "they overlap", As::recorded},
    Field{"x_at", &OverlapTest::x_at, "px", "a point inside both; NaN without overlap", As::recorded | As::aside},
    Field{"y_at", &OverlapTest::y_at, "px", "a point inside both; NaN without overlap", As::recorded | As::aside}};

template <>
inline constexpr Description description_of<SplitVertex>{
    .name = "split_vertex",
    .meaning = "an edge of a piece crosses a plane and gets a new vertex",
    .work = WorkKind::cuts,
    .called = "vertex {vertex}, made where the edge from {vertex_0} to {vertex_1} is cut",
    .either_way = true};
template <>
inline constexpr auto fields_of<SplitVertex> =
    Fields{Field{"vertex_0", &SplitVertex::vertex_0, Measure::vertex, "one end of the edge", As::subject},
           Field{"vertex_1", &SplitVertex::vertex_1, Measure::vertex, "the other", As::subject},
           Field{"t", &SplitVertex::t, "1", "d_0/(d_0 - d_1), from the first end", As::formula},
           Field{"vertex", &SplitVertex::vertex, Measure::vertex, "the new vertex", As::made, Guess::next},
           Field{"space", &SplitVertex::space, "1", "which coordinates follow", As::input},
           Field{"x_cut", &SplitVertex::x_cut, "1", "its x", As::formula},
           Field{"y_cut", &SplitVertex::y_cut, "1", "its y", As::formula},
           Field{"z_cut", &SplitVertex::z_cut, "1", "its z or depth", As::formula}};

template <>
inline constexpr Description description_of<PieceDraw>{
    .name = "piece_draw", .meaning = "a piece is drawn", .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<PieceDraw> =
    Fields{Field{"piece", &PieceDraw::piece, Measure::piece, "the piece", As::subject},
           Field{"polygon", &PieceDraw::polygon, Measure::polygon, "the polygon it is a piece of", As::formula}};

template <>
inline constexpr Description description_of<Saved>{
    .name = "saved",
    .meaning = "tests that coherence, an extent or the order of drawing made needless",
    .work = WorkKind::bookkeeping,
    .within = Within::area | Within::scan_line | Within::ray};
template <>
inline constexpr auto fields_of<Saved> =
    Fields{Field{"coherence", &Saved::coherence, "1",
                 "thanks to which coherence; or to extents, or to the order of drawing", As::subject},
           Field{"tests", &Saved::tests, "1", "how many tests were not made", As::recorded}};

}  // namespace zstep
