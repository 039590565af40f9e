#include "algorithms/pieces/plane.hpp"

#include <cmath>

#include "traces/formulas/outlines.hpp"

namespace zstep::pieces {

Plane plane_of(std::span<const glm::dvec3> corners) {
  const auto corner = [&](std::size_t i) { return corners[i]; };
  const auto [normal, d] = formulas::plane_through(corners.size(), corner, formulas::Mean::of_parts);
  return {normal.x, normal.y, normal.z, d};
}

double bend_of(const Plane& plane, std::span<const glm::dvec3> corners) {
  double most = 0;
  for (const glm::dvec3& corner : corners) most = std::fmax(most, std::abs(plane.value(corner)));
  return most;
}

}  // namespace zstep::pieces
