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
inline constexpr Description description_of<CurveBegin>{.name = "curve_begin",
                                                        .meaning = "work on a curve of the surface begins",
                                                        .work = WorkKind::bookkeeping,
                                                        .begins = {Unit::polygon, "curve"},
                                                        .after_polygons = true};
template <>
inline constexpr auto fields_of<CurveBegin> =
    Fields{Field{"curve", &CurveBegin::curve, Measure::curve,
                 "the curve, numbered in the order in which curves are drawn", As::made, Guess::next},
           Field{"row", &CurveBegin::row, "index", "the row of the surface's grid, or the column", As::subject},
           Field{"across", &CurveBegin::across, "1", "it is a curve of constant x", As::subject},
           Field{"constant", &CurveBegin::constant, "world", "the z (or x) that is constant on it", As::formula}};

template <>
inline constexpr Description description_of<CurveSegment>{.name = "curve_segment",
                                                          .meaning = "a piece of the curve between two sampled points",
                                                          .work = WorkKind::bookkeeping,
                                                          .within = Within::curve};
template <>
inline constexpr auto fields_of<CurveSegment> =
    Fields{Field{"vertex_0", &CurveSegment::vertex_0, Measure::vertex, "the point it comes from", As::subject},
           Field{"vertex_1", &CurveSegment::vertex_1, Measure::vertex, "the point it goes to", As::subject}};

template <>
inline constexpr Description description_of<HorizonTest>{
    .name = "horizon_test",
    .meaning = "a point of the curve is held against the horizons of its column",
    .work = WorkKind::tests,
    .called = "the curve at column {x}",
    .within = Within::curve};
template <>
inline constexpr auto fields_of<HorizonTest> =
    Fields{Field{"x", &HorizonTest::x, Measure::column, "the column", As::subject, Guess::next},
           Field{"y_curve", &HorizonTest::y_curve, "px", "row of the curve there, not rounded", As::formula},
           Field{"verdict", &HorizonTest::verdict, "1",
                 "above the upper horizon, below the lower one, or hidden between", As::formula}};

template <>
inline constexpr Description description_of<HorizonMove>{.name = "horizon_move",
                                                         .meaning = "a horizon takes a new value",
                                                         .work = WorkKind::writes,
                                                         .called = "{upper} horizon of column {x} moves",
                                                         .within = Within::curve};
template <>
inline constexpr auto fields_of<HorizonMove> =
    Fields{Field{"x", &HorizonMove::x, Measure::column, "the column", As::subject},
           Field{"upper", &HorizonMove::upper, "1", "it is the upper horizon", As::subject},
           Field{"y_curve", &HorizonMove::y_curve, "px", "its row from here on", As::formula}};

template <>
inline constexpr Description description_of<HorizonCross>{.name = "horizon_cross",
                                                          .meaning = "the curve crosses a horizon between two columns",
                                                          .work = WorkKind::cuts,
                                                          .within = Within::curve};
template <>
inline constexpr auto fields_of<HorizonCross> =
    Fields{Field{"upper", &HorizonCross::upper, "1", "it is the upper horizon", As::subject},
           Field{"x_at", &HorizonCross::x_at, "px", "x of the crossing", As::formula},
           Field{"y_at", &HorizonCross::y_at, "px", "its row", As::formula}};

template <>
inline constexpr Description description_of<LineBegin>{.name = "line_begin",
                                                       .meaning = "work on an edge of the mesh begins",
                                                       .work = WorkKind::bookkeeping,
                                                       .either_way = true,
                                                       .begins = {Unit::scan_line, "edge"},
                                                       .after_polygons = true};
template <>
inline constexpr auto fields_of<LineBegin> = Fields{
    Field{"line", &LineBegin::line, Measure::line, "the edge", As::made, Guess::next},
    Field{"vertex_0", &LineBegin::vertex_0, Measure::vertex, "its one end", As::subject},
    Field{"vertex_1", &LineBegin::vertex_1, Measure::vertex, "its other end", As::subject},
    Field{"left_facet", &LineBegin::left_facet, Measure::facet_or_none, "the facet on its left, -1 if none",
          As::recorded},
    Field{"right_facet", &LineBegin::right_facet, Measure::facet_or_none, "the facet on its right, -1 if none",
          As::recorded},
    Field{"kind", &LineBegin::kind, "1",
          "inner, contour (front meets back), boundary (one facet), or back (all its facets face away)", As::recorded}};

template <>
inline constexpr Description description_of<LineAgainst>{
    .name = "line_against", .meaning = "an edge is held against a face that may cover it", .work = WorkKind::tests};
template <>
inline constexpr auto fields_of<LineAgainst> = Fields{
    Field{"line", &LineAgainst::line, Measure::line, "the edge", As::subject},
    Field{"facet", &LineAgainst::facet, Measure::facet, "the face", As::subject},
    Field{"outcome", &LineAgainst::outcome, "1",
          "extents apart, its own face, in front of the face, behind it but beside, or covered in part", As::recorded}};

template <>
inline constexpr Description description_of<LineCross>{
    .name = "line_cross",
    .meaning = "an edge crosses an edge of a face on the picture, or the face's plane in space",
    .work = WorkKind::cuts,
    .called = "line {line} crosses {facet}"};
template <>
inline constexpr auto fields_of<LineCross> =
    Fields{Field{"line", &LineCross::line, Measure::line, "the edge", As::subject},
           Field{"facet", &LineCross::facet, Measure::facet, "the face", As::subject},
           Field{"t", &LineCross::t, "1", "where on the edge, 0 to 1", As::formula},
           Field{"x_at", &LineCross::x_at, "px", "there", As::formula},
           Field{"y_at", &LineCross::y_at, "px", "there", As::formula},
           Field{"in_space", &LineCross::in_space, "1", "it crosses the plane", As::input}};

template <>
inline constexpr Description description_of<LineHide>{.name = "line_hide",
                                                      .meaning = "an interval of an edge is hidden by a face",
                                                      .work = WorkKind::cuts,
                                                      .called = "line {line} is hidden by {facet}"};
template <>
inline constexpr auto fields_of<LineHide> = Fields{
    Field{"line", &LineHide::line, Measure::line, "the edge", As::subject},
    Field{"facet", &LineHide::facet, Measure::facet, "the face", As::subject},
    Field{"t_0", &LineHide::t_0, "1", "from", As::formula}, Field{"t_1", &LineHide::t_1, "1", "to", As::formula}};

template <>
inline constexpr Description description_of<LinePiece>{.name = "line_piece",
                                                       .meaning = "a piece of an edge, visible or hidden",
                                                       .work = WorkKind::writes,
                                                       .called = "a piece of line {line}"};
template <>
inline constexpr auto fields_of<LinePiece> = Fields{
    Field{"line", &LinePiece::line, Measure::line, "the edge", As::subject},
    Field{"t_0", &LinePiece::t_0, "1", "from", As::formula}, Field{"t_1", &LinePiece::t_1, "1", "to", As::formula},
    Field{"visible", &LinePiece::visible, "1", "it is seen", As::formula}};

}  // namespace zstep
