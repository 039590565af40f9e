// The vocabulary of traces: every kind of event that a run can leave behind.
//
// One vocabulary serves all methods, so that one pixel can be followed through all of them. An event carries the
// operands of its computation and the result; what a replay already knows at that point (the stored depth before a
// compare, a vertex's world coordinates) is not stored again. A new kind needs two methods that use it, or proof that
// none of these says it (docs/adding-an-algorithm.md).
//
// "depth" as a unit means the buffer's own numbers: pseudodepth, z_v or the scene's z, as the trace's conventions say.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <variant>

#include "traces/events/field.hpp"

namespace zstep {

enum class Facing : std::uint8_t { front, back, edge_on };
enum class ClipPlane : std::uint8_t { near, far, left, right, bottom, top };
enum class Reject : std::uint8_t { back_facing, edge_on, outside, degenerate };
enum class EdgeSkip : std::uint8_t { horizontal, between_rows };

template <>
inline constexpr std::array<std::string_view, 3> words_of<Facing>{"front", "back", "edge_on"};
template <>
inline constexpr std::array<std::string_view, 6> words_of<ClipPlane>{"near", "far", "left", "right", "bottom", "top"};
template <>
inline constexpr std::array<std::string_view, 4> words_of<Reject>{"back_facing", "edge_on", "outside", "degenerate"};
template <>
inline constexpr std::array<std::string_view, 2> words_of<EdgeSkip>{"horizontal", "between_rows"};

// One line a kind.
// clang-format off

// --- The buffers and the vertices

struct BuffersClear { double z; };
struct ViewTransform { std::int32_t vertex; double x_v, y_v, z_v; };
struct Projection { std::int32_t vertex; double x_p, y_p, z; };
struct ViewportTransform { std::int32_t vertex; double x_s, y_s; };

// --- One polygon: facing and clipping

struct PolygonBegin { std::int32_t polygon, facet; };
struct FacingTest { double determinant, plane_at_eye, view_dot_normal, projected_normal_z; Facing facing; };
struct PolygonReject { std::int32_t polygon; Reject reason; };
struct ClipTest { std::int32_t outside_some, outside_all; };
struct ClipVertex { ClipPlane plane; std::int32_t vertex; double distance; bool inside; };
struct ClipCross { ClipPlane plane; std::int32_t vertex_inside, vertex_outside; double t; std::int32_t vertex; double x_v, y_v, z_v; };
struct OutlineVertex { std::int32_t vertex; };

// --- Scan conversion: edge table, active edges, spans

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
struct SpanBegin {
  std::int32_t left_edge, right_edge, y, first, last;
  double x_left, z_left, x_right, z_right, dz_dx;
};

// --- Pixels

struct DepthInterpolate { std::int32_t x, y; double z; };
struct DepthCompare { std::int32_t x, y; double z; bool nearer; };
struct DepthWrite { std::int32_t x, y; double z; };
struct PixelWrite { std::int32_t x, y, polygon; };

// clang-format on

// --- Descriptions

template <>
inline constexpr KindText kind_text<BuffersClear>{"buffers_clear",
                                                  "the frame becomes background, every depth becomes z"};
template <>
inline constexpr auto fields_of<BuffersClear> =
    std::tuple{Field{"z", &BuffersClear::z, "depth", "the depth that means nothing was drawn"}};

template <>
inline constexpr KindText kind_text<ViewTransform>{"view_transform", "a vertex goes from world to viewing coordinates"};
template <>
inline constexpr auto fields_of<ViewTransform> =
    std::tuple{Field{"vertex", &ViewTransform::vertex, "index", "the vertex", Guess::next},
               Field{"x_v", &ViewTransform::x_v, "view", "to the right of the eye"},
               Field{"y_v", &ViewTransform::y_v, "view", "above the eye"},
               Field{"z_v", &ViewTransform::z_v, "view", "away from the eye"}};

template <>
inline constexpr KindText kind_text<Projection>{"projection",
                                                "a vertex goes from viewing coordinates to the projection plane"};
template <>
inline constexpr auto fields_of<Projection> =
    std::tuple{Field{"vertex", &Projection::vertex, "index", "the vertex"},
               Field{"x_p", &Projection::x_p, "plane", "x on the projection plane"},
               Field{"y_p", &Projection::y_p, "plane", "y on the projection plane"},
               Field{"z", &Projection::z, "depth", "the depth that will be interpolated"}};

template <>
inline constexpr KindText kind_text<ViewportTransform>{"viewport_transform",
                                                       "a vertex goes from the window to the raster"};
template <>
inline constexpr auto fields_of<ViewportTransform> =
    std::tuple{Field{"vertex", &ViewportTransform::vertex, "index", "the vertex"},
               Field{"x_s", &ViewportTransform::x_s, "px", "column, pixel centres at integers"},
               Field{"y_s", &ViewportTransform::y_s, "px", "row, pixel centres at integers"}};

template <>
inline constexpr KindText kind_text<PolygonBegin>{"polygon_begin", "work on a polygon begins"};
template <>
inline constexpr auto fields_of<PolygonBegin> =
    std::tuple{Field{"polygon", &PolygonBegin::polygon, "index", "the polygon, in file order"},
               Field{"facet", &PolygonBegin::facet, "index", "the planar piece of it", Guess::next}};

template <>
inline constexpr KindText kind_text<FacingTest>{"facing_test",
                                                "the back-face test, in the four formulations of the notes"};
template <>
inline constexpr auto fields_of<FacingTest> = std::tuple{
    Field{"determinant", &FacingTest::determinant, "view^3",
          "V0 . (V1 x V2) summed over the fan, in viewing coordinates; negative faces away"},
    Field{"plane_at_eye", &FacingTest::plane_at_eye, "world^3", "A x + B y + C z + D at the eye; negative faces away"},
    Field{"view_dot_normal", &FacingTest::view_dot_normal, "world^3", "(p - e) . n; positive faces away"},
    Field{"projected_normal_z", &FacingTest::projected_normal_z, "px^2",
          "z of the normal after projection; positive faces away; NaN with a vertex behind the eye"},
    Field{"facing", &FacingTest::facing, "1", "the verdict"}};

template <>
inline constexpr KindText kind_text<PolygonReject>{"polygon_reject",
                                                   "a polygon is dropped before it reaches the raster"};
template <>
inline constexpr auto fields_of<PolygonReject> =
    std::tuple{Field{"polygon", &PolygonReject::polygon, "index", "the polygon"},
               Field{"reason", &PolygonReject::reason, "1", "why"}};

template <>
inline constexpr KindText kind_text<ClipTest>{"clip_test", "the outcodes of a polygon's vertices, or-ed and and-ed"};
template <>
inline constexpr auto fields_of<ClipTest> =
    std::tuple{Field{"outside_some", &ClipTest::outside_some, "bits",
                     "bit k: some vertex is outside plane k (near, far, left, right, bottom, top)"},
               Field{"outside_all", &ClipTest::outside_all, "bits", "bit k: all vertices are outside plane k"}};

template <>
inline constexpr KindText kind_text<ClipVertex>{"clip_vertex", "a vertex is held against one plane of the view volume"};
template <>
inline constexpr auto fields_of<ClipVertex> = std::tuple{
    Field{"plane", &ClipVertex::plane, "1", "the plane"}, Field{"vertex", &ClipVertex::vertex, "index", "the vertex"},
    Field{"distance", &ClipVertex::distance, "clip",
          "z_v - near, far - z_v, w_c + x_c and so on; not negative is inside"},
    Field{"inside", &ClipVertex::inside, "1", "kept"}};

template <>
inline constexpr KindText kind_text<ClipCross>{"clip_cross",
                                               "an edge crosses a plane of the view volume and gets a new vertex"};
template <>
inline constexpr auto fields_of<ClipCross> =
    std::tuple{Field{"plane", &ClipCross::plane, "1", "the plane"},
               Field{"vertex_inside", &ClipCross::vertex_inside, "index", "the end that is kept"},
               Field{"vertex_outside", &ClipCross::vertex_outside, "index", "the end that is cut off"},
               Field{"t", &ClipCross::t, "1", "d_in / (d_in - d_out), from the kept end"},
               Field{"vertex", &ClipCross::vertex, "index", "the new vertex", Guess::next},
               Field{"x_v", &ClipCross::x_v, "view", "its viewing coordinates"},
               Field{"y_v", &ClipCross::y_v, "view", "its viewing coordinates"},
               Field{"z_v", &ClipCross::z_v, "view", "its viewing coordinates"}};

template <>
inline constexpr KindText kind_text<OutlineVertex>{"outline_vertex",
                                                   "a vertex of the polygon as it is drawn, after clipping"};
template <>
inline constexpr auto fields_of<OutlineVertex> =
    std::tuple{Field{"vertex", &OutlineVertex::vertex, "index", "the vertex", Guess::next}};

template <>
inline constexpr KindText kind_text<EdgeTableInsert>{"edge_table_insert",
                                                     "an edge goes into the bucket of its first scan line"};
template <>
inline constexpr auto fields_of<EdgeTableInsert> =
    std::tuple{Field{"edge", &EdgeTableInsert::edge, "index", "the edge, numbered in order of insertion", Guess::next},
               Field{"polygon", &EdgeTableInsert::polygon, "index", "the polygon it bounds"},
               Field{"vertex_0", &EdgeTableInsert::vertex_0, "index", "its end with the smaller y"},
               Field{"vertex_1", &EdgeTableInsert::vertex_1, "index", "its end with the larger y"},
               Field{"first_row", &EdgeTableInsert::first_row, "row", "the first scan line it meets: its bucket"},
               Field{"end_row", &EdgeTableInsert::end_row, "row", "the scan line at which it leaves"},
               Field{"x_edge", &EdgeTableInsert::x_edge, "px", "x on the first scan line"},
               Field{"dx_dy", &EdgeTableInsert::dx_dy, "px", "1/m: what x gains from line to line"},
               Field{"z_edge", &EdgeTableInsert::z_edge, "depth", "depth on the first scan line"},
               Field{"dz_dy", &EdgeTableInsert::dz_dy, "depth", "what depth gains from line to line"}};

template <>
inline constexpr KindText kind_text<EdgeTableSkip>{"edge_table_skip",
                                                   "an edge meets no scan line and stays out of the table"};
template <>
inline constexpr auto fields_of<EdgeTableSkip> =
    std::tuple{Field{"vertex_0", &EdgeTableSkip::vertex_0, "index", "one end"},
               Field{"vertex_1", &EdgeTableSkip::vertex_1, "index", "the other end"},
               Field{"why", &EdgeTableSkip::why, "1", "horizontal, or too short to meet a scan line"}};

template <>
inline constexpr KindText kind_text<ScanLineBegin>{"scan_line_begin", "work on a scan line begins"};
template <>
inline constexpr auto fields_of<ScanLineBegin> =
    std::tuple{Field{"y", &ScanLineBegin::y, "row", "the scan line", Guess::next}};

template <>
inline constexpr KindText kind_text<EdgeEnter>{"edge_enter",
                                               "an edge moves from the edge table to the active edge list"};
template <>
inline constexpr auto fields_of<EdgeEnter> =
    std::tuple{Field{"edge", &EdgeEnter::edge, "index", "the edge"},
               Field{"place", &EdgeEnter::place, "index", "its place in the list, from the left, from 0"}};

template <>
inline constexpr KindText kind_text<EdgeRetire>{"edge_retire", "an edge that ends leaves the active edge list"};
template <>
inline constexpr auto fields_of<EdgeRetire> = std::tuple{Field{"edge", &EdgeRetire::edge, "index", "the edge"}};

template <>
inline constexpr KindText kind_text<EdgeStep>{"edge_step", "an active edge moves to the next scan line"};
template <>
inline constexpr auto fields_of<EdgeStep> = std::tuple{Field{"edge", &EdgeStep::edge, "index", "the edge", Guess::next},
                                                       Field{"x_edge", &EdgeStep::x_edge, "px", "its x there"},
                                                       Field{"z_edge", &EdgeStep::z_edge, "depth", "its depth there"}};

template <>
inline constexpr KindText kind_text<EdgeSwap>{"edge_swap", "two neighbours in the active edge list change places"};
template <>
inline constexpr auto fields_of<EdgeSwap> =
    std::tuple{Field{"place", &EdgeSwap::place, "index", "the left one of the two places"}};

template <>
inline constexpr KindText kind_text<SpanBegin>{"span_begin", "the pixels between two active edges"};
template <>
inline constexpr auto fields_of<SpanBegin> =
    std::tuple{Field{"left_edge", &SpanBegin::left_edge, "index", "the edge on the left"},
               Field{"right_edge", &SpanBegin::right_edge, "index", "the edge on the right"},
               Field{"y", &SpanBegin::y, "row", "the scan line"},
               Field{"first", &SpanBegin::first, "px", "the first pixel"},
               Field{"last", &SpanBegin::last, "px", "the last pixel; smaller than the first when none lies between"},
               Field{"x_left", &SpanBegin::x_left, "px", "x where the scan line meets the left edge"},
               Field{"z_left", &SpanBegin::z_left, "depth", "depth there"},
               Field{"x_right", &SpanBegin::x_right, "px", "x where the scan line meets the right edge"},
               Field{"z_right", &SpanBegin::z_right, "depth", "depth there"},
               Field{"dz_dx", &SpanBegin::dz_dx, "depth", "what depth gains from pixel to pixel"}};

template <>
inline constexpr KindText kind_text<DepthInterpolate>{"depth_interpolate", "the polygon's depth at a pixel"};
template <>
inline constexpr auto fields_of<DepthInterpolate> = std::tuple{
    Field{"x", &DepthInterpolate::x, "px", "column", Guess::next}, Field{"y", &DepthInterpolate::y, "px", "row"},
    Field{"z", &DepthInterpolate::z, "depth", "depth of the polygon at the pixel's centre", Guess::on_span}};

template <>
inline constexpr KindText kind_text<DepthCompare>{"depth_compare", "a new depth is held against the stored one"};
template <>
inline constexpr auto fields_of<DepthCompare> =
    std::tuple{Field{"x", &DepthCompare::x, "px", "column"}, Field{"y", &DepthCompare::y, "px", "row"},
               Field{"z", &DepthCompare::z, "depth", "the new depth"},
               Field{"nearer", &DepthCompare::nearer, "1", "it is strictly smaller than the stored one"}};

template <>
inline constexpr KindText kind_text<DepthWrite>{"depth_write", "the depth buffer takes a depth"};
template <>
inline constexpr auto fields_of<DepthWrite> =
    std::tuple{Field{"x", &DepthWrite::x, "px", "column"}, Field{"y", &DepthWrite::y, "px", "row"},
               Field{"z", &DepthWrite::z, "depth", "the depth stored"}};

template <>
inline constexpr KindText kind_text<PixelWrite>{"pixel_write", "the framebuffer takes a polygon's colour"};
template <>
inline constexpr auto fields_of<PixelWrite> =
    std::tuple{Field{"x", &PixelWrite::x, "px", "column"}, Field{"y", &PixelWrite::y, "px", "row"},
               Field{"polygon", &PixelWrite::polygon, "index", "the polygon whose colour is stored"}};

// --- All of them

/// Any one event. The index of the alternative is the kind's number inside this program; files know kinds by name.
using Event = std::variant<BuffersClear, ViewTransform, Projection, ViewportTransform, PolygonBegin, FacingTest,
                           PolygonReject, ClipTest, ClipVertex, ClipCross, OutlineVertex, EdgeTableInsert,
                           EdgeTableSkip, ScanLineBegin, EdgeEnter, EdgeRetire, EdgeStep, EdgeSwap, SpanBegin,
                           DepthInterpolate, DepthCompare, DepthWrite, PixelWrite>;

inline constexpr std::size_t kind_count = std::variant_size_v<Event>;

namespace detail {
template <class E, std::size_t I = 0>
constexpr std::size_t index_in_vocabulary() {
  if constexpr (std::is_same_v<E, std::variant_alternative_t<I, Event>>) return I;
  else return index_in_vocabulary<E, I + 1>();
}
}  // namespace detail

/// The number of an event's kind: its index in Event.
template <class E>
inline constexpr std::uint8_t kind_of = static_cast<std::uint8_t>(detail::index_in_vocabulary<E>());

/// Calls `function.template operator()<E>()` for every kind of event, in order.
template <class Function>
constexpr void for_each_kind(Function&& function) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (function.template operator()<std::variant_alternative_t<I, Event>>(), ...);
  }
  (std::make_index_sequence<kind_count>{});
}

}  // namespace zstep
