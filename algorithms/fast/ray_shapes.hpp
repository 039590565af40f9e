// What the boxes of a Tree are built around: triangles of facets.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "traces/scene.hpp"

namespace zstep::ray_casting {

struct Shape {
  glm::dvec3 low, high;  ///< its box
  glm::dvec3 n, u, v;    ///< as in Packet
  double n_0, u_0, v_0;
  std::int32_t facet;
};

/// A facet that is star-shaped around its first corner, as convex ones are, is a fan of triangles. Any other is one
/// shape, inside of which is its whole plane: whoever meets it must look at the outline.
std::vector<Shape> shapes_of(const Scene& scene);

}  // namespace zstep::ray_casting
