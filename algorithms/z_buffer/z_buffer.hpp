// The Z-buffer.
//
// E. Catmull, "A Subdivision Algorithm for Computer Display of Curved Surfaces", PhD thesis, University of Utah, 1974
// (and, independently, W. Straßer, "Schnelle Kurven- und Flächendarstellung auf graphischen Sichtgeräten", PhD thesis,
// TU Berlin, 1974); as taught in 000, "Z-Buffer Algorithm Applied to Convex Polygons", with edge table and active edge
// list. Departures from the page: polygons may be concave (spans are pairs of active edges by the even-odd rule), the
// depth is z* of 003 unless z_v of 000 is asked for, and a pixel is covered as the run's conventions say.
#pragma once

#include "algorithms/scan_conversion/edge_table.hpp"
#include "algorithms/viewing/vertices.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of the Z-buffer.

#define ZSTEP_MODULE z_buffer
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/z_buffer/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::z_buffer {

/// Draws the scene's facets in their order. Strictly nearer wins; of equal depths the one drawn first stays.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::z_buffer
