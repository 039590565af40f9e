// Vectorised Z-buffer, bit-identical to z_buffer.cpp, for when only the picture is needed.
//
// z_buffer.cpp is the method, and the place to read it. Here the same formulas are evaluated in the same order, but for
// four vertices, four scan lines or four pixels at once, and without tables:
// - Nearly every polygon goes down on one side and up on the other. A scan line then meets two of its edges, and these
//   are found by trying all: there is nothing to insert, sort or retire.
// - Facing and area are decided without square roots where they are clear by a wide margin.
// - Where spans are short, all are filled as if they were equally long; what is too much is masked out.
// Facets that need clipping, that are nearly edge-on or nearly without area, and polygons that go up and down more than
// once take the way of z_buffer.cpp for the part in question. So does everything with increments (each sum needs the
// one before) or with inclusive coverage, and on compilers without vector types.
//
// - The picture is cut into bands of rows, which threads draw at the same time: each goes through all outlines in their
//   order, so every pixel sees its polygons in the order of the taught loop.
//
// What it costs: 740 lines, with simd.hpp and bands.hpp, beside the 86 of z_buffer.cpp, and a test that compares the
// two bit by bit.
#pragma once

#include "traces/scene.hpp"

namespace zstep::z_buffer {

/// The bits of run() with a NullRecorder.
Picture run_fast(const Scene& scene, const Conventions& conventions);

/// The same into a picture whose buffers are kept from the frame before if they have the raster's size, by so many
/// threads; 0: as many as the processor runs at once, but no more than 16, and one for each 64 rows.
void run_fast(const Scene& scene, const Conventions& conventions, Picture& picture, int threads = 0);

}  // namespace zstep::z_buffer
