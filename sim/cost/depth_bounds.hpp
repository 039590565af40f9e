// What theory allows rounding to do to the depths of a run (docs/interpolation.md).
#pragma once

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

}  // namespace zstep::compare
