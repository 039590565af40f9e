#include "algorithms/viewing/view_factors.hpp"

#include <cmath>

#include "traces/lamp.hpp"

namespace zstep::viewing {

std::optional<std::array<glm::dmat4, 4>> view_factors(const Camera& camera) {
  constexpr double level = 1e-12;
  const glm::dmat4& view = camera.view;
  if (camera.kind != Camera::Kind::perspective || !(std::abs(view[2][0]) <= level)) return std::nullopt;
  // As they stand in T_v: what angles and vectors give is then the same to the last bit.
  const double sin_theta = -view[0][0], cos_theta = view[1][0], sin_phi = view[2][1], cos_phi = -view[2][2];
  const glm::dvec3& eye = camera.eye;
  return std::array{view_from_rows({1, 0, 0, -eye.x}, {0, 1, 0, -eye.y}, {0, 0, 1, -eye.z}),
                    view_from_rows({sin_theta, -cos_theta, 0, 0}, {cos_theta, sin_theta, 0, 0}, {0, 0, 1, 0}),
                    view_from_rows({1, 0, 0, 0}, {0, -cos_phi, sin_phi, 0}, {0, -sin_phi, -cos_phi, 0}),
                    view_from_rows({-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0})};
}

}  // namespace zstep::viewing
