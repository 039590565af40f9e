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
struct SplitVertex { std::int32_t vertex_0, vertex_1; double t; std::int32_t vertex; Space space; double x_cut, y_cut, z_cut; };
struct PieceDraw { std::int32_t piece, polygon; };
struct Saved { Coherence coherence; std::int32_t tests; };

// clang-format on

template <>
inline constexpr KindText kind_text<TablesBegin>{
    "tables_begin", "edges, vertices and pieces of all polygons are kept from here on, until the run ends"};
template <>
inline constexpr auto fields_of<TablesBegin> =
    Fields{Field{"polygons", &TablesBegin::polygons, "1", "how many polygons the scene has"}};

template <>
inline constexpr KindText kind_text<PieceMake>{"piece_make", "the outline so far becomes a piece"};
template <>
inline constexpr auto fields_of<PieceMake> =
    Fields{Field{"piece", &PieceMake::piece, "index", "the piece, numbered in the order in which pieces are made",
                     Guess::next},
               Field{"polygon", &PieceMake::polygon, "index", "the polygon it is a piece of"},
               Field{"parent", &PieceMake::parent, "index", "the piece it was cut from, -1 if it is whole"}};

template <>
inline constexpr KindText kind_text<PlaneEquation>{"plane_equation", "the plane of a piece: A x + B y + C z + D = 0"};
template <>
inline constexpr auto fields_of<PlaneEquation> =
    Fields{Field{"piece", &PlaneEquation::piece, "index", "the piece"},
           Field{"plane_a", &PlaneEquation::plane_a, "1", "A", Guess::formula},
           Field{"plane_b", &PlaneEquation::plane_b, "1", "B", Guess::formula},
           Field{"plane_c", &PlaneEquation::plane_c, "1", "C", Guess::formula},
           Field{"plane_d", &PlaneEquation::plane_d, "1", "D", Guess::formula}};

template <>
inline constexpr KindText kind_text<Extent>{"extent", "the bounding box of a piece"};
template <>
inline constexpr auto fields_of<Extent> =
    Fields{Field{"piece", &Extent::piece, "index", "the piece"},
           Field{"x_min", &Extent::x_min, "px", "its least x", Guess::formula},
           Field{"x_max", &Extent::x_max, "px", "its greatest x", Guess::formula},
           Field{"y_min", &Extent::y_min, "px", "its least y", Guess::formula},
           Field{"y_max", &Extent::y_max, "px", "its greatest y", Guess::formula},
           Field{"z_min", &Extent::z_min, "depth", "its least depth", Guess::formula},
           Field{"z_max", &Extent::z_max, "depth", "its greatest depth", Guess::formula}};

template <>
inline constexpr KindText kind_text<PlaneDepth>{
    "plane_depth", "the depth of a piece's plane at a point of the raster: z = -(A x + B y + D)/C"};
template <>
inline constexpr auto fields_of<PlaneDepth> =
    Fields{Field{"piece", &PlaneDepth::piece, "index", "the piece", Guess::told},
           Field{"x_at", &PlaneDepth::x_at, "px", "x of the point", Guess::told},
           Field{"y_at", &PlaneDepth::y_at, "px", "y of the point", Guess::told},
           Field{"z", &PlaneDepth::z, "depth", "the depth there", Guess::formula}};

template <>
inline constexpr KindText kind_text<VertexSide>{"vertex_side", "a vertex is held against the plane of a piece"};
template <>
inline constexpr auto fields_of<VertexSide> =
    Fields{Field{"vertex", &VertexSide::vertex, "index", "the vertex", Guess::told},
               Field{"plane_of", &VertexSide::plane_of, "index", "the piece whose plane it is"},
               Field{"value", &VertexSide::value, "1", "A x + B y + C z + D at the vertex", Guess::formula},
               Field{"side", &VertexSide::side, "1", "where it lies", Guess::formula}};

template <>
inline constexpr KindText kind_text<SideTest>{"side_test", "a piece is held against the plane of another"};
template <>
inline constexpr auto fields_of<SideTest> =
    Fields{Field{"piece", &SideTest::piece, "index", "the piece", Guess::told},
           Field{"plane_of", &SideTest::plane_of, "index", "the piece whose plane it is", Guess::told},
           Field{"least", &SideTest::least, "1", "the least of A x + B y + C z + D over its vertices", Guess::formula},
           Field{"greatest", &SideTest::greatest, "1", "the greatest", Guess::formula},
           Field{"side", &SideTest::side, "1", "where it lies; crossing is on both sides", Guess::formula}};

template <>
inline constexpr KindText kind_text<ExtentTest>{"extent_test",
                                                "the extents of two pieces along an axis: do they overlap?"};
template <>
inline constexpr auto fields_of<ExtentTest> =
    Fields{Field{"piece", &ExtentTest::piece, "index", "the one"},
               Field{"other", &ExtentTest::other, "index", "the other"},
               Field{"axis", &ExtentTest::axis, "1", "the axis", Guess::told},
               Field{"low", &ExtentTest::low, "1", "least coordinate of the one", Guess::formula},
               Field{"high", &ExtentTest::high, "1", "its greatest", Guess::formula},
               Field{"other_low", &ExtentTest::other_low, "1", "least coordinate of the other", Guess::formula},
               Field{"other_high", &ExtentTest::other_high, "1", "its greatest", Guess::formula},
               Field{"overlap", &ExtentTest::overlap, "1", "they overlap", Guess::formula}};

template <>
inline constexpr KindText kind_text<OverlapTest>{"overlap_test", "the projections of two pieces: do they overlap?"};
template <>
inline constexpr auto fields_of<OverlapTest> = Fields{
    Field{"piece", &OverlapTest::piece, "index", "the one"}, Field{"other", &OverlapTest::other, "index", "the other"},
    Field{"overlap", &OverlapTest::overlap, "1", "they overlap"},
    Field{"x_at", &OverlapTest::x_at, "px", "a point inside both; NaN without overlap"},
    Field{"y_at", &OverlapTest::y_at, "px", "a point inside both; NaN without overlap"}};

template <>
inline constexpr KindText kind_text<SplitVertex>{"split_vertex",
                                                 "an edge of a piece crosses a plane and gets a new vertex"};
template <>
inline constexpr auto fields_of<SplitVertex> =
    Fields{Field{"vertex_0", &SplitVertex::vertex_0, "index", "one end of the edge"},
               Field{"vertex_1", &SplitVertex::vertex_1, "index", "the other"},
               Field{"t", &SplitVertex::t, "1", "d_0/(d_0 - d_1), from the first end"},
               Field{"vertex", &SplitVertex::vertex, "index", "the new vertex", Guess::next},
               Field{"space", &SplitVertex::space, "1", "which coordinates follow"},
               Field{"x_cut", &SplitVertex::x_cut, "1", "its x"},
               Field{"y_cut", &SplitVertex::y_cut, "1", "its y"},
               Field{"z_cut", &SplitVertex::z_cut, "1", "its z or depth"}};

template <>
inline constexpr KindText kind_text<PieceDraw>{"piece_draw", "a piece is drawn"};
template <>
inline constexpr auto fields_of<PieceDraw> =
    Fields{Field{"piece", &PieceDraw::piece, "index", "the piece"},
               Field{"polygon", &PieceDraw::polygon, "index", "the polygon it is a piece of"}};

template <>
inline constexpr KindText kind_text<Saved>{"saved",
                                           "tests that coherence, an extent or the order of drawing made needless"};
template <>
inline constexpr auto fields_of<Saved> = Fields{
    Field{"coherence", &Saved::coherence, "1", "thanks to which coherence; or to extents, or to the order of drawing"},
    Field{"tests", &Saved::tests, "1", "how many tests were not made"}};

}  // namespace zstep
