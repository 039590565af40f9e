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

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/ray_casting/space.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep::ray_casting {

inline constexpr std::array options{
    Option{"boxes", "none|facet|hierarchy|grid", "none", "what spares a ray the test of every facet"}};

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

// The facet that a ray meets first.

struct Nearest {
  std::int32_t facet = -1;  ///< none
  double t = 0;
  std::int32_t tests = 0;  ///< facets whose planes were met
};

/// What a ray may meet.
struct Meets {
  bool cull = false;            ///< no facet whose back it would see
  std::int32_t not_facet = -1;  ///< not the facet on which it begins
  double here = 0;              ///< t up to which a point counts as the one where it begins: on the same plane
  bool layers = false;  ///< of the facets there, those that come later in the file lie behind; else there are none
};

/// Of equal t the facet that is drawn first is the nearest, in whatever order they are tested: so the result is the
/// same for every kind of boxes.
template <Recorder R>
Nearest first_hit(Space& space, const Ray& ray, Meets meets, R& record);

}  // namespace zstep::ray_casting
