// A vertex on its way from the world to the raster. Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <cstdint>

#include "traces/events/field.hpp"

namespace zstep {

// clang-format off

struct ViewTransform { std::int32_t vertex; double x_v, y_v, z_v; };
struct Projection { std::int32_t vertex; double x_p, y_p, z; };
struct ViewportTransform { std::int32_t vertex; double x_s, y_s; };

// clang-format on

template <>
inline constexpr KindText kind_text<ViewTransform>{"view_transform", "a vertex goes from world to view coordinates"};
template <>
inline constexpr auto fields_of<ViewTransform> =
    Fields{Field{"vertex", &ViewTransform::vertex, "index", "the vertex", Guess::next},
               Field{"x_v", &ViewTransform::x_v, "view", "to the right of the eye", Guess::formula},
               Field{"y_v", &ViewTransform::y_v, "view", "above the eye", Guess::formula},
               Field{"z_v", &ViewTransform::z_v, "view", "away from the eye", Guess::formula}};

template <>
inline constexpr KindText kind_text<Projection>{"projection",
                                                "a vertex goes from view coordinates to the projection plane"};
template <>
inline constexpr auto fields_of<Projection> =
    Fields{Field{"vertex", &Projection::vertex, "index", "the vertex"},
               Field{"x_p", &Projection::x_p, "plane", "x on the projection plane", Guess::formula},
               Field{"y_p", &Projection::y_p, "plane", "y on the projection plane", Guess::formula},
               Field{"z", &Projection::z, "depth", "the depth that will be interpolated", Guess::formula}};

template <>
inline constexpr KindText kind_text<ViewportTransform>{"viewport_transform",
                                                       "a vertex goes from the window to the raster"};
template <>
inline constexpr auto fields_of<ViewportTransform> =
    Fields{Field{"vertex", &ViewportTransform::vertex, "index", "the vertex"},
               Field{"x_s", &ViewportTransform::x_s, "px", "column, pixel centres at integers", Guess::formula},
               Field{"y_s", &ViewportTransform::y_s, "px", "row, pixel centres at integers", Guess::formula}};

}  // namespace zstep
