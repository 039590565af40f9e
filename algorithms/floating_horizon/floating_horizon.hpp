// The floating horizon: the curves of a surface y = f(x, z), without what lies behind others.
//
// T. J. Wright, "A Two-Space Solution to the Hidden Line Problem for Plotting Functions of Two Variables", IEEE
// Transactions on Computers C-22(1), 1973; D. F. Rogers, "Procedural Elements for Computer Graphics", McGraw-Hill,
// 1985, section 4-2, for crossings and side edges; as told in 004, "Some of the methods of hidden surface elimination".
// Departures from 004: rows of the raster grow downwards, so its "y larger" is "row smaller" here; a curve that touches
// a horizon is visible, as in Rogers; it is tested on every column of the raster, and drawn straight from column
// to column.
//
// Why it works: a plane through the eye and a column of the picture cuts the surface in one curve, as no place has two
// heights; what was drawn of it so far covers the column from one horizon to the other without a gap. For that the
// plane must stand upright in the world. It does so in parallel projection, for an eye that looks level, and in the
// middle column; in perspective from above the planes lean to the sides, and there a line may be taken for hidden or
// visible that is not (docs/architecture.md has what was measured).
#pragma once

#include <array>

#include "algorithms/viewing/vertices.hpp"
#include "algorithms/catalog/catalog.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of the floating horizon.

#define ZSTEP_MODULE floating_horizon
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/floating_horizon/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::floating_horizon {

inline constexpr std::array options{
    Option{"horizons", "two|one", "two", "an upper and a lower horizon, or the upper alone, which a valley defeats",
           false},
    Option{"sides", "off|on", "on", "the horizons reach out to the surface's left and right edge", false},
    Option{"across", "off|on", "off", "curves of constant x are drawn too", false},
};

/// Draws the curves of constant z of the scene's surface, and between two of them the intervals of those of constant x
/// if they are asked for, into the picture's ink: black where the surface is seen from above, white on a dark
/// background, and orange where a curve shows below the lower horizon. No pixel has a polygon or a depth. Without a
/// surface the picture stays empty.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::floating_horizon
