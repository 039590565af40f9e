// Vectorised half-space, bit-identical to half_space.cpp, for when only the picture is needed.
//
// half_space.cpp is the method, and the place to read it. Here the same formulas are evaluated in the same order, for
// four pixels at once (of wide triangles E / area by its reciprocal, to the same bits), and on each scan line only
// between the edges, with two pixels to spare at both ends. Runs with stepped edge functions, samples, float32 or other
// depths, and scenes with an outline that is not convex on the raster, are left to half_space.cpp.
#pragma once

#include "traces/scene.hpp"

namespace zstep::half_space {

/// The bits of run() with a NullRecorder, into a picture whose buffers are reused if they have the raster's size; false
/// where this run is left to run(). `threads`: 0 for as many as are worth it.
[[nodiscard]] bool run_fast(const Scene& scene, const Conventions& conventions, Picture& picture, int threads = 0);

}  // namespace zstep::half_space
