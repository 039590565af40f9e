// A vertex on its way from the world to the raster. Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <cstdint>

#include "traces/events/description.hpp"
#include "traces/events/field.hpp"

namespace zstep {

// clang-format off

struct ViewTransform { std::int32_t vertex; double x_v, y_v, z_v; };
struct Projection { std::int32_t vertex; double x_p, y_p, z; };
struct ViewportTransform { std::int32_t vertex; double x_s, y_s; };

// clang-format on

template <>
inline constexpr Description description_of<ViewTransform>{.name = "view_transform",
                                                           .meaning = "a vertex goes from world to view coordinates",
                                                           .work = WorkKind::vertices,
                                                           .called = "vertex {vertex}, viewed"};
template <>
inline constexpr auto fields_of<ViewTransform> =
    Fields{Field{"vertex", &ViewTransform::vertex, Measure::vertex, "the vertex", As::subject, Guess::next},
           Field{"x_v", &ViewTransform::x_v, "view", "to the right of the eye", As::formula, Guess::formula},
           Field{"y_v", &ViewTransform::y_v, "view", "above the eye", As::formula, Guess::formula},
           Field{"z_v", &ViewTransform::z_v, "view", "away from the eye", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<Projection>{
    .name = "projection",
    .meaning = "a vertex goes from view coordinates to the projection plane",
    .work = WorkKind::vertices,
    .called = "vertex {vertex}, projected"};
template <>
inline constexpr auto fields_of<Projection> =
    Fields{Field{"vertex", &Projection::vertex, Measure::vertex, "the vertex", As::subject},
           Field{"x_p", &Projection::x_p, "plane", "x on the projection plane", As::formula, Guess::formula},
           Field{"y_p", &Projection::y_p, "plane", "y on the projection plane", As::formula, Guess::formula},
           Field{"z", &Projection::z, "depth", "the depth that will be interpolated", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<ViewportTransform>{.name = "viewport_transform",
                                                               .meaning = "a vertex goes from the window to the raster",
                                                               .work = WorkKind::vertices,
                                                               .called = "vertex {vertex} on the raster"};
template <>
inline constexpr auto fields_of<ViewportTransform> = Fields{
    Field{"vertex", &ViewportTransform::vertex, Measure::vertex, "the vertex", As::subject},
    Field{"x_s", &ViewportTransform::x_s, "px", "column, pixel centres at integers", As::formula, Guess::formula},
    Field{"y_s", &ViewportTransform::y_s, "px", "row, pixel centres at integers", As::formula, Guess::formula}};

}  // namespace zstep
