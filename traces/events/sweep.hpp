// The scan-line method: all polygons along one scan line.
// Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <cstdint>

#include "traces/events/field.hpp"

namespace zstep {

// clang-format off

struct FlagFlip { std::int32_t edge, piece; bool inside; };
struct SpanFlags { std::int32_t y; double x_left, x_right; std::int32_t first, last, flags; };
struct ImpliedEdge { std::int32_t piece, other; double x_at, z; };
struct SpanWinner { std::int32_t piece, first, last; };
struct CoverageAdd { std::int32_t x, y, owner; double coverage; };

// clang-format on

template <>
inline constexpr Description description_of<FlagFlip>{
    .name = "flag_flip",
    .meaning = "the sweep crosses an edge and its polygon's in/out flag flips",
    .work = WorkKind::bookkeeping,
    .within = Within::scan_line};
template <>
inline constexpr auto fields_of<FlagFlip> =
    Fields{Field{"edge", &FlagFlip::edge, Measure::edge, "the edge", As::subject},
           Field{"piece", &FlagFlip::piece, Measure::piece, "the row of the polygon table", As::input, Guess::formula},
           Field{"inside", &FlagFlip::inside, "1", "the flag from here on", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<SpanFlags>{
    .name = "span_flags",
    .meaning = "an interval of the scan line between two crossings, and how many flags are true on it",
    .work = WorkKind::edges,
    .called = "interval of scan line {y}",
    .begins = {Unit::span, "span"}};
template <>
inline constexpr auto fields_of<SpanFlags> =
    Fields{Field{"y", &SpanFlags::y, Measure::row, "the scan line", As::subject},
           Field{"x_left", &SpanFlags::x_left, "px", "where it begins", As::formula, Guess::told},
           Field{"x_right", &SpanFlags::x_right, "px", "where it ends", As::formula, Guess::told},
           Field{"first", &SpanFlags::first, Measure::span_end, "its first pixel", As::formula, Guess::formula},
           Field{"last", &SpanFlags::last, Measure::span_end,
                 "its last pixel; smaller than the first when none lies between", As::formula, Guess::formula},
           Field{"flags", &SpanFlags::flags, "1", "how many flags are true", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<ImpliedEdge>{
    .name = "implied_edge",
    .meaning = "two polygons penetrate each other: where their planes meet on this scan line",
    .work = WorkKind::cuts,
    .called = "implied edge of {piece} and {other}",
    .within = Within::scan_line};
template <>
inline constexpr auto fields_of<ImpliedEdge> =
    Fields{Field{"piece", &ImpliedEdge::piece, Measure::piece, "the one", As::subject},
           Field{"other", &ImpliedEdge::other, Measure::piece, "the other", As::subject},
           Field{"x_at", &ImpliedEdge::x_at, "px", "where the depths are equal", As::formula},
           Field{"z", &ImpliedEdge::z, "depth", "the depth there", As::formula}};

template <>
inline constexpr Description description_of<SpanWinner>{.name = "span_winner",
                                                        .meaning = "the polygon that is seen on an interval",
                                                        .work = WorkKind::tests,
                                                        .within = Within::scan_line,
                                                        .gives_around = "on the interval of the scan line around it"};
template <>
inline constexpr auto fields_of<SpanWinner> = Fields{
    Field{"piece", &SpanWinner::piece, Measure::piece, "its row of the polygon table", As::input},
    Field{"first", &SpanWinner::first, Measure::span_end, "the first pixel", As::recorded | As::ruled | As::subject},
    Field{"last", &SpanWinner::last, Measure::span_end, "the last pixel", As::recorded | As::ruled}};

template <>
inline constexpr Description description_of<CoverageAdd>{
    .name = "coverage_add", .meaning = "the part of a pixel's area that a polygon covers", .work = WorkKind::writes};
template <>
inline constexpr auto fields_of<CoverageAdd> = Fields{
    Field{"x", &CoverageAdd::x, Measure::column, "column", As::subject},
    Field{"y", &CoverageAdd::y, Measure::pixel_row, "row", As::subject},
    Field{"owner", &CoverageAdd::owner, Measure::polygon_or_none, "the polygon; -1 is the background", As::subject},
    Field{"coverage", &CoverageAdd::coverage, "1", "share of the pixel, 0 to 1", As::formula}};

}  // namespace zstep
