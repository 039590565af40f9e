// One polygon before it is drawn: facing and clipping. Part of the vocabulary: see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

enum class Facing : std::uint8_t { front, back, edge_on };
enum class ClipPlane : std::uint8_t { near, far, left, right, bottom, top };
enum class Reject : std::uint8_t { back_facing, edge_on, outside, degenerate };

template <>
inline constexpr std::array<std::string_view, 3> words_of<Facing>{"front", "back", "edge_on"};
template <>
inline constexpr std::array<std::string_view, 6> words_of<ClipPlane>{"near", "far", "left", "right", "bottom", "top"};
template <>
inline constexpr std::array<std::string_view, 4> words_of<Reject>{"back_facing", "edge_on", "outside", "degenerate"};

// clang-format off

struct PolygonBegin { std::int32_t polygon, facet; };
struct FacingTest { double determinant, plane_at_eye, view_dot_normal, projected_normal_z; Facing facing; };
struct PolygonReject { std::int32_t polygon; Reject reason; };
struct ClipTest { std::int32_t outside_some, outside_all; };
struct ClipVertex { ClipPlane plane; std::int32_t vertex; double distance; bool inside; };
struct ClipCross { ClipPlane plane; std::int32_t vertex_inside, vertex_outside; double t; std::int32_t vertex; double x_v, y_v, z_v; };
struct OutlineVertex { std::int32_t vertex; };

// clang-format on

template <>
inline constexpr KindText kind_text<PolygonBegin>{"polygon_begin", "work on a polygon begins"};
template <>
inline constexpr auto fields_of<PolygonBegin> =
    Fields{Field{"polygon", &PolygonBegin::polygon, "index", "the polygon, in file order", Guess::told},
               Field{"facet", &PolygonBegin::facet, "index", "the planar piece of it", Guess::told}};

template <>
inline constexpr KindText kind_text<FacingTest>{"facing_test",
                                                "the back-face test, in the four formulations of the notes"};
template <>
inline constexpr auto fields_of<FacingTest> = Fields{
    Field{"determinant", &FacingTest::determinant, "view^3",
          "V0 . (V1 x V2) summed over the fan, in view coordinates; negative faces away", Guess::formula},
    Field{"plane_at_eye", &FacingTest::plane_at_eye, "world^3", "A x + B y + C z + D at the eye; negative faces away",
          Guess::formula},
    Field{"view_dot_normal", &FacingTest::view_dot_normal, "world^3", "(p - e) . n; positive faces away",
          Guess::formula},
    Field{"projected_normal_z", &FacingTest::projected_normal_z, "px^2",
          "z of the normal after projection; positive faces away; NaN with a vertex behind the eye", Guess::formula},
    Field{"facing", &FacingTest::facing, "1", "the verdict", Guess::formula}};

template <>
inline constexpr KindText kind_text<PolygonReject>{"polygon_reject",
                                                   "a polygon is dropped before it reaches the raster"};
template <>
inline constexpr auto fields_of<PolygonReject> =
    Fields{Field{"polygon", &PolygonReject::polygon, "index", "the polygon"},
               Field{"reason", &PolygonReject::reason, "1", "why", Guess::told}};

template <>
inline constexpr KindText kind_text<ClipTest>{"clip_test", "the outcodes of a polygon's vertices, or-ed and and-ed"};
template <>
inline constexpr auto fields_of<ClipTest> = Fields{
    Field{"outside_some", &ClipTest::outside_some, "bits",
          "bit k: some vertex is outside plane k (near, far, left, right, bottom, top)", Guess::formula},
    Field{"outside_all", &ClipTest::outside_all, "bits", "bit k: all vertices are outside plane k", Guess::formula}};

template <>
inline constexpr KindText kind_text<ClipVertex>{"clip_vertex", "a vertex is held against one plane of the view volume"};
template <>
inline constexpr auto fields_of<ClipVertex> = Fields{
    Field{"plane", &ClipVertex::plane, "1", "the plane"}, Field{"vertex", &ClipVertex::vertex, "index", "the vertex"},
    Field{"distance", &ClipVertex::distance, "clip",
          "z_v - near, far - z_v, w_c + x_c and so on; not negative is inside"},
    Field{"inside", &ClipVertex::inside, "1", "kept"}};

template <>
inline constexpr KindText kind_text<ClipCross>{"clip_cross",
                                               "an edge crosses a plane of the view volume and gets a new vertex"};
template <>
inline constexpr auto fields_of<ClipCross> =
    Fields{Field{"plane", &ClipCross::plane, "1", "the plane"},
               Field{"vertex_inside", &ClipCross::vertex_inside, "index", "the end that is kept"},
               Field{"vertex_outside", &ClipCross::vertex_outside, "index", "the end that is cut off"},
               Field{"t", &ClipCross::t, "1", "d_in / (d_in - d_out), from the kept end"},
               Field{"vertex", &ClipCross::vertex, "index", "the new vertex", Guess::next},
               Field{"x_v", &ClipCross::x_v, "view", "its view coordinates"},
               Field{"y_v", &ClipCross::y_v, "view", "its view coordinates"},
               Field{"z_v", &ClipCross::z_v, "view", "its view coordinates"}};

template <>
inline constexpr KindText kind_text<OutlineVertex>{"outline_vertex",
                                                   "a vertex of the polygon as it is drawn, after clipping"};
template <>
inline constexpr auto fields_of<OutlineVertex> =
    Fields{Field{"vertex", &OutlineVertex::vertex, "index", "the vertex", Guess::told}};

}  // namespace zstep
