// The mistakes that programs of this field are known to make: each has a name, a question that leads to it, and the
// place in a lesson that is about it. What each of them does to a step stands in the files beside it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "traces/enumeration.hpp"

namespace zstep::mistakes {

enum class Mistake : std::uint8_t {
  // Vertices and polygons.
  depth_axis_reversed,
  no_divide,
  divide_twice,
  z_v_for_depth,
  not_clipped_near,
  y_upside_down,
  centres_half_off,
  clockwise_front,
  // The edge table.
  horizontal_inserted,
  ends_one_late,
  starts_one_early,
  slope_inverted,
  slope_whole,
  z_slope_of_x,
  z_not_swapped,
  x_at_vertex,
  z_at_vertex,
  // Active edges.
  stepped_too_early,
  stepped_twice,
  rounded_then_stepped,
  z_not_carried,
  retired_one_late,
  never_retired,
  not_sorted,
  // Spans.
  right_end_included,
  left_end_excluded,
  ends_rounded,
  ends_truncated,
  z_by_slope_of_x,
  z_by_slope_of_edge,
  z_not_to_centre,
  z_stepped_before_use,
  z_kept_along_span,
  adds_in_float32,
  // Pixels.
  compare_reversed,
  equal_wins,
  buffer_begins_at_0,
  buffer_reset,
  buffer_of_one_line,
  written_before_test,
  depth_not_written,
  depth_always,
  colour_not_written,
  colour_always,
  x_y_exchanged,
  // Triangles that are drawn by their edge functions and weights, and whatever shows in pixels alone.
  picture_mirrored,
  one_pixel_off,
  vertices_rounded,
  vertices_truncated,
  window_taken_for_square,
  one_winding_only,
  border_for_nobody,
  border_for_both,
  border_for_other_side,
  edge_not_asked,
  box_too_small,
  inside_margin,
  area_not_doubled,
  area_not_divided_by,
  weights_exchanged,
  weights_turned,
  weight_negative,
  weight_left_out,
  vertex_depth_twice,
  depth_of_one_vertex,
  depth_is_mean,
  depth_truncated,
  depth_by_reciprocals,
  stride_is_height,
  colour_of_next,
  colour_beside,
  // The scan-line method.
  flag_missed,
  wrong_of_two,
  plane_d_sign,
  closing_edge_missed,
  implied_edge_missed,
  // Depth sort.
  sorted_by_nearest,
  ties_unstable,
  tests_3_4_swapped,
  pieces_lost,
  // The BSP tree.
  near_side_first,
  side_by_normal,
  spanning_not_split,
  // Warnock's areas.
  surrounding_unchecked,
  stops_one_early,
  quarters_overlap,
  // Rays.
  nearest_by_index,
  negative_t,
  box_misses_at_0,
  // The floating horizon.
  only_upper,
  not_interpolated,
  farthest_first,
  lower_never_moves,
  crossing_from_end,
  one_ink,
  count
};
inline constexpr std::size_t mistake_count = value_count<Mistake>;

struct MistakeText {
  std::string_view id;        ///< "slope_inverted"
  std::string_view name;      ///< what is done, as one sentence
  std::string_view question;  ///< that a good teaching assistant would ask
  std::string_view lesson;    ///< as `zstep lesson` takes it
  std::string_view stop;      ///< its heading there
};
const MistakeText& text_of(Mistake mistake);
/// The one with this id.
std::optional<Mistake> mistake_called(std::string_view id);

}  // namespace zstep::mistakes
