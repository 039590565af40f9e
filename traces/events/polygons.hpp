// One polygon before it is drawn: its vertices on their way to the raster, facing and clipping. Part of the vocabulary:
// see vocabulary.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "traces/events/field.hpp"

namespace zstep {

// A vertex on its way from the world to the raster. Part of the vocabulary: see vocabulary.hpp.

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
struct ClipCross {
  ClipPlane plane; std::int32_t vertex_inside, vertex_outside; double t; std::int32_t vertex; double x_v, y_v, z_v;
};
struct OutlineVertex { std::int32_t vertex; };

// clang-format on

template <>
inline constexpr Description description_of<PolygonBegin>{.name = "polygon_begin",
                                                          .meaning = "work on a polygon begins",
                                                          .work = WorkKind::bookkeeping,
                                                          .begins = {Unit::polygon, "polygon"}};
template <>
inline constexpr auto fields_of<PolygonBegin> = Fields{
    Field{"polygon", &PolygonBegin::polygon, Measure::polygon, "the polygon, in file order", As::subject, Guess::told},
    Field{"facet", &PolygonBegin::facet, Measure::facet, "the planar piece of it", As::aside, Guess::told}};

template <>
inline constexpr Description description_of<FacingTest>{
    .name = "facing_test",
    .meaning = "the back-face test, in the four formulations of the notes",
    .work = WorkKind::tests,
    .within = Within::polygon};
template <>
inline constexpr auto fields_of<FacingTest> = Fields{
    Field{"determinant", &FacingTest::determinant, "view^3",
          "V0 . (V1 x V2) summed over the fan, in view coordinates; negative faces away", As::formula, Guess::formula},
    Field{"plane_at_eye", &FacingTest::plane_at_eye, "world^3", "A x + B y + C z + D at the eye; negative faces away",
          As::formula, Guess::formula},
    Field{"view_dot_normal", &FacingTest::view_dot_normal, "world^3", "(p - e) . n; positive faces away", As::formula,
          Guess::formula},
    Field{"projected_normal_z", &FacingTest::projected_normal_z, "px^2",
          "z of the normal after projection; positive faces away, or negative where rows go up; NaN with a vertex "
          "behind the eye",
          As::formula, Guess::formula},
    Field{"facing", &FacingTest::facing, "1", "the verdict", As::formula, Guess::formula}};

template <>
inline constexpr Description description_of<PolygonReject>{
    .name = "polygon_reject",
    .meaning = "a polygon is dropped before it reaches the raster",
    .work = WorkKind::bookkeeping};
template <>
inline constexpr auto fields_of<PolygonReject> =
    Fields{Field{"polygon", &PolygonReject::polygon, Measure::polygon, "the polygon", As::subject},
           Field{"reason", &PolygonReject::reason, "1", "why", As::input, Guess::told}};

template <>
inline constexpr Description description_of<ClipTest>{
    .name = "clip_test",
    .meaning = "the outcodes of a polygon's vertices, or-ed and and-ed",
    .work = WorkKind::tests,
    .within = Within::polygon};
template <>
inline constexpr auto fields_of<ClipTest> = Fields{
    Field{"outside_some", &ClipTest::outside_some, "bits",
          "bit k: some vertex is outside plane k (near, far, left, right, bottom, top)", As::formula, Guess::formula},
    Field{"outside_all", &ClipTest::outside_all, "bits", "bit k: all vertices are outside plane k", As::formula,
          Guess::formula}};

template <>
inline constexpr Description description_of<ClipVertex>{
    .name = "clip_vertex",
    .meaning = "a vertex is held against one plane of the view volume",
    .work = WorkKind::tests,
    .within = Within::polygon};
template <>
inline constexpr auto fields_of<ClipVertex> =
    Fields{Field{"plane", &ClipVertex::plane, "1", "the plane", As::subject},
           Field{"vertex", &ClipVertex::vertex, Measure::vertex, "the vertex", As::subject},
           Field{"distance", &ClipVertex::distance, "clip",
                 "z_v - near, far - z_v, w_c + x_c and so on; not negative is inside", As::formula},
           Field{"inside", &ClipVertex::inside, "1", "kept", As::formula}};

template <>
inline constexpr Description description_of<ClipCross>{
    .name = "clip_cross",
    .meaning = "an edge crosses a plane of the view volume and gets a new vertex",
    .work = WorkKind::cuts,
    .called = "vertex {vertex}, made where the edge from {vertex_inside} to {vertex_outside} is clipped",
    .within = Within::polygon};
template <>
inline constexpr auto fields_of<ClipCross> =
    Fields{Field{"plane", &ClipCross::plane, "1", "the plane", As::subject},
           Field{"vertex_inside", &ClipCross::vertex_inside, Measure::vertex, "the end that is kept", As::subject},
           Field{"vertex_outside", &ClipCross::vertex_outside, Measure::vertex, "the end that is cut off", As::subject},
           Field{"t", &ClipCross::t, "1", "d_in / (d_in - d_out), from the kept end", As::formula},
           Field{"vertex", &ClipCross::vertex, Measure::vertex, "the new vertex", As::made, Guess::next},
           Field{"x_v", &ClipCross::x_v, "view", "its view coordinates", As::formula},
           Field{"y_v", &ClipCross::y_v, "view", "its view coordinates", As::formula},
           Field{"z_v", &ClipCross::z_v, "view", "its view coordinates", As::formula}};

template <>
inline constexpr Description description_of<OutlineVertex>{
    .name = "outline_vertex",
    .meaning = "a vertex of the polygon as it is drawn, after clipping",
    .work = WorkKind::bookkeeping,
    .within = Within::polygon};
template <>
inline constexpr auto fields_of<OutlineVertex> =
    Fields{Field{"vertex", &OutlineVertex::vertex, Measure::vertex, "the vertex", As::subject, Guess::told}};

}  // namespace zstep
