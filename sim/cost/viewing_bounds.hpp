// What rounding may do to a depth before it is interpolated: viewing and projecting its polygon's vertices.
#pragma once

#include <cstdint>
#include <optional>

#include "traces/file/trace.hpp"

namespace zstep::compare {

/// How far a depth that is interpolated over a facet may be off the facet in the scene, from what rounding does to its
/// corners on their way to the raster, in the number format that a run declares. Nothing where more than that stands
/// between them: corners that clipping makes or that are moved to whole pixels, pixels beyond the outline.
std::optional<double> viewing_bound(const Trace& run, std::int32_t facet);

}  // namespace zstep::compare
