#include "algorithms/scene/scene_file/placement.hpp"

#include <cmath>

#include <fmt/format.h>

#include "traces/math/portable_math.hpp"

namespace zstep::scene {

namespace {

/// Counter-clockwise about the axis, seen from its tip. Right angles are exact, so that a turned cube stays a cube.
glm::dmat3 rotation(int axis, double degrees) {
  int quadrant = 0;
  const double rest = std::remquo(degrees, 90.0, &quadrant) * (3.14159265358979323846 / 180);
  double c = portable::cos(rest), s = portable::sin(rest);
  for (int i = 0; i < (quadrant & 3); ++i) {
    const double old = c;
    c = -s;
    s = old;
  }
  glm::dmat3 turn(1);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  turn[u][u] = c;
  turn[u][v] = s;
  turn[v][u] = -s;
  turn[v][v] = c;
  return turn;
}

}  // namespace

Placement read_placement(Keys& keys, const std::string& file) {
  Placement placement;
  if (const toml::node* node = keys.find("scale")) {
    const glm::dvec3 scale =
        node->is_number() ? glm::dvec3(number_in(*node, file, "scale")) : point_in(*node, file, "scale");
    if (scale.x == 0 || scale.y == 0 || scale.z == 0)
      fail_at(*node, file, "a scale of 0 makes the mesh flat", "use another");
    for (int axis = 0; axis < 3; ++axis) placement.linear[axis][axis] = scale[axis];
  }
  if (const auto angles = keys.point("rotate"))
    for (int axis = 0; axis < 3; ++axis) placement.linear = rotation(axis, (*angles)[axis]) * placement.linear;
  placement.offset = keys.point("translate").value_or(glm::dvec3(0));
  return placement;
}

}  // namespace zstep::scene
