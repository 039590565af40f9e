// What a step's formulas may look at, and how they are asked.
//
// For each kind of event there is one function, `derive(e, at, out)`, in the headers beside this one: it says, field by
// field, what the event's numbers follow from. `out` decides what a number is and what becomes of the answer:
//
//   const auto x_0 = out.number("x_0", value, place);   an operand: its name, its value, and where it stands
//   out.gives(&E::z, formula);                          a field must be what this formula gives
//   out.whole(&E::first, formula, within);              the same of a whole number, which the raster may limit
//   out.within(&E::z, formula, off);                    the same, but for so much, by which any sensible way of
//                                                       computing it may be off
//   out.near(&E::plane_a, number);                      the same of a number that other operations may have given, and
//                                                       that words tell in another way: held to rounding, not to bits
//   out.is(&E::polygon, value);                         a field must be this
//   out.verdict(&E::nearer, z, stored);                 a field says whether z wins over what is stored
//   out.rule(Rule::sorted, holds);                      what must hold besides
//   if (out.trusts(place)) …                            where a rule says nothing once the operands are wrong
//
// With doubles that reproduces a run to the bit, with numbers that know how far they may be off it judges one, with
// numbers that remember how they were made it prints the formula. What cannot be derived, as the trace does not have
// the operands, is left out; then nothing is said of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "traces/events/slots.hpp"
#include "traces/file/header.hpp"
#include "traces/formulas/drawn_facet.hpp"
#include "traces/formulas/spans_ahead.hpp"
#include "traces/replay/state.hpp"

namespace zstep::formulas {

// A field for which there is a formula, as its description says (`As::formula`). That each of these is given is a law
// (tests/laws).

/// A field for which `derive` has a formula. Naming another one does not compile.
template <class E, class Value>
struct Follows {
  Value E::*member;
  std::string_view name = {};
  std::string_view unit = {};
  std::size_t number = 0;                               ///< of the event's fields
  consteval Follows(Value E::*which) : member(which) {  // NOLINT: what is given is a member
    for_each_index<E>([&]<std::size_t I>() {
      if constexpr (std::is_same_v<FieldValue<E, I>, Value>)
        if (field_at<E, I>.member == which) {
          if (!has(field_at<E, I>.as, As::formula)) throw "its description says that it follows from nothing";
          name = field_at<E, I>.name, unit = field_at<E, I>.unit, number = I;
        }
    });
  }
};

/// A kind of event that says something of things which it only names, and for which there is no formula.
template <class E>
inline constexpr bool joins_things = false;

/// Where an operand stands: what has to be right for what follows from it to be right, and from where it can be
/// followed further back.
struct Place {
  enum class In : std::uint8_t {
    event,         ///< the event itself
    scene,         ///< the scene, the camera, the header
    vertex,        ///< a vertex's stages, by its number
    edge_table,    ///< an entry of the edge table, by its number
    active_edge,   ///< where an active edge has got to, by the edge's number
    active_list,   ///< the order of the active edges
    plane,         ///< the slopes of the plane of the polygon at work
    span,          ///< a span, by its number among those that no pixel came between
    fragment,      ///< the pixel at work
    attribute,     ///< the attribute that was interpolated there
    depth_buffer,  ///< by pixel, as Picture::at counts
    light_buffer,  ///< the depth buffer of what the light sees, likewise
    frame,         ///< likewise
    piece,         ///< plane, extent and outline of a piece, by its number
    ray,           ///< the ray at work
    horizon,       ///< by column, the upper and the lower one
    point,         ///< a point of the scene, by its number
    triangle,      ///< the triangle at work: its edge functions 0 to 2, itself, the inside test, the weights, the last
                   ///< sample's test and the mask of the pixel
    samples,       ///< by sample, as Situation::sample_place counts
  };
  In in = In::event;
  std::int64_t number = 0;
  std::string_view field = {};  ///< which of the numbers there, as the event that gave it calls it; x_w … in the world

  Place operator[](std::string_view which) const { return {in, number, which}; }
};

/// What must hold besides formulas. Each has a name and a sentence (traces/check/rules.hpp).
enum class Rule : std::uint8_t {
  edge_in_bucket,     ///< an edge enters at its first scan line
  edge_sorted,        ///< it enters at a place that keeps the list in order
  edge_retires,       ///< an edge leaves the list at the scan line where it ends
  edge_left_behind,   ///< no edge stays in the list beyond its end
  edge_missing,       ///< no edge whose scan line has come is left out of the list
  edge_moves_once,    ///< an active edge has moved once for each scan line since it entered
  swap_needed,        ///< only neighbours that are out of order change places
  list_in_order,      ///< when a span begins the list is in order
  span_pairs,         ///< a span goes from an edge to the next one in the list
  span_line,          ///< it lies on the scan line at work
  pixel_in_span,      ///< a pixel lies in the span at work
  write_after_win,    ///< a pixel is written only after its depth was nearer
  win_is_written,     ///< and after it was nearer, its depth is
  win_is_painted,     ///< and its colour
  skip_is_right,      ///< an edge is left out only where it meets no scan line
  box_entered,        ///< a ray that meets a box enters it before it leaves it
  kept_inside,        ///< of the points where a ray meets planes only those inside their facets are kept
  facet_of_polygon,   ///< a facet is one of its polygon's
  reject_is_right,    ///< a polygon is dropped for a reason that its tests, or its vertices, give
  outline_of_facet,   ///< an outline has its facet's corners, and vertices that were made
  edge_of_outline,    ///< an edge joins two neighbours of its outline
  side_is_right,      ///< a side follows from the values of the plane
  cut_in_edge,        ///< an edge is cut between its ends
  point_in_both,      ///< a point that two pieces share lies in the extents of both
  test_of_pair,       ///< two pieces are tested as the pair at work
  pair_in_list,       ///< a pair is the first piece of the list and another one in it
  list_is_whole,      ///< the list has all pieces before they are compared or drawn
  flip_own_edge,      ///< the flag that flips at an edge is its own polygon's
  winner_inside,      ///< only a piece whose flag is true is seen
  share_of_pixel,     ///< shares of a pixel are from 0 to 1
  node_is_free,       ///< a node of the tree has one child on each side
  far_side_first,     ///< what lies beyond a plane is painted before what lies in it
  node_skip_side,     ///< a side of a plane is passed over only where nothing is seen there
  box_decides,        ///< a box alone decides only what it can
  area_case,          ///< what is done with an area follows from its bins
  pixel_in_area,      ///< a pixel that is painted lies in the area at work
  box_in_parent,      ///< a box lies in the box around it
  box_is_tight,       ///< a side of a box goes through a point of the scene
  box_holds,          ///< a facet lies in the box that holds it
  cell_holds,         ///< a facet meets the cell that holds it
  number_is_next,     ///< what a run numbers in the order of work has the next number
  line_is_next,       ///< while edges are active scan lines come one after another
  cell_is_next,       ///< a ray goes from a cell to one beside it
  ray_paints_own,     ///< a ray paints the pixel that it was cast for
  horizon_moves_out,  ///< a horizon moves away from the other one
  cross_beside,       ///< a curve crosses a horizon between two columns
  ink_on_curve,       ///< a pixel of a curve lies where the curve is visible
  hides_of_line,      ///< what is hidden of a line is a part of it
  outline_is_closed,  ///< each edge of an outline that meets a scan line is in the edge table
  pair_has_span,      ///< each pair of active edges with pixels between them has a span
  span_is_filled,     ///< each pixel of a span has its turn
  pixel_on_facet,     ///< a pixel that is drawn is one of its facet's
  pixel_is_drawn,     ///< and each of the facet's pixels is drawn
  facet_is_drawn,     ///< each facet that has pixels is drawn
  back_is_dropped,    ///< a facet that faces away is not
  nearest_is_kept,    ///< a pixel is not painted with what lies behind what it has
  nearer_is_painted,  ///< and is painted with what lies before it
  weights_inside,     ///< only a pixel that was found inside its triangle has weights
  sample_inside,      ///< and only such a sample has a depth
  sample_is_tested,   ///< each sample of a pixel has its turn
  count
};

/// Everything before an event happens: what its numbers follow from.
struct Situation {
  const Header& header;
  const Scene& scene;
  const State& before;
  const Camera* camera = nullptr;                ///< by which the scene is being drawn; nullptr where that is not known
  std::uint8_t kinds_recorded[kind_count] = {};  ///< 1 for each kind of event that the trace has
  std::uint8_t kinds_on_page[kind_count] = {};   ///< 1 for each kind that the pseudo-code has a line for
  std::optional<Camera> lamp = {};               ///< the scene's light as a camera
  bool moves_ended = false;  ///< the run never says that an edge leaves, and moves some that have ended
  SpansAhead ahead = {};     ///< the last spans that no pixel came between
  bool has_passed = false;   ///< `before` is the state that the step led to
  struct DrawnNow {
    bool known = false;
    std::int32_t facet = -1;
    std::optional<DrawnFacet> drawn = {};
    std::int64_t spent = 0;  ///< on all that were found: their corners times their scan lines
  };
  mutable DrawnNow drawn_now = {};  ///< see drawn_facet()
  /// The triangle at work as its vertices are on the raster.
  struct TriangleNow {
    struct End {
      std::int32_t vertex = -1;
      double x = 0, y = 0;
    };
    std::array<End, 3> ends{};  ///< by which each edge function is computed; vertex -1 where that is not known
    std::array<std::int32_t, 3> vertices{-1, -1, -1};
    std::optional<std::array<double, 3>> depths;  ///< of the vertices
  };
  mutable std::optional<TriangleNow> triangle_now = {};  ///< see triangle()
  double roundoff = 0;       ///< of what the program computes with, where it is not what the header says; else 0
  bool is_fixed = false;     ///< it computes in fixed point, whatever the header says
  double written = 0;        ///< by what share of itself a number may be off that is written with fewer digits
  double written_off = 0;    ///< and by how much besides
  bool steps_edges = false;  ///< edge functions are added to from pixel to pixel

  /// Takes the camera that is at work now.
  void look() { camera = before.machine.pass != Pass::light ? &scene.camera : lamp ? &*lamp : nullptr; }

  template <class E>
  bool records() const {
    return kinds_recorded[kind_of<E>] != 0;
  }
  /// After a step, where steps are gone through one by one: a program may print several spans, or all of a polygon or
  /// of the scene, and their pixels afterwards.
  template <class E>
  void passed(std::int64_t step, const E& e) {
    constexpr bool begins = std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>;
    if constexpr (begins) ahead.begin(e.polygon);
    if constexpr (begins || std::is_same_v<E, OutlineVertex>) drawn_now.known = false;
    if constexpr (at_pixel<E> == AtPixel::nothing && !std::is_same_v<E, InsideTest> &&
                  !std::is_same_v<E, BarycentricWeights>)
      triangle_now.reset();
    if constexpr (std::is_same_v<E, EdgeTableInsert>)
      if (e.edge == 0 && !of_any()) ahead.begin(e.polygon);
    if constexpr (std::is_same_v<E, SpanBegin>) {
      const EdgeTableInsert* left = of_any() ? edge(e.left_edge) : nullptr;
      ahead.add(e, left ? std::optional(left->polygon) : std::nullopt, step);
    }
    ahead.pass(e);
  }
  /// The span that a pixel belongs to, and its place, of those that `passed` keeps. Where none covers it, it is the one
  /// at work, if any.
  struct SpanOfPixel {
    const SpanBegin* span = nullptr;
    Place place{Place::In::span, 0};
    const SpansAhead::Open* open = nullptr;  ///< where there are several
    std::int64_t step = 0;                   ///< that began it, where `passed` keeps it
    const SpanBegin* operator->() const { return span; }
    explicit operator bool() const { return span != nullptr; }
    /// Its own numbers are all there is of it: edges and slopes are another polygon's by now.
    bool is_of_other(const Situation& at) const {
      return open && at.ahead.of_all && open->polygon != at.method().polygon;
    }
  };
  static bool covers(const SpanBegin& span, std::int32_t x, std::int32_t y) { return SpansAhead::covers(span, x, y); }
  template <class E>
  SpanOfPixel span_of(const E& e) const {
    const auto number = ahead.span_of(e, has_passed);
    if (number) {
      const SpansAhead::Open& open = ahead.spans()[*number];
      const bool several = ahead.spans().size() > 1;
      return {&open.span, {Place::In::span, static_cast<std::int64_t>(*number)}, several ? &open : nullptr, open.step};
    }
    // Of polygons that began and drew nothing no span of an earlier one is meant.
    const auto& now = method().span;
    const bool any = now || (ahead.of_all && !ahead.spans().empty());
    const std::size_t last = ahead.spans().empty() ? 0 : ahead.spans().size() - 1;
    return {!any  ? nullptr
            : now ? &*now
                  : &ahead.spans().back().span,
            {Place::In::span, static_cast<std::int64_t>(last)}};
  }
  /// Where the numbers of a span that begins now will stand.
  Place place_of_next_span() const { return {Place::In::span, ahead.has_pixels() ? 0 : std::ssize(ahead.spans())}; }
  /// Do all polygons share one edge table, so that spans are of any of them?
  bool of_any() const { return method().keeps_all && method().piece < 0; }
  /// The polygon of the span of the pixel at work, where there are spans of several polygons.
  std::optional<std::int32_t> polygon_of_pixel(std::int32_t x, std::int32_t y) const {
    if (!ahead.of_all && !of_any()) return std::nullopt;
    const auto number = ahead.at_work(x, y);
    if (!number || ahead.spans()[*number].polygon == no_polygon) return std::nullopt;
    return ahead.spans()[*number].polygon;
  }
  /// Is an edge that has not left still in the list? Else the run only does not say that it leaves.
  bool tells_leaving() const { return records<EdgeRetire>() || moves_ended; }
  /// Does its pseudo-code have a line for this kind?
  template <class E>
  bool has_step() const {
    return kinds_on_page[kind_of<E>] != 0;
  }
  const MethodState& method() const { return before.machine; }
  /// Are x and z computed by adding to what they were, so that scan lines come one after the other?
  bool adds_slopes() const { return zstep::adds_slopes(header.conventions); }
  bool on_screen() const { return scene.camera.kind == Camera::Kind::screen; }
  bool is_point(std::int32_t vertex) const { return vertex >= 0 && vertex < std::ssize(scene.points); }

  bool is_facet(std::int32_t facet) const { return facet >= 0 && facet < std::ssize(scene.facets); }

  /// A vertex on its way; nullptr where there is none.
  const VertexStages* vertex(std::int32_t number) const {
    const std::size_t at = number;
    return number >= 0 && at < before.vertices.size() ? &before.vertices[at] : nullptr;
  }
  /// The same once it has view coordinates. A run that records a later stage alone does not have them, but of the
  /// vertices that clipping made.
  const VertexStages* viewed(std::int32_t number) const {
    const VertexStages* found = vertex(number);
    const bool clipped = found && records<ClipCross>() && !is_point(number) && found->world == glm::dvec3(0);
    return found && (records<ViewTransform>() || clipped) && found->stage >= VertexStages::viewed ? found : nullptr;
  }
  /// Has the run the depth of a vertex that is on the raster?
  bool has_depth(std::int32_t number) const {
    if (records<Projection>()) return true;
    const VertexStages* made = records<SplitVertex>() && !is_point(number) ? vertex(number) : nullptr;
    const bool cut_on_raster = made && made->view == glm::dvec3(0) && (on_screen() || !has_step<NodeMake>());
    return cut_on_raster || (on_screen() && is_point(number));
  }
  std::optional<OnRaster> on_raster(std::int32_t number) const { return zstep::on_raster(scene, before, number); }
  const EdgeTableInsert* edge(std::int32_t number) const {
    const std::size_t at = number;
    return number >= 0 && at < method().edge_table.size() ? &method().edge_table[at] : nullptr;
  }
  const ActiveEdge* active(std::int32_t number) const {
    for (const ActiveEdge& active : method().active)
      if (active.edge == number) return &active;
    return nullptr;
  }
  const Piece* piece(std::int32_t number) const {
    const std::size_t at = number;
    return number >= 0 && at < method().pieces.size() ? &method().pieces[at] : nullptr;
  }
  /// The facet at work as the scene has it on the raster, or as the vertices that the run prints have it; nullptr where
  /// no facet is drawn by itself, pixel by pixel, or where it has no area. Found once for each.
  const DrawnFacet* drawn_facet() const {
    if (!drawn_now.known || drawn_now.facet != method().facet)
      drawn_now.known = true, drawn_now.facet = method().facet, drawn_now.drawn = draw_facet();
    return drawn_now.drawn ? &*drawn_now.drawn : nullptr;
  }
  std::optional<DrawnFacet> draw_facet() const;
  /// What is known of the triangle at work; found once for all its pixels.
  const TriangleNow& triangle() const {
    if (!triangle_now) triangle_now = find_triangle();
    return *triangle_now;
  }
  TriangleNow find_triangle() const;
  /// The pixel at work, where it is this one.
  const Fragment* fragment(std::int32_t x, std::int32_t y) const {
    const auto& found = method().fragment;
    return found && found->x == x && found->y == y ? &*found : nullptr;
  }
  std::int64_t pixel(std::int32_t x, std::int32_t y) const { return before.picture_of_pass().at(x, y); }
  double stored(std::int32_t x, std::int32_t y) const { return before.picture_of_pass().depth[pixel(x, y)]; }
  /// The depth that a sample has: its polygon's, or the one that all began with.
  double stored_at_sample(std::int32_t x, std::int32_t y, std::int32_t sample) const {
    const SampleRow row = method().sample(x, y, sample);
    return row.polygon == no_polygon ? header.empty_depth() : row.z;
  }
  Place sample_place(std::int32_t x, std::int32_t y, std::int32_t sample) const {
    return {Place::In::samples, pixel(x, y) * method().samples_a_pixel + sample};
  }
  Place depth_place(std::int32_t x, std::int32_t y) const {
    return {method().pass == Pass::light ? Place::In::light_buffer : Place::In::depth_buffer, pixel(x, y)};
  }
};

}  // namespace zstep::formulas
