// Scenes for the painter's algorithm and depth sort.
#pragma once

#include <cmath>
#include <vector>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"

namespace zstep::test {

using Ring = std::vector<glm::dvec3>;

/// A square parallel to the raster.
inline Ring square(double x, double y, double side, double z) {
  return {{x, y, z}, {x + side, y, z}, {x + side, y + side, z}, {x, y + side, z}};
}

/// A rectangle whose z runs from `z_left` to `z_right`.
inline Ring slope(double left, double right, double low, double high, double z_left, double z_right) {
  return {{left, low, z_left}, {right, low, z_right}, {right, high, z_right}, {left, high, z_left}};
}

/// The second, small one lies behind the near end of the first, long one, whose far end is farther.
inline Scene slanting_past() { return screen_scene(16, 10, {slope(0, 14, 1, 8, 0, 14), square(1.5, 2.5, 3, 7)}); }

/// Pixels at which the Z-buffer shows another polygon than the picture, their depths differing by more than 1e-5.
inline int wrong_pixels(const Scene& scene, const Conventions& conventions, const Picture& picture) {
  NullRecorder nothing;
  const Picture right = z_buffer::run(scene, conventions, nothing);
  int wrong = 0;
  for (std::size_t i = 0; i < right.polygon.size(); ++i) {
    if (right.polygon[i] == picture.polygon[i]) continue;
    if (!(std::abs(right.depth[i] - picture.depth[i]) <= 1e-5 * std::max(1.0, std::abs(right.depth[i])))) ++wrong;
  }
  return wrong;
}

}  // namespace zstep::test
