// What theory allows rounding to do to the depths of a run (docs/interpolation.md).
#pragma once

#include <cstdint>
#include <optional>

#include "algorithms/interpolation/interpolation.hpp"
#include "traces/check/precision.hpp"
#include "traces/file/trace.hpp"

namespace zstep::compare {

/// The bounds of a Z-buffer's depths under the conventions that a run declares. Nothing where no Z-buffer draws the
/// scene so, or the header does not say in which numbers.
std::optional<interpolation::Bounds> bounds_in(const Trace& run);

/// What the depths of two runs are held to where they are compared with each other: at each pixel, by how much the two
/// may be apart in the number formats that they declare.
HeldTo held_to_bounds(const Trace& a, const Trace& b);
/// The same of a run and of depths that another program computed likewise, in numbers of this format.
HeldTo held_to_bounds(const Trace& a, NumberFormat of_b);

// What rounding may do to a depth before it is interpolated: viewing and projecting its polygon's vertices.

/// How far a depth that is interpolated over a facet may be off the facet in the scene, from what rounding does to its
/// corners on their way to the raster, in the number format that a run declares. Nothing where more than that stands
/// between them: corners that clipping makes or that are moved to whole pixels, pixels beyond the outline.
std::optional<double> viewing_bound(const Trace& run, std::int32_t facet);

}  // namespace zstep::compare
