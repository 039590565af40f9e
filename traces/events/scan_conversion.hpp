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
inline constexpr Description description_of<EdgeTableInsert>{
    .name = "edge_table_insert",
    .meaning = "an edge goes into the bucket of its first scan line",
    .work = WorkKind::edges,
    .called = "edge {edge} in the edge table, from vertex {vertex_0} to vertex {vertex_1}",
    .either_way = true};
template <>
inline constexpr auto fields_of<EdgeTableInsert> = Fields{
    Field{"edge", &EdgeTableInsert::edge, Measure::edge, "the edge, numbered in order of insertion", As::made,
          Guess::told},
    Field{"polygon", &EdgeTableInsert::polygon, Measure::polygon, "the polygon it bounds", As::formula | As::subject,
          Guess::told},
    Field{"vertex_0", &EdgeTableInsert::vertex_0, Measure::vertex, "its end with the smaller y", As::subject,
          Guess::told},
    Field{"vertex_1", &EdgeTableInsert::vertex_1, Measure::vertex, "its end with the larger y", As::subject,
          Guess::told},
    Field{"first_row", &EdgeTableInsert::first_row, Measure::row_or_end, "the first scan line it meets: its bucket",
          As::formula, Guess::formula},
    Field{"end_row", &EdgeTableInsert::end_row, Measure::row_or_end, "the scan line at which it leaves", As::formula,
          Guess::formula},
    Field{"x_edge", &EdgeTableInsert::x_edge, "px", "x on the first scan line", As::formula, Guess::formula},
    Field{"dx_dy", &EdgeTableInsert::dx_dy, "px", "1/m: what x gains from line to line", As::formula, Guess::formula},
    Field{"z_edge", &EdgeTableInsert::z_edge, "depth", "depth on the first scan line", As::formula, Guess::formula},
    Field{"dz_dy", &EdgeTableInsert::dz_dy, "depth", "what depth gains from line to line", As::formula,
          Guess::formula}};

template <>
inline constexpr Description description_of<EdgeTableSkip>{
    .name = "edge_table_skip",
    .meaning = "an edge meets no scan line and stays out of the table",
    .work = WorkKind::bookkeeping,
    .within = Within::polygon,
    .either_way = true};
template <>
inline constexpr auto fields_of<EdgeTableSkip> =
    Fields{Field{"vertex_0", &EdgeTableSkip::vertex_0, Measure::vertex, "one end", As::subject, Guess::told},
           Field{"vertex_1", &EdgeTableSkip::vertex_1, Measure::vertex, "the other end", As::subject, Guess::told},
           Field{"why", &EdgeTableSkip::why, "1", "horizontal, or too short to meet a scan line", As::formula,
                 Guess::formula}};

template <>
inline constexpr Description description_of<ScanLineBegin>{.name = "scan_line_begin",
                                                           .meaning = "work on a scan line begins",
                                                           .work = WorkKind::bookkeeping,
                                                           .within = Within::polygon,
                                                           .begins = {Unit::scan_line, "scan line"}};
template <>
inline constexpr auto fields_of<ScanLineBegin> =
    Fields{Field{"y", &ScanLineBegin::y, Measure::row, "the scan line", As::subject, Guess::told}};

template <>
inline constexpr Description description_of<EdgeEnter>{
    .name = "edge_enter",
    .meaning = "an edge moves from the edge table to the active edge list",
    .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<EdgeEnter> =
    Fields{Field{"edge", &EdgeEnter::edge, Measure::edge, "the edge", As::subject, Guess::told},
           Field{"place", &EdgeEnter::place, "index", "its place in the list, from the left, from 0", As::aside,
                 Guess::formula}};

template <>
inline constexpr Description description_of<EdgeRetire>{
    .name = "edge_retire", .meaning = "an edge that ends leaves the active edge list", .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<EdgeRetire> =
    Fields{Field{"edge", &EdgeRetire::edge, Measure::edge, "the edge", As::subject, Guess::told}};

template <>
inline constexpr Description description_of<EdgeStep>{.name = "edge_step",
                                                      .meaning = "an active edge moves to the next scan line",
                                                      .work = WorkKind::edges,
                                                      .called = "active edge {edge} on scan line {scan_line}"};
template <>
inline constexpr auto fields_of<EdgeStep> =
    Fields{Field{"edge", &EdgeStep::edge, Measure::edge, "the edge", As::subject, Guess::told},
           Field{"x_edge", &EdgeStep::x_edge, "px", "its x there", As::formula, Guess::formula},
           Field{"z_edge", &EdgeStep::z_edge, "depth", "its depth there", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<EdgeSwap>{.name = "edge_swap",
                                                      .meaning = "two neighbours in the active edge list change places",
                                                      .work = WorkKind::bookkeeping,
                                                      .within = Within::polygon | Within::scan_line};
template <>
inline constexpr auto fields_of<EdgeSwap> =
    Fields{Field{"place", &EdgeSwap::place, "index", "the left one of the two places", As::aside}};

template <>
inline constexpr Description description_of<PlaneSlopes>{
    .name = "plane_slopes",
    .meaning = "how depth changes on a polygon's plane, from three of its vertices",
    .work = WorkKind::planes,
    .called = "slopes of the plane of {polygon}"};
template <>
inline constexpr auto fields_of<PlaneSlopes> = Fields{
    Field{"polygon", &PlaneSlopes::polygon, Measure::polygon, "the polygon", As::formula | As::subject},
    Field{"vertex_0", &PlaneSlopes::vertex_0, Measure::vertex, "the vertex from which depths are counted", As::input},
    Field{"vertex_1", &PlaneSlopes::vertex_1, Measure::vertex, "another one", As::input},
    Field{"vertex_2", &PlaneSlopes::vertex_2, Measure::vertex, "and a third", As::input},
    Field{"dz_dx", &PlaneSlopes::dz_dx, "depth", "-A/C: what depth gains from pixel to pixel", As::formula},
    Field{"dz_dy", &PlaneSlopes::dz_dy, "depth", "-B/C: what it gains from line to line", As::formula}};

template <>
inline constexpr Description description_of<SpanBegin>{
    .name = "span_begin",
    .meaning = "the pixels between two active edges",
    .work = WorkKind::edges,
    .called = "span of scan line {y} from edge {left_edge} to edge {right_edge}",
    .within = Within::polygon,
    .begins = {Unit::span, "span"}};
template <>
inline constexpr auto fields_of<SpanBegin> = Fields{
    Field{"left_edge", &SpanBegin::left_edge, Measure::edge, "the edge on the left", As::input, Guess::told},
    Field{"right_edge", &SpanBegin::right_edge, Measure::edge, "the edge on the right", As::input, Guess::told},
    Field{"y", &SpanBegin::y, Measure::row, "the scan line", As::subject},
    Field{"first", &SpanBegin::first, Measure::span_end, "the first pixel", As::formula, Guess::formula},
    Field{"last", &SpanBegin::last, Measure::span_end, "the last pixel; smaller than the first when none lies between",
          As::formula, Guess::formula},
    Field{"x_left", &SpanBegin::x_left, "px", "x where the scan line meets the left edge", As::formula, Guess::formula},
    Field{"z_left", &SpanBegin::z_left, "depth", "depth there", As::formula, Guess::formula},
    Field{"x_right", &SpanBegin::x_right, "px", "x where the scan line meets the right edge", As::formula,
          Guess::formula},
    Field{"z_right", &SpanBegin::z_right, "depth", "depth there", As::formula, Guess::formula},
    Field{"dz_dx", &SpanBegin::dz_dx, "depth", "what depth gains from pixel to pixel", As::formula, Guess::formula}};

}  // namespace zstep
