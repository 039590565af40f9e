// Ray casting.
//
// A. Appel, "Some Techniques for Shading Machine Renderings of Solids", AFIPS Spring Joint Computer Conference 32,
// 1968; as taught in 002, "Simple Ray Tracing": one ray a pixel, from the centre of projection through the pixel's
// centre, and of all objects that it meets the nearest is seen. The notes' ways to spare tests are the option `boxes`:
// a box around each facet, a hierarchy of boxes, a partition of space in cells of equal size.
//
// Rays run in the world. Parallel projection and screen scenes have parallel rays. Facets are met between near and far
// plane only, like everywhere else. Departure from the page: a point counts as inside by the even-odd rule as it is
// seen along the ray, so that facets which share an edge leave no gap there.
#pragma once

#include <array>

#include "algorithms/catalog/option.hpp"
#include "algorithms/ray_casting/steps.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::ray_casting {

inline constexpr std::array options{
    Option{"boxes", "none|facet|hierarchy|grid", "none", "what spares a ray the test of every facet"}};

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::ray_casting
