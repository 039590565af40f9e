// The naive painter's algorithm: draw everything, the farthest first, each over what is there.
//
// 003, "Painter's Algorithm"; 002, "Depth Sort Algorithm", steps 1 and 3 without step 2: polygons are sorted by their
// farthest z and nothing else is asked. That is right as long as z extents do not overlap. Where they do, a polygon may
// be painted over one that lies before it: a long one that slants towards the eye past a small one, polygons that
// intersect, polygons that overlap each other in a ring. It is kept here to be seen failing; depth_sort.hpp mends it.
#pragma once

#include "algorithms/pieces/pieces.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of the naive painter's algorithm.

#define ZSTEP_MODULE painter
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/depth_sort/painter_steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::painter {

/// Draws the scene's facets by their farthest z, of equal ones the later in the file first, so that the earlier stays.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::painter
