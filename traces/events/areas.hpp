// Areas of the picture that are quartered.
// Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

enum class Bin : std::uint8_t { disjoint, intersecting, surrounding, contained };
enum class AreaCase : std::uint8_t { background, one_polygon, surrounded, front_surrounder, pixel, subdivide };

template <>
inline constexpr std::array<std::string_view, 4> words_of<Bin>{"disjoint", "intersecting", "surrounding", "contained"};
template <>
inline constexpr std::array<std::string_view, 6> words_of<AreaCase>{"background",       "one_polygon", "surrounded",
                                                                    "front_surrounder", "pixel",       "subdivide"};

// clang-format off

struct AreaBegin { std::int32_t area, parent, first_column, first_row, end_column, end_row; };
struct AreaBin { std::int32_t piece, crossings, corners_inside; Bin bin; bool by_box; };
struct AreaDecide { std::int32_t area; AreaCase what; std::int32_t piece; };

// clang-format on

template <>
inline constexpr Description description_of<AreaBegin>{.name = "area_begin",
                                                       .meaning = "work on an area of the picture begins",
                                                       .work = WorkKind::bookkeeping,
                                                       .called = "area {area}",
                                                       .begins = {Unit::scan_line, "area"},
                                                       .after_polygons = true};
template <>
inline constexpr auto fields_of<AreaBegin> = Fields{
    Field{"area", &AreaBegin::area, Measure::area, "the area, numbered in the order of work", As::made, Guess::next},
    Field{"parent", &AreaBegin::parent, Measure::area, "the area it is a quarter of, -1 for the whole picture",
          As::input},
    Field{"first_column", &AreaBegin::first_column, Measure::column_or_end, "its first column",
          As::formula | As::subject},
    Field{"first_row", &AreaBegin::first_row, Measure::row_or_end, "its first row", As::formula | As::subject},
    Field{"end_column", &AreaBegin::end_column, Measure::column_or_end, "the column just beyond it",
          As::formula | As::subject},
    Field{"end_row", &AreaBegin::end_row, Measure::row_or_end, "the row just beyond it", As::formula | As::subject}};

template <>
inline constexpr Description description_of<AreaBin>{.name = "area_bin",
                                                     .meaning = "a polygon is put into one of the four bins of an area",
                                                     .work = WorkKind::tests,
                                                     .within = Within::area};
template <>
inline constexpr auto fields_of<AreaBin> = Fields{
    Field{"piece", &AreaBin::piece, Measure::piece, "the polygon's piece", As::subject, Guess::told},
    Field{"crossings", &AreaBin::crossings, "1", "edges of the polygon that meet the area; -1 when the box decided",
          As::formula, Guess::formula},
    Field{"corners_inside", &AreaBin::corners_inside, "1",
          "corners of the area inside the polygon; -1 when the box decided", As::formula, Guess::formula},
    Field{"bin", &AreaBin::bin, "1", "the bin", As::formula, Guess::formula},
    Field{"by_box", &AreaBin::by_box, "1", "the bounding box decided", As::recorded | As::ruled, Guess::formula}};

template <>
inline constexpr Description description_of<AreaDecide>{.name = "area_decide",
                                                        .meaning = "what is done with an area",
                                                        .work = WorkKind::tests,
                                                        .gives_around = "in the area around it"};
template <>
inline constexpr auto fields_of<AreaDecide> = Fields{
    Field{"area", &AreaDecide::area, Measure::area, "the area", As::subject},
    Field{"what", &AreaDecide::what, "1", "the case", As::recorded},
    Field{"piece", &AreaDecide::piece, Measure::piece, "the piece that fills it, -1 if none does", As::recorded}};

}  // namespace zstep
