// Rays, and the boxes that spare them tests.
// Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

enum class RayRole : std::uint8_t { eye, reflected, transmitted, shadow };

template <>
inline constexpr std::array<std::string_view, 4> words_of<RayRole>{"eye", "reflected", "transmitted", "shadow"};

// clang-format off

struct BoxMake { std::int32_t box, parent; double x_min, x_max, y_min, y_max, z_min, z_max; };
struct BoxHold { std::int32_t box, facet; };
struct GridMake { std::int32_t cells_x, cells_y, cells_z; double x_min, x_max, y_min, y_max, z_min, z_max; };
struct CellHold { std::int32_t cell_x, cell_y, cell_z, facet; };
struct RayBegin {
  std::int32_t ray, parent; RayRole role; std::int32_t x, y; double x_0, y_0, z_0, dir_x, dir_y, dir_z;
};
struct CellVisit { std::int32_t cell_x, cell_y, cell_z; double t_enter, t_leave; };
struct BoxTest { std::int32_t box; double t_enter, t_leave; bool hit; };
struct RayPlane { std::int32_t facet; double numerator, denominator, t; };
struct RayHit { std::int32_t facet; double t, x_hit, y_hit, z_hit; bool inside, nearest; };
struct RayEnd { std::int32_t ray, nearest_facet; double t; std::int32_t tests; double red, green, blue; };

// clang-format on

template <>
inline constexpr Description description_of<BoxMake>{
    .name = "box_make",
    .meaning = "a box of a hierarchy of boxes, or the box of one facet",
    .work = WorkKind::planes,
    .called = "box {box}",
    .after_polygons = true};
template <>
inline constexpr auto fields_of<BoxMake> =
    Fields{Field{"box", &BoxMake::box, Measure::box, "the box, numbered in the order in which boxes are made", As::made,
                 Guess::next},
           Field{"parent", &BoxMake::parent, Measure::box, "the box around it, -1 if there is none", As::subject},
           Field{"x_min", &BoxMake::x_min, "world", "its least x", As::recorded | As::ruled},
           Field{"x_max", &BoxMake::x_max, "world", "its greatest x", As::recorded | As::ruled},
           Field{"y_min", &BoxMake::y_min, "world", "its least y", As::recorded | As::ruled},
           Field{"y_max", &BoxMake::y_max, "world", "its greatest y", As::recorded | As::ruled},
           Field{"z_min", &BoxMake::z_min, "world", "its least z", As::recorded | As::ruled},
           Field{"z_max", &BoxMake::z_max, "world", "its greatest z", As::recorded | As::ruled}};

template <>
inline constexpr Description description_of<BoxHold>{
    .name = "box_hold", .meaning = "a facet is in a box, and in no box inside it", .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<BoxHold> =
    Fields{Field{"box", &BoxHold::box, Measure::box, "the box", As::subject},
           Field{"facet", &BoxHold::facet, Measure::facet, "the facet", As::subject}};

template <>
inline constexpr Description description_of<GridMake>{.name = "grid_make",
                                                      .meaning = "space is divided into equal cells",
                                                      .work = WorkKind::planes,
                                                      .after_polygons = true};
template <>
inline constexpr auto fields_of<GridMake> =
    Fields{Field{"cells_x", &GridMake::cells_x, "1", "cells along x", As::recorded | As::ruled},
           Field{"cells_y", &GridMake::cells_y, "1", "cells along y", As::recorded | As::ruled},
           Field{"cells_z", &GridMake::cells_z, "1", "cells along z", As::recorded | As::ruled},
           Field{"x_min", &GridMake::x_min, "world", "least x", As::recorded | As::ruled},
           Field{"x_max", &GridMake::x_max, "world", "greatest x", As::recorded | As::ruled},
           Field{"y_min", &GridMake::y_min, "world", "least y", As::recorded | As::ruled},
           Field{"y_max", &GridMake::y_max, "world", "greatest y", As::recorded | As::ruled},
           Field{"z_min", &GridMake::z_min, "world", "least z", As::recorded | As::ruled},
           Field{"z_max", &GridMake::z_max, "world", "greatest z", As::recorded | As::ruled}};

template <>
inline constexpr Description description_of<CellHold>{
    .name = "cell_hold", .meaning = "a facet meets a cell", .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<CellHold> =
    Fields{Field{"cell_x", &CellHold::cell_x, "index", "the cell along x", As::subject},
           Field{"cell_y", &CellHold::cell_y, "index", "along y", As::subject},
           Field{"cell_z", &CellHold::cell_z, "index", "along z", As::subject},
           Field{"facet", &CellHold::facet, Measure::facet, "the facet", As::subject}};

template <>
inline constexpr Description description_of<RayBegin>{.name = "ray_begin",
                                                      .meaning = "a ray is cast: X = X_0 + t dX",
                                                      .work = WorkKind::planes,
                                                      .called = "{role} ray {ray} of pixel ({x}, {y})",
                                                      .begins = {Unit::pixel, "pixel"},
                                                      .after_polygons = true};
template <>
inline constexpr auto fields_of<RayBegin> = Fields{
    Field{"ray", &RayBegin::ray, Measure::ray, "the ray, numbered in the order of work", As::made, Guess::next},
    Field{"parent", &RayBegin::parent, Measure::ray, "the ray it comes from, -1 for a ray from the eye", As::subject},
    Field{"role", &RayBegin::role, "1", "why it is cast", As::subject},
    Field{"x", &RayBegin::x, Measure::column, "column of the pixel it is cast for", As::subject, Guess::next},
    Field{"y", &RayBegin::y, Measure::pixel_row, "row of that pixel", As::subject},
    Field{"x_0", &RayBegin::x_0, "world", "where t = 0", As::formula},
    Field{"y_0", &RayBegin::y_0, "world", "where t = 0", As::formula},
    Field{"z_0", &RayBegin::z_0, "world", "where t = 0", As::formula},
    Field{"dir_x", &RayBegin::dir_x, "world", "dX", As::formula},
    Field{"dir_y", &RayBegin::dir_y, "world", "dY", As::formula},
    Field{"dir_z", &RayBegin::dir_z, "world", "dZ", As::formula}};

template <>
inline constexpr Description description_of<CellVisit>{.name = "cell_visit",
                                                       .meaning = "the ray enters a cell",
                                                       .work = WorkKind::tests,
                                                       .called = "the ray in cell ({cell_x}, {cell_y}, {cell_z})",
                                                       .within = Within::ray};
template <>
inline constexpr auto fields_of<CellVisit> =
    Fields{Field{"cell_x", &CellVisit::cell_x, "index", "the cell along x", As::subject},
           Field{"cell_y", &CellVisit::cell_y, "index", "along y", As::subject},
           Field{"cell_z", &CellVisit::cell_z, "index", "along z", As::subject},
           Field{"t_enter", &CellVisit::t_enter, "1", "t where it enters", As::formula},
           Field{"t_leave", &CellVisit::t_leave, "1", "t where it leaves", As::formula}};

template <>
inline constexpr Description description_of<BoxTest>{.name = "box_test",
                                                     .meaning = "the ray is held against a box",
                                                     .work = WorkKind::tests,
                                                     .called = "the ray against box {box}",
                                                     .within = Within::ray};
template <>
inline constexpr auto fields_of<BoxTest> =
    Fields{Field{"box", &BoxTest::box, Measure::box, "the box", As::subject},
           Field{"t_enter", &BoxTest::t_enter, "1", "t where it enters the slabs", As::formula},
           Field{"t_leave", &BoxTest::t_leave, "1", "t where it leaves them", As::formula},
           Field{"hit", &BoxTest::hit, "1", "there is something to be found inside", As::formula}};

template <>
inline constexpr Description description_of<RayPlane>{
    .name = "ray_plane",
    .meaning = "the ray meets the plane of a facet: t = -(A X_0 + B Y_0 + C Z_0 + D)/(A dX + B dY + C dZ)",
    .work = WorkKind::tests,
    .called = "the ray against the plane of {facet}",
    .within = Within::ray};
template <>
inline constexpr auto fields_of<RayPlane> =
    Fields{Field{"facet", &RayPlane::facet, Measure::facet, "the facet", As::subject, Guess::next},
           Field{"numerator", &RayPlane::numerator, "1", "-(A X_0 + B Y_0 + C Z_0 + D)", As::formula, Guess::formula},
           Field{"denominator", &RayPlane::denominator, "1", "A dX + B dY + C dZ", As::formula, Guess::formula},
           Field{"t", &RayPlane::t, "1", "t; NaN when the ray runs along the plane", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<RayHit>{
    .name = "ray_hit",
    .meaning = "the point where the ray meets a plane is held against the facet's outline",
    .work = WorkKind::tests,
    .called = "the point on the plane of {facet}",
    .within = Within::ray};
template <>
inline constexpr auto fields_of<RayHit> =
    Fields{Field{"facet", &RayHit::facet, Measure::facet, "the facet", As::subject},
           Field{"t", &RayHit::t, "1", "t", As::formula, Guess::formula},
           Field{"x_hit", &RayHit::x_hit, "world", "the point", As::formula, Guess::formula},
           Field{"y_hit", &RayHit::y_hit, "world", "the point", As::formula, Guess::formula},
           Field{"z_hit", &RayHit::z_hit, "world", "the point", As::formula, Guess::formula},
           Field{"inside", &RayHit::inside, "1", "it lies inside the outline", As::formula},
           Field{"nearest", &RayHit::nearest, "1", "it is nearer than any before", As::formula}};

template <>
inline constexpr Description description_of<RayEnd>{.name = "ray_end",
                                                    .meaning = "all that the ray can meet has been tested",
                                                    .work = WorkKind::bookkeeping,
                                                    .called = "ray {ray} ends"};
template <>
inline constexpr auto fields_of<RayEnd> =
    Fields{Field{"ray", &RayEnd::ray, Measure::ray, "the ray", As::subject},
           Field{"nearest_facet", &RayEnd::nearest_facet, Measure::facet_or_none,
                 "the facet it meets first, -1 if none", As::formula},
           Field{"t", &RayEnd::t, "1", "t there", As::formula},
           Field{"tests", &RayEnd::tests, "1", "facets it was tested against", As::formula},
           Field{"red", &RayEnd::red, "1", "what it brings back, 0 to 1", As::formula},
           Field{"green", &RayEnd::green, "1", "what it brings back", As::formula},
           Field{"blue", &RayEnd::blue, "1", "what it brings back", As::formula}};

}  // namespace zstep
