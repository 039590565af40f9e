#include "traces/lamp.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace zstep {

glm::dmat4 view_from_rows(glm::dvec4 row_1, glm::dvec4 row_2, glm::dvec4 row_3) {
  glm::dmat4 matrix(1.0);
  for (int column = 0; column < 4; ++column) {
    matrix[column][0] = row_1[column] + 0.0;  // -0 becomes 0: it is going to be read
    matrix[column][1] = row_2[column] + 0.0;
    matrix[column][2] = row_3[column] + 0.0;
  }
  return matrix;
}

glm::dmat4 look_at_view(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up) {
  const glm::dvec3 away = glm::normalize(target - eye);
  glm::dvec3 right = glm::cross(away, up);
  if (!(glm::length(right) > 1e-9 * glm::length(up))) {
    const glm::dvec3 along = glm::abs(away);
    const glm::dvec3 axis = along.z <= along.x && along.z <= along.y ? glm::dvec3(0, 0, 1)
                            : along.y <= along.x                     ? glm::dvec3(0, 1, 0)
                                                                     : glm::dvec3(1, 0, 0);
    right = glm::cross(away, axis);
  }
  right = glm::normalize(right);
  const glm::dvec3 upwards = glm::cross(right, away);
  return view_from_rows({right, -glm::dot(right, eye)}, {upwards, -glm::dot(upwards, eye)},
                        {away, -glm::dot(away, eye)});
}

Camera camera_of(const Light& light) {
  Camera camera;
  camera.polar = false;
  camera.d = 1;
  camera.window = light.window;
  camera.near = light.near;
  camera.far = light.far;
  camera.view = look_at_view(light.position, light.target, {0, 0, 1});
  camera.eye = light.position;
  return camera;
}

}  // namespace zstep
