// Curves and lines: floating horizon, wireframe, hidden lines.
// Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

enum class Horizon : std::uint8_t { above, below, hidden };
enum class LineKind : std::uint8_t { inner, contour, boundary, back };
enum class LineFace : std::uint8_t { apart, own, in_front, behind, covered };

template <>
inline constexpr std::array<std::string_view, 3> words_of<Horizon>{"above", "below", "hidden"};
template <>
inline constexpr std::array<std::string_view, 4> words_of<LineKind>{"inner", "contour", "boundary", "back"};
template <>
inline constexpr std::array<std::string_view, 5> words_of<LineFace>{"apart", "own", "in_front", "behind", "covered"};

// clang-format off

struct CurveBegin { std::int32_t curve, row; bool across; double constant; };
struct CurveSegment { std::int32_t vertex_0, vertex_1; };
struct HorizonTest { std::int32_t x; double y_curve; Horizon verdict; };
struct HorizonMove { std::int32_t x; bool upper; double y_curve; };
struct HorizonCross { bool upper; double x_at, y_at; };
struct LineBegin { std::int32_t line, vertex_0, vertex_1, left_facet, right_facet; LineKind kind; };
struct LineAgainst { std::int32_t line, facet; LineFace outcome; };
struct LineCross { std::int32_t line, facet; double t, x_at, y_at; bool in_space; };
struct LineHide { std::int32_t line, facet; double t_0, t_1; };
struct LinePiece { std::int32_t line; double t_0, t_1; bool visible; };

// clang-format on

template <>
inline constexpr KindText kind_text<CurveBegin>{"curve_begin", "work on a curve of the surface begins"};
template <>
inline constexpr auto fields_of<CurveBegin> =
    Fields{Field{"curve", &CurveBegin::curve, "index", "the curve, numbered in the order in which curves are drawn",
                     Guess::next},
               Field{"row", &CurveBegin::row, "index", "the row of the surface's grid, or the column"},
               Field{"across", &CurveBegin::across, "1", "it is a curve of constant x"},
               Field{"constant", &CurveBegin::constant, "world", "the z (or x) that is constant on it"}};

template <>
inline constexpr KindText kind_text<CurveSegment>{"curve_segment", "a piece of the curve between two sampled points"};
template <>
inline constexpr auto fields_of<CurveSegment> =
    Fields{Field{"vertex_0", &CurveSegment::vertex_0, "index", "the point it comes from"},
               Field{"vertex_1", &CurveSegment::vertex_1, "index", "the point it goes to"}};

template <>
inline constexpr KindText kind_text<HorizonTest>{"horizon_test",
                                                 "a point of the curve is held against the horizons of its column"};
template <>
inline constexpr auto fields_of<HorizonTest> = Fields{
    Field{"x", &HorizonTest::x, "px", "the column", Guess::next},
    Field{"y_curve", &HorizonTest::y_curve, "px", "row of the curve there, not rounded"},
    Field{"verdict", &HorizonTest::verdict, "1", "above the upper horizon, below the lower one, or hidden between"}};

template <>
inline constexpr KindText kind_text<HorizonMove>{"horizon_move", "a horizon takes a new value"};
template <>
inline constexpr auto fields_of<HorizonMove> =
    Fields{Field{"x", &HorizonMove::x, "px", "the column"},
               Field{"upper", &HorizonMove::upper, "1", "it is the upper horizon"},
               Field{"y_curve", &HorizonMove::y_curve, "px", "its row from here on"}};

template <>
inline constexpr KindText kind_text<HorizonCross>{"horizon_cross", "the curve crosses a horizon between two columns"};
template <>
inline constexpr auto fields_of<HorizonCross> = Fields{
    Field{"upper", &HorizonCross::upper, "1", "it is the upper horizon"},
    Field{"x_at", &HorizonCross::x_at, "px", "x of the crossing"}, Field{"y_at", &HorizonCross::y_at, "px", "its row"}};

template <>
inline constexpr KindText kind_text<LineBegin>{"line_begin", "work on an edge of the mesh begins"};
template <>
inline constexpr auto fields_of<LineBegin> =
    Fields{Field{"line", &LineBegin::line, "index", "the edge", Guess::next},
               Field{"vertex_0", &LineBegin::vertex_0, "index", "its one end"},
               Field{"vertex_1", &LineBegin::vertex_1, "index", "its other end"},
               Field{"left_facet", &LineBegin::left_facet, "index", "the facet on its left, -1 if none"},
               Field{"right_facet", &LineBegin::right_facet, "index", "the facet on its right, -1 if none"},
               Field{"kind", &LineBegin::kind, "1",
                     "inner, contour (front meets back), boundary (one facet), or back (all its facets face away)"}};

template <>
inline constexpr KindText kind_text<LineAgainst>{"line_against", "an edge is held against a face that may cover it"};
template <>
inline constexpr auto fields_of<LineAgainst> = Fields{
    Field{"line", &LineAgainst::line, "index", "the edge"}, Field{"facet", &LineAgainst::facet, "index", "the face"},
    Field{"outcome", &LineAgainst::outcome, "1",
          "extents apart, its own face, in front of the face, behind it but beside, or covered in part"}};

template <>
inline constexpr KindText kind_text<LineCross>{
    "line_cross", "an edge crosses an edge of a face on the picture, or the face's plane in space"};
template <>
inline constexpr auto fields_of<LineCross> =
    Fields{Field{"line", &LineCross::line, "index", "the edge"},
               Field{"facet", &LineCross::facet, "index", "the face"},
               Field{"t", &LineCross::t, "1", "where on the edge, 0 to 1"},
               Field{"x_at", &LineCross::x_at, "px", "there"},
               Field{"y_at", &LineCross::y_at, "px", "there"},
               Field{"in_space", &LineCross::in_space, "1", "it crosses the plane"}};

template <>
inline constexpr KindText kind_text<LineHide>{"line_hide", "an interval of an edge is hidden by a face"};
template <>
inline constexpr auto fields_of<LineHide> = Fields{
    Field{"line", &LineHide::line, "index", "the edge"}, Field{"facet", &LineHide::facet, "index", "the face"},
    Field{"t_0", &LineHide::t_0, "1", "from"}, Field{"t_1", &LineHide::t_1, "1", "to"}};

template <>
inline constexpr KindText kind_text<LinePiece>{"line_piece", "a piece of an edge, visible or hidden"};
template <>
inline constexpr auto fields_of<LinePiece> =
    Fields{Field{"line", &LinePiece::line, "index", "the edge"}, Field{"t_0", &LinePiece::t_0, "1", "from"},
               Field{"t_1", &LinePiece::t_1, "1", "to"}, Field{"visible", &LinePiece::visible, "1", "it is seen"}};

}  // namespace zstep
