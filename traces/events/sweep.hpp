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
inline constexpr KindText kind_text<FlagFlip>{"flag_flip",
                                              "the sweep crosses an edge and its polygon's in/out flag flips"};
template <>
inline constexpr auto fields_of<FlagFlip> =
    Fields{Field{"edge", &FlagFlip::edge, "index", "the edge"},
               Field{"piece", &FlagFlip::piece, "index", "the row of the polygon table", Guess::formula},
               Field{"inside", &FlagFlip::inside, "1", "the flag from here on", Guess::formula}};

template <>
inline constexpr KindText kind_text<SpanFlags>{
    "span_flags", "an interval of the scan line between two crossings, and how many flags are true on it"};
template <>
inline constexpr auto fields_of<SpanFlags> =
    Fields{Field{"y", &SpanFlags::y, "row", "the scan line"},
           Field{"x_left", &SpanFlags::x_left, "px", "where it begins", Guess::told},
           Field{"x_right", &SpanFlags::x_right, "px", "where it ends", Guess::told},
           Field{"first", &SpanFlags::first, "px", "its first pixel", Guess::formula},
           Field{"last", &SpanFlags::last, "px", "its last pixel; smaller than the first when none lies between",
                 Guess::formula},
           Field{"flags", &SpanFlags::flags, "1", "how many flags are true", Guess::formula}};

template <>
inline constexpr KindText kind_text<ImpliedEdge>{
    "implied_edge", "two polygons penetrate each other: where their planes meet on this scan line"};
template <>
inline constexpr auto fields_of<ImpliedEdge> = Fields{
    Field{"piece", &ImpliedEdge::piece, "index", "the one"}, Field{"other", &ImpliedEdge::other, "index", "the other"},
    Field{"x_at", &ImpliedEdge::x_at, "px", "where the depths are equal"},
    Field{"z", &ImpliedEdge::z, "depth", "the depth there"}};

template <>
inline constexpr KindText kind_text<SpanWinner>{"span_winner", "the polygon that is seen on an interval"};
template <>
inline constexpr auto fields_of<SpanWinner> =
    Fields{Field{"piece", &SpanWinner::piece, "index", "its row of the polygon table"},
               Field{"first", &SpanWinner::first, "px", "the first pixel"},
               Field{"last", &SpanWinner::last, "px", "the last pixel"}};

template <>
inline constexpr KindText kind_text<CoverageAdd>{"coverage_add", "the part of a pixel's area that a polygon covers"};
template <>
inline constexpr auto fields_of<CoverageAdd> =
    Fields{Field{"x", &CoverageAdd::x, "px", "column"}, Field{"y", &CoverageAdd::y, "px", "row"},
               Field{"owner", &CoverageAdd::owner, "index", "the polygon; -1 is the background"},
               Field{"coverage", &CoverageAdd::coverage, "1", "share of the pixel, 0 to 1"}};

}  // namespace zstep
