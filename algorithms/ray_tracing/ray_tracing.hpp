// Recursive ray tracing.
//
// T. Whitted, "An Improved Illumination Model for Shaded Display", Communications of the ACM 23(6), 1980; in 002, "Full
// blown ray tracing". What a ray brings back is mixed from the facet's own colour, from what a mirrored ray brings and
// from what a ray through the facet brings, each of them traced in the same way to the option `depth`. At that depth a
// facet shows its own colour only, so that depth 0 gives the picture of ray casting.
//
// Departures from Whitted: a facet has one colour, as everywhere in zstep, and neither highlight nor shading; where the
// scene has a light, a facet that the light does not reach is dimmed to four tenths, as the shadow buffer does it. What
// lets light through still casts a shadow. Where light cannot leave a body, all that would is mirrored.
#pragma once

#include <array>

#include "algorithms/catalog/option.hpp"
#include "algorithms/ray_tracing/steps.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::ray_tracing {

inline constexpr std::array options{
    Option{"boxes", "none|facet|hierarchy|grid", "hierarchy", "what spares a ray the test of every facet"},
    Option{"depth", "", "3", "how often a ray may be mirrored or let through", false, 0, 8}};

/// Polygon and depth are those which the eye sees first; its ink is the colour.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::ray_tracing
