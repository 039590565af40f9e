// Which fields of an event follow from what was before it, so that a formula gives them, and which are the step's own.
// Every field of every kind has its place in this table, or zstep does not compile (follows.cpp); a formula for a field
// that the table has otherwise does not compile either (Follows); and that each is given is a law (tests/laws).
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "traces/events/slots.hpp"

namespace zstep::formulas {

enum class Origin : std::uint8_t {
  none,      ///< the table does not have it
  formula,   ///< `derive` gives it
  input,     ///< what the step is about, or what the method decided: nothing before says it
  recorded,  ///< the method computes it, and no formula says how yet: it is taken as the trace has it
};

/// Of a kind, by name and with blanks between: fields that a formula gives, inputs, and what is taken as recorded.
struct FollowsOf {
  std::string_view kind, formula, input, recorded;
};

// clang-format off
inline constexpr std::array<FollowsOf, kind_count> follows_of{{
    {"buffers_clear", "z", "", ""},
    {"view_transform", "x_v y_v z_v", "vertex", ""},
    {"projection", "x_p y_p z", "vertex", ""},
    {"viewport_transform", "x_s y_s", "vertex", ""},
    {"polygon_begin", "", "polygon facet", ""},
    {"facing_test", "determinant plane_at_eye view_dot_normal projected_normal_z facing", "", ""},
    {"polygon_reject", "", "polygon reason", ""},
    {"clip_test", "outside_some outside_all", "", ""},
    {"clip_vertex", "distance inside", "plane vertex", ""},
    {"clip_cross", "t x_v y_v z_v", "plane vertex_inside vertex_outside vertex", ""},
    {"outline_vertex", "", "vertex", ""},
    {"edge_table_insert", "polygon first_row end_row x_edge dx_dy z_edge dz_dy", "edge vertex_0 vertex_1", ""},
    {"edge_table_skip", "", "vertex_0 vertex_1 why", ""},
    {"scan_line_begin", "", "y", ""},
    {"edge_enter", "", "edge place", ""},
    {"edge_retire", "", "edge", ""},
    {"edge_step", "x_edge z_edge", "edge", ""},
    {"edge_swap", "", "place", ""},
    {"plane_slopes", "dz_dx dz_dy", "polygon vertex_0 vertex_1 vertex_2", ""},
    {"span_begin", "first last x_left z_left x_right z_right dz_dx", "left_edge right_edge y", ""},
    {"depth_interpolate", "z", "x y", ""},
    {"depth_compare", "z nearer", "x y", ""},
    {"depth_write", "z", "x y", ""},
    {"pixel_write", "polygon", "x y", ""},
    {"attribute_interpolate", "over_z one_over_z attribute", "x y", ""},
    {"pixel_paint", "z polygon", "x y", ""},
    {"color_write", "r8 g8 b8", "x y", ""},
    {"color_blend", "polygon opacity r8 g8 b8", "x y", ""},
    {"pass_begin", "", "pass", ""},
    {"shadow_compare", "x_light y_light z_light lit", "x y", ""},
    {"tables_begin", "", "polygons", ""},
    {"piece_make", "polygon", "piece parent", ""},
    {"plane_equation", "plane_a plane_b plane_c plane_d", "piece", ""},
    {"extent", "x_min x_max y_min y_max z_min z_max", "piece", ""},
    {"plane_depth", "z", "piece x_at y_at", ""},
    {"vertex_side", "value", "vertex plane_of", "side"},
    {"side_test", "least greatest", "piece plane_of", "side"},
    {"extent_test", "low high other_low other_high overlap", "piece other axis", ""},
    {"overlap_test", "", "piece other", "overlap x_at y_at"},
    {"split_vertex", "t x_cut y_cut z_cut", "vertex_0 vertex_1 vertex space", ""},
    {"piece_draw", "polygon", "piece", ""},
    {"saved", "", "coherence tests", ""},
    {"list_insert", "", "piece place", ""},
    {"list_remove", "", "piece", ""},
    {"list_mark", "", "piece", ""},
    {"pair_begin", "", "piece other", ""},
    {"root_candidate", "", "piece", "splits"},
    {"node_make", "", "node parent front piece", ""},
    {"node_add", "", "node piece", ""},
    {"eye_side", "value front", "node", ""},
    {"node_skip", "", "node front", "value"},
    {"flag_flip", "inside", "edge piece", ""},
    {"span_flags", "x_left x_right first last flags", "y", ""},
    {"implied_edge", "x_at z", "piece other", ""},
    {"span_winner", "", "piece", "first last"},
    {"coverage_add", "", "x y owner", "coverage"},
    {"area_begin", "first_column first_row end_column end_row", "area parent", ""},
    {"area_bin", "crossings corners_inside bin", "piece", "by_box"},
    {"area_decide", "", "area", "what piece"},
    {"box_make", "", "box parent", "x_min x_max y_min y_max z_min z_max"},
    {"box_hold", "", "box facet", ""},
    {"grid_make", "", "", "cells_x cells_y cells_z x_min x_max y_min y_max z_min z_max"},
    {"cell_hold", "", "cell_x cell_y cell_z facet", ""},
    {"ray_begin", "x_0 y_0 z_0 dir_x dir_y dir_z", "ray parent role x y", ""},
    {"cell_visit", "t_enter t_leave", "cell_x cell_y cell_z", ""},
    {"box_test", "t_enter t_leave hit", "box", ""},
    {"ray_plane", "numerator denominator t", "facet", ""},
    {"ray_hit", "t x_hit y_hit z_hit inside nearest", "facet", ""},
    {"ray_end", "nearest_facet t tests red green blue", "ray", ""},
    {"curve_begin", "", "curve row across", "constant"},
    {"curve_segment", "", "vertex_0 vertex_1", ""},
    {"horizon_test", "y_curve verdict", "x", ""},
    {"horizon_move", "y_curve", "x upper", ""},
    {"horizon_cross", "x_at y_at", "upper", ""},
    {"line_begin", "", "line vertex_0 vertex_1 left_facet right_facet", "kind"},
    {"line_against", "", "line facet", "outcome"},
    {"line_cross", "t x_at y_at", "line facet in_space", ""},
    {"line_hide", "t_0 t_1", "line facet", ""},
    {"line_piece", "t_0 t_1 visible", "line", ""},
}};
// clang-format on

/// Calls use(word) for each word of a list.
template <class Use>
constexpr void for_each_word(std::string_view list, Use&& use) {
  while (!list.empty()) {
    const std::size_t end = list.find(' ');
    use(list.substr(0, end));
    list = end == list.npos ? std::string_view{} : list.substr(end + 1);
  }
}

/// Where a field of a kind has its value from.
constexpr Origin origin_of(std::uint8_t kind, std::string_view field) {
  const FollowsOf& of = follows_of[kind];
  Origin found = Origin::none;
  const auto look_in = [&](std::string_view list, Origin origin) {
    for_each_word(list, [&](std::string_view word) { found = word == field ? origin : found; });
  };
  look_in(of.formula, Origin::formula), look_in(of.input, Origin::input), look_in(of.recorded, Origin::recorded);
  return found;
}

/// A field for which `derive` has a formula. Naming another one does not compile.
template <class E, class Value>
struct Follows {
  Value E::*member;
  std::string_view name = {};
  std::size_t number = 0;  ///< of the event's fields
  consteval Follows(Value E::*which) : member(which) {  // NOLINT: what is given is a member
    for_each_index<E>([&]<std::size_t I>() {
      if constexpr (std::is_same_v<FieldValue<E, I>, Value>)
        if (field_at<E, I>.member == which) name = field_at<E, I>.name, number = I;
    });
    if (origin_of(kind_of<E>, name) != Origin::formula) throw "the table above has this field otherwise";
  }
};

}  // namespace zstep::formulas
