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
struct RayBegin { std::int32_t ray, parent; RayRole role; std::int32_t x, y; double x_0, y_0, z_0, dir_x, dir_y, dir_z; };
struct CellVisit { std::int32_t cell_x, cell_y, cell_z; double t_enter, t_leave; };
struct BoxTest { std::int32_t box; double t_enter, t_leave; bool hit; };
struct RayPlane { std::int32_t facet; double numerator, denominator, t; };
struct RayHit { std::int32_t facet; double t, x_hit, y_hit, z_hit; bool inside, nearest; };
struct RayEnd { std::int32_t ray, nearest_facet; double t; std::int32_t tests; double red, green, blue; };

// clang-format on

template <>
inline constexpr KindText kind_text<BoxMake>{"box_make", "a box of a hierarchy of boxes, or the box of one facet"};
template <>
inline constexpr auto fields_of<BoxMake> = Fields{
    Field{"box", &BoxMake::box, "index", "the box, numbered in the order in which boxes are made", Guess::next},
    Field{"parent", &BoxMake::parent, "index", "the box around it, -1 if there is none"},
    Field{"x_min", &BoxMake::x_min, "world", "its least x"},
    Field{"x_max", &BoxMake::x_max, "world", "its greatest x"},
    Field{"y_min", &BoxMake::y_min, "world", "its least y"},
    Field{"y_max", &BoxMake::y_max, "world", "its greatest y"},
    Field{"z_min", &BoxMake::z_min, "world", "its least z"},
    Field{"z_max", &BoxMake::z_max, "world", "its greatest z"}};

template <>
inline constexpr KindText kind_text<BoxHold>{"box_hold", "a facet is in a box, and in no box inside it"};
template <>
inline constexpr auto fields_of<BoxHold> =
    Fields{Field{"box", &BoxHold::box, "index", "the box"}, Field{"facet", &BoxHold::facet, "index", "the facet"}};

template <>
inline constexpr KindText kind_text<GridMake>{"grid_make", "space is divided into equal cells"};
template <>
inline constexpr auto fields_of<GridMake> = Fields{Field{"cells_x", &GridMake::cells_x, "1", "cells along x"},
                                                       Field{"cells_y", &GridMake::cells_y, "1", "cells along y"},
                                                       Field{"cells_z", &GridMake::cells_z, "1", "cells along z"},
                                                       Field{"x_min", &GridMake::x_min, "world", "least x"},
                                                       Field{"x_max", &GridMake::x_max, "world", "greatest x"},
                                                       Field{"y_min", &GridMake::y_min, "world", "least y"},
                                                       Field{"y_max", &GridMake::y_max, "world", "greatest y"},
                                                       Field{"z_min", &GridMake::z_min, "world", "least z"},
                                                       Field{"z_max", &GridMake::z_max, "world", "greatest z"}};

template <>
inline constexpr KindText kind_text<CellHold>{"cell_hold", "a facet meets a cell"};
template <>
inline constexpr auto fields_of<CellHold> = Fields{Field{"cell_x", &CellHold::cell_x, "index", "the cell along x"},
                                                       Field{"cell_y", &CellHold::cell_y, "index", "along y"},
                                                       Field{"cell_z", &CellHold::cell_z, "index", "along z"},
                                                       Field{"facet", &CellHold::facet, "index", "the facet"}};

template <>
inline constexpr KindText kind_text<RayBegin>{"ray_begin", "a ray is cast: X = X_0 + t dX"};
template <>
inline constexpr auto fields_of<RayBegin> =
    Fields{Field{"ray", &RayBegin::ray, "index", "the ray, numbered in the order of work", Guess::next},
               Field{"parent", &RayBegin::parent, "index", "the ray it comes from, -1 for a ray from the eye"},
               Field{"role", &RayBegin::role, "1", "why it is cast"},
               Field{"x", &RayBegin::x, "px", "column of the pixel it is cast for", Guess::next},
               Field{"y", &RayBegin::y, "px", "row of that pixel"},
               Field{"x_0", &RayBegin::x_0, "world", "where t = 0"},
               Field{"y_0", &RayBegin::y_0, "world", "where t = 0"},
               Field{"z_0", &RayBegin::z_0, "world", "where t = 0"},
               Field{"dir_x", &RayBegin::dir_x, "world", "dX"},
               Field{"dir_y", &RayBegin::dir_y, "world", "dY"},
               Field{"dir_z", &RayBegin::dir_z, "world", "dZ"}};

template <>
inline constexpr KindText kind_text<CellVisit>{"cell_visit", "the ray enters a cell"};
template <>
inline constexpr auto fields_of<CellVisit> = Fields{
    Field{"cell_x", &CellVisit::cell_x, "index", "the cell along x"},
    Field{"cell_y", &CellVisit::cell_y, "index", "along y"}, Field{"cell_z", &CellVisit::cell_z, "index", "along z"},
    Field{"t_enter", &CellVisit::t_enter, "1", "t where it enters"},
    Field{"t_leave", &CellVisit::t_leave, "1", "t where it leaves"}};

template <>
inline constexpr KindText kind_text<BoxTest>{"box_test", "the ray is held against a box"};
template <>
inline constexpr auto fields_of<BoxTest> =
    Fields{Field{"box", &BoxTest::box, "index", "the box"},
               Field{"t_enter", &BoxTest::t_enter, "1", "t where it enters the slabs"},
               Field{"t_leave", &BoxTest::t_leave, "1", "t where it leaves them"},
               Field{"hit", &BoxTest::hit, "1", "there is something to be found inside"}};

template <>
inline constexpr KindText kind_text<RayPlane>{
    "ray_plane", "the ray meets the plane of a facet: t = -(A X_0 + B Y_0 + C Z_0 + D)/(A dX + B dY + C dZ)"};
template <>
inline constexpr auto fields_of<RayPlane> =
    Fields{Field{"facet", &RayPlane::facet, "index", "the facet", Guess::next},
               Field{"numerator", &RayPlane::numerator, "1", "-(A X_0 + B Y_0 + C Z_0 + D)", Guess::formula},
               Field{"denominator", &RayPlane::denominator, "1", "A dX + B dY + C dZ", Guess::formula},
               Field{"t", &RayPlane::t, "1", "t; NaN when the ray runs along the plane", Guess::formula}};

template <>
inline constexpr KindText kind_text<RayHit>{
    "ray_hit", "the point where the ray meets a plane is held against the facet's outline"};
template <>
inline constexpr auto fields_of<RayHit> =
    Fields{Field{"facet", &RayHit::facet, "index", "the facet"},
               Field{"t", &RayHit::t, "1", "t", Guess::formula},
               Field{"x_hit", &RayHit::x_hit, "world", "the point", Guess::formula},
               Field{"y_hit", &RayHit::y_hit, "world", "the point", Guess::formula},
               Field{"z_hit", &RayHit::z_hit, "world", "the point", Guess::formula},
               Field{"inside", &RayHit::inside, "1", "it lies inside the outline"},
               Field{"nearest", &RayHit::nearest, "1", "it is nearer than any before"}};

template <>
inline constexpr KindText kind_text<RayEnd>{"ray_end", "all that the ray can meet has been tested"};
template <>
inline constexpr auto fields_of<RayEnd> =
    Fields{Field{"ray", &RayEnd::ray, "index", "the ray"},
               Field{"nearest_facet", &RayEnd::nearest_facet, "index", "the facet it meets first, -1 if none"},
               Field{"t", &RayEnd::t, "1", "t there"},
               Field{"tests", &RayEnd::tests, "1", "facets it was tested against"},
               Field{"red", &RayEnd::red, "1", "what it brings back, 0 to 1"},
               Field{"green", &RayEnd::green, "1", "what it brings back"},
               Field{"blue", &RayEnd::blue, "1", "what it brings back"}};

}  // namespace zstep
