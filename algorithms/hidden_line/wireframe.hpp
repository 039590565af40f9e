// The wireframe: every edge is drawn, whatever lies before it.
//
// As in 002 and 004, which show by it what hidden lines are: one cannot tell front from back. Leaving out the edges of
// back faces helps a convex solid and no other.
#pragma once

#include <array>

#include "algorithms/hidden_line/lines.hpp"
#include "algorithms/catalog/catalog.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of the wireframe.

#define ZSTEP_MODULE wireframe
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/hidden_line/wireframe_steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::wireframe {

inline constexpr std::array options{
    Option{"edges", "all|front", "all", "all edges, or none of which all faces face away", false}};

/// Draws the edges of all polygons that are in view, back faces whether culled or not: the option decides.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::wireframe
