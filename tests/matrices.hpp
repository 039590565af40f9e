// Cameras by matrices, as OpenGL's programs have them. For tests.
#pragma once

#include <cmath>

#include <doctest/doctest.h>
#include <glm/mat4x4.hpp>

#include "traces/scene.hpp"

namespace zstep::test {

/// What glFrustum() makes (OpenGL 2.1 specification, section 2.11.2), and with an infinite far plane its limit.
inline glm::dmat4 frustum(double l, double r, double b, double t, double n, double f) {
  glm::dmat4 matrix(0);
  matrix[0][0] = 2 * n / (r - l), matrix[2][0] = (r + l) / (r - l);
  matrix[1][1] = 2 * n / (t - b), matrix[2][1] = (t + b) / (t - b);
  matrix[2][2] = std::isinf(f) ? -1 : -(f + n) / (f - n), matrix[3][2] = std::isinf(f) ? -2 * n : -2 * f * n / (f - n);
  matrix[2][3] = -1;
  return matrix;
}

/// The scene, seen from where it is seen, through such a matrix: in view coordinates that are right-handed.
inline Scene seen_through(Scene scene, const glm::dmat4& projection, double near, double far) {
  Camera& camera = scene.camera;
  glm::dmat4 view = camera.view;
  for (int column = 0; column < 4; ++column) view[column][2] = -view[column][2];
  camera.matrices = {view, projection};
  camera.near = near, camera.far = std::isinf(far) ? infinitely_far * near : far;
  REQUIRE(take_matrices(camera, scene.raster));
  return scene;
}

}  // namespace zstep::test
