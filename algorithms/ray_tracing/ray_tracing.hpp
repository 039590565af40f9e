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
#include <glm/vec3.hpp>
#include <optional>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/ray_casting/space.hpp"
#include "traces/formulas/of_light.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of ray tracing.

#define ZSTEP_MODULE ray_tracing
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/ray_tracing/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::ray_tracing {

// How light goes on where it meets a face: the formulas (traces/formulas/of_light.hpp) on the engine's vectors.

inline glm::dvec3 mirrored(glm::dvec3 along, glm::dvec3 normal) {
  const auto way = formulas::mirrored<double>({along.x, along.y, along.z}, {normal.x, normal.y, normal.z});
  return {way.x, way.y, way.z};
}

inline std::optional<glm::dvec3> refracted(glm::dvec3 along, glm::dvec3 normal, double n_1, double n_2) {
  const auto way = formulas::refracted<double>({along.x, along.y, along.z}, {normal.x, normal.y, normal.z}, n_1, n_2);
  return way ? std::optional(glm::dvec3(way->x, way->y, way->z)) : std::nullopt;
}

inline constexpr std::array options{
    Option{"boxes", "none|facet|hierarchy|grid", "hierarchy", "what spares a ray the test of every facet"},
    Option{"depth", "", "3", "how often a ray may be mirrored or let through", false, 0, 8}};

/// Polygon and depth are those which the eye sees first; its ink is the colour.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

}  // namespace zstep::ray_tracing
