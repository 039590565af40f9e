// The facets of a scene, put where a ray finds them: in no order, in a box each, in a hierarchy of boxes, or in the
// cells of a grid (002, "Extents" and "Simple Ray Tracing").
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/ray_casting/geometry.hpp"
#include "traces/record/recorder.hpp"

// The steps of ray casting: putting facets into boxes, following one ray, and the method.

#define ZSTEP_MODULE boxes
#define ZSTEP_FIRST_STEP 104
#define ZSTEP_STEPS "algorithms/ray_casting/boxes_steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE meeting
#define ZSTEP_FIRST_STEP 112
#define ZSTEP_STEPS "algorithms/ray_casting/meeting_steps.def"
#include "traces/record/declare_steps.hpp"

#define ZSTEP_MODULE ray_casting
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/ray_casting/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::ray_casting {

enum class Boxes : std::uint8_t { none, facet, hierarchy, grid };

/// Where a ray enters and leaves the slabs of a box; it meets the box if t_enter <= t_leave.
struct Passage {
  double t_enter, t_leave;
};

struct Box {
  glm::dvec3 low, high;

  Passage pass(const Ray& ray) const;
};

/// A box with the boxes in it, or with facets. Numbered in the order in which they are made.
struct BoxNode {
  Box box;
  std::array<std::int32_t, 2> inner{-1, -1};
  std::vector<std::int32_t> targets;  ///< places in Space::targets
};

struct Grid {
  Box box;
  std::array<std::int32_t, 3> cells{0, 0, 0};      ///< along x, y, z
  std::vector<std::vector<std::int32_t>> targets;  ///< by cell, x first

  std::size_t place(const std::array<std::int32_t, 3>& cell) const {
    return (static_cast<std::size_t>(cell[2]) * cells[1] + static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(cells[0]) +
           static_cast<std::size_t>(cell[0]);
  }
  /// Where cell number i along the axis begins; i may be one beyond the last.
  double edge(int axis, std::int32_t i) const {
    return box.low[axis] + (box.high[axis] - box.low[axis]) * i / cells[axis];
  }
};

struct Space {
  Boxes kind = Boxes::none;
  std::vector<Target> targets;  ///< the facets that have an area, in their order
  std::vector<BoxNode> boxes;   ///< boxes[0] is the root of a hierarchy
  Grid grid;
  std::vector<std::int32_t> met_by;  ///< by target: number of the ray that was held against it last
  std::int32_t rays = 0;             ///< how many were followed
};

/// Boxes are wider than the facets by 1e-9 of the coordinates' size, so that rounding hides no facet that lies in a
/// side of its box.
template <Recorder R>
Space make_space(const Scene& scene, Boxes kind, R& record);

}  // namespace zstep::ray_casting
