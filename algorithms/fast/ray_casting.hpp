// Ray casting in a hurry: for whoever wants the picture and no trace.
//
// ray_casting.cpp is the method, and the place to read it. Here a ray is held against eight boxes and four triangles at
// once. Boxes are in single precision and rounded outwards; what is hit, and where, is found in double precision, with
// planes and barycentric coordinates reckoned beforehand. Pictures agree with the taught method's up to rounding: a
// pixel's centre within 1e-9 of an edge may fall to either side.
#pragma once

#include "algorithms/fast/ray_tree.hpp"
#include "traces/scene.hpp"

namespace zstep::ray_casting {

/// One ray a pixel, from the eye through its centre. Of equal depths the facet drawn first is seen.
Picture cast_fast(const Scene& scene, const Conventions& conventions);

/// The same with a tree that was built before, of this scene.
Picture cast_fast(const Tree& tree, const Scene& scene, const Conventions& conventions);

}  // namespace zstep::ray_casting
