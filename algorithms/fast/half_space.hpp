// Half-space in a hurry: the picture of half_space.cpp, bit for bit, for whoever wants the picture and no trace.
//
// half_space.cpp is the method, and the place to read it. Here the same formulas are evaluated in the same order, for
// four pixels at once, and on each scan line only from where an edge's line is met, less two pixels, to where the next
// one is. What is asked of a run beside that (steps in E, float32, other depths), and scenes with an outline that is
// not convex on the raster, take the way of half_space.cpp.
#pragma once

#include "traces/scene.hpp"

namespace zstep::half_space {

/// Draws what run() draws with a NullRecorder where it can, into a picture whose buffers are kept from the frame before
/// if they have the raster's size; false where it cannot. `threads`: 0 for as many as are worth it.
[[nodiscard]] bool run_fast(const Scene& scene, const Conventions& conventions, Picture& picture, int threads = 0);

}  // namespace zstep::half_space
