// Edge table, active edges, spans. Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

enum class EdgeSkip : std::uint8_t { horizontal, between_rows };

template <>
inline constexpr std::array<std::string_view, 2> words_of<EdgeSkip>{"horizontal", "between_rows"};

// clang-format off

struct EdgeTableInsert {
  std::int32_t edge, polygon, vertex_0, vertex_1, first_row, end_row;
  double x_edge, dx_dy, z_edge, dz_dy;
};
struct EdgeTableSkip { std::int32_t vertex_0, vertex_1; EdgeSkip why; };
struct ScanLineBegin { std::int32_t y; };
struct EdgeEnter { std::int32_t edge, place; };
struct EdgeRetire { std::int32_t edge; };
struct EdgeStep { std::int32_t edge; double x_edge, z_edge; };
struct EdgeSwap { std::int32_t place; };
struct PlaneSlopes { std::int32_t polygon, vertex_0, vertex_1, vertex_2; double dz_dx, dz_dy; };
struct SpanBegin {
  std::int32_t left_edge, right_edge, y, first, last;
  double x_left, z_left, x_right, z_right, dz_dx;
};

// clang-format on

template <>
inline constexpr KindText kind_text<EdgeTableInsert>{"edge_table_insert",
                                                     "an edge goes into the bucket of its first scan line"};
template <>
inline constexpr auto fields_of<EdgeTableInsert> = Fields{
    Field{"edge", &EdgeTableInsert::edge, "index", "the edge, numbered in order of insertion", Guess::told},
    Field{"polygon", &EdgeTableInsert::polygon, "index", "the polygon it bounds", Guess::told},
    Field{"vertex_0", &EdgeTableInsert::vertex_0, "index", "its end with the smaller y", Guess::told},
    Field{"vertex_1", &EdgeTableInsert::vertex_1, "index", "its end with the larger y", Guess::told},
    Field{"first_row", &EdgeTableInsert::first_row, "row", "the first scan line it meets: its bucket", Guess::formula},
    Field{"end_row", &EdgeTableInsert::end_row, "row", "the scan line at which it leaves", Guess::formula},
    Field{"x_edge", &EdgeTableInsert::x_edge, "px", "x on the first scan line", Guess::formula},
    Field{"dx_dy", &EdgeTableInsert::dx_dy, "px", "1/m: what x gains from line to line", Guess::formula},
    Field{"z_edge", &EdgeTableInsert::z_edge, "depth", "depth on the first scan line", Guess::formula},
    Field{"dz_dy", &EdgeTableInsert::dz_dy, "depth", "what depth gains from line to line", Guess::formula}};

template <>
inline constexpr KindText kind_text<EdgeTableSkip>{"edge_table_skip",
                                                   "an edge meets no scan line and stays out of the table"};
template <>
inline constexpr auto fields_of<EdgeTableSkip> =
    Fields{Field{"vertex_0", &EdgeTableSkip::vertex_0, "index", "one end", Guess::told},
               Field{"vertex_1", &EdgeTableSkip::vertex_1, "index", "the other end", Guess::told},
               Field{"why", &EdgeTableSkip::why, "1", "horizontal, or too short to meet a scan line", Guess::formula}};

template <>
inline constexpr KindText kind_text<ScanLineBegin>{"scan_line_begin", "work on a scan line begins"};
template <>
inline constexpr auto fields_of<ScanLineBegin> =
    Fields{Field{"y", &ScanLineBegin::y, "row", "the scan line", Guess::told}};

template <>
inline constexpr KindText kind_text<EdgeEnter>{"edge_enter",
                                               "an edge moves from the edge table to the active edge list"};
template <>
inline constexpr auto fields_of<EdgeEnter> =
    Fields{Field{"edge", &EdgeEnter::edge, "index", "the edge", Guess::told},
           Field{"place", &EdgeEnter::place, "index", "its place in the list, from the left, from 0", Guess::formula}};

template <>
inline constexpr KindText kind_text<EdgeRetire>{"edge_retire", "an edge that ends leaves the active edge list"};
template <>
inline constexpr auto fields_of<EdgeRetire> =
    Fields{Field{"edge", &EdgeRetire::edge, "index", "the edge", Guess::told}};

template <>
inline constexpr KindText kind_text<EdgeStep>{"edge_step", "an active edge moves to the next scan line"};
template <>
inline constexpr auto fields_of<EdgeStep> =
    Fields{Field{"edge", &EdgeStep::edge, "index", "the edge", Guess::told},
           Field{"x_edge", &EdgeStep::x_edge, "px", "its x there", Guess::formula},
           Field{"z_edge", &EdgeStep::z_edge, "depth", "its depth there", Guess::formula}};

template <>
inline constexpr KindText kind_text<EdgeSwap>{"edge_swap", "two neighbours in the active edge list change places"};
template <>
inline constexpr auto fields_of<EdgeSwap> =
    Fields{Field{"place", &EdgeSwap::place, "index", "the left one of the two places"}};

template <>
inline constexpr KindText kind_text<PlaneSlopes>{"plane_slopes",
                                                 "how depth changes on a polygon's plane, from three of its vertices"};
template <>
inline constexpr auto fields_of<PlaneSlopes> = Fields{
    Field{"polygon", &PlaneSlopes::polygon, "index", "the polygon"},
    Field{"vertex_0", &PlaneSlopes::vertex_0, "index", "the vertex from which depths are counted"},
    Field{"vertex_1", &PlaneSlopes::vertex_1, "index", "another one"},
    Field{"vertex_2", &PlaneSlopes::vertex_2, "index", "and a third"},
    Field{"dz_dx", &PlaneSlopes::dz_dx, "depth", "-A/C: what depth gains from pixel to pixel"},
    Field{"dz_dy", &PlaneSlopes::dz_dy, "depth", "-B/C: what it gains from line to line"}};

template <>
inline constexpr KindText kind_text<SpanBegin>{"span_begin", "the pixels between two active edges"};
template <>
inline constexpr auto fields_of<SpanBegin> =
    Fields{Field{"left_edge", &SpanBegin::left_edge, "index", "the edge on the left", Guess::told},
           Field{"right_edge", &SpanBegin::right_edge, "index", "the edge on the right", Guess::told},
           Field{"y", &SpanBegin::y, "row", "the scan line"},
           Field{"first", &SpanBegin::first, "px", "the first pixel", Guess::formula},
           Field{"last", &SpanBegin::last, "px", "the last pixel; smaller than the first when none lies between",
                 Guess::formula},
           Field{"x_left", &SpanBegin::x_left, "px", "x where the scan line meets the left edge", Guess::formula},
           Field{"z_left", &SpanBegin::z_left, "depth", "depth there", Guess::formula},
           Field{"x_right", &SpanBegin::x_right, "px", "x where the scan line meets the right edge", Guess::formula},
           Field{"z_right", &SpanBegin::z_right, "depth", "depth there", Guess::formula},
           Field{"dz_dx", &SpanBegin::dz_dx, "depth", "what depth gains from pixel to pixel", Guess::formula}};

}  // namespace zstep
