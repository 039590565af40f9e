// How often rounding turns what a method decides: every sign that a trace shows a decision about, held against the sign
// that the vertices give in fractions (docs/exactness.md).
#pragma once

#include <cstdint>
#include <string_view>

#include "traces/file/trace.hpp"

namespace zstep::oracle {

enum class Predicate : std::uint8_t {
  facing,         ///< which side of a facet the eye sees
  clip_side,      ///< is a vertex inside a plane of the view volume?
  span_end,       ///< which pixel is the first, which the last between two edges
  edge_order,     ///< which of two edges is the left one
  depth_compare,  ///< which of two depths that were interpolated is nearer
  vertex_side,    ///< on which side of a polygon's plane a vertex lies
  side,           ///< and a whole piece
  eye_side,       ///< and the eye
  extents,        ///< do two extents overlap?
  overlap,        ///< do two projections?
  bin,            ///< how a polygon lies to an area
  plane_depth,    ///< which of two planes is nearer at a pixel or at a corner of an area
  ray_facing,     ///< does a ray meet a facet from its front?
  ray_inside,     ///< does it meet its plane inside the outline?
  ray_nearest,    ///< is what it meets nearer than what it met before?
  box,            ///< does it meet a box before that?
  horizon,        ///< is a curve above, below or between the horizons?
  line_and_face,  ///< does a face cover some of a line?
  count
};

struct PredicateText {
  std::string_view name, methods;
};
/// Name and who asks, by predicate.
const PredicateText& text_of(Predicate which);

struct Decided {
  std::int64_t decisions = 0;
  std::int64_t left_open = 0;    ///< a tolerance says "on", "edge-on", "only touches", and the exact answer has a side
  std::int64_t wrong = 0;        ///< the exact answer is another one
  std::int64_t first_wrong = 0;  ///< the step
  /// The largest quotient, of all wrong ones, of what the exact number is away from where the answer changes and of
  /// what rounding can move it by. Above 1 it is not rounding alone.
  double worst = 0;
};
struct Decisions {
  ByEnum<Predicate, Decided> of;
  Decided& operator[](Predicate which) { return of[which]; }
  const Decided& operator[](Predicate which) const { return of[which]; }
  std::int64_t wrong() const;
  void add(const Decisions& other);
};

/// Of a run in float64 whose depths are computed directly and whose coverage is top-left. Vertices count as exact as
/// the method was given them; what cutting makes is computed anew. Throws InputError where the trace cannot be read.
Decisions decisions_of(const Trace& trace);

}  // namespace zstep::oracle
