#include "algorithms/pieces/plane.hpp"

#include <cmath>

namespace zstep::pieces {

Plane plane_of(std::span<const glm::dvec3> corners) {
  glm::dvec3 normal(0), mean(0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 next = corners[i + 1 < corners.size() ? i + 1 : 0];
    normal += glm::cross(corners[i] - corners[0], next - corners[0]);
    mean += corners[i] / static_cast<double>(corners.size());
  }
  const double length = glm::length(normal);
  if (!(length > 0)) return {};
  normal /= length;
  return {normal.x, normal.y, normal.z, -glm::dot(normal, mean)};
}

double bend_of(const Plane& plane, std::span<const glm::dvec3> corners) {
  double most = 0;
  for (const glm::dvec3& corner : corners) most = std::fmax(most, std::abs(plane.value(corner)));
  return most;
}

}  // namespace zstep::pieces
