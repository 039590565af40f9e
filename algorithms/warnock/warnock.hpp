// Warnock's algorithm: quarter the picture until each area is simple.
//
// J. E. Warnock, "A Hidden Surface Algorithm for Computer Generated Halftone Pictures", TR 4-15, University of Utah,
// 1969; as taught in 002, "Warnock's Algorithm" (Foley, van Dam, Feiner and Hughes, section 15.7.1). Departures from
// the page: a single pixel is decided at its own centre, where 002 says "at the center of the polygon"; rasters need
// not be powers of two; and what surrounds or misses an area is not tested again in its quarters.
#pragma once

#include <array>

#include "algorithms/catalog/option.hpp"
#include "algorithms/warnock/steps.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::warnock {

inline constexpr std::array options{
    Option{"boxes", "off|on", "off", "bounding boxes tell disjoint and contained polygons first"}};

/// Draws the scene. Nearest wins; of depths equal to twelve digits the polygon that comes first.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::warnock
