// Which depths a depth buffer can hold: how far apart they are, and how many there are.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "traces/formulas/rounding.hpp"

namespace zstep::formulas {

/// How far apart in z_v two neighbouring numbers of the depth buffer are at this z_v: what it cannot tell apart.
inline double resolution(const Scene& scene, const Conventions& conventions, double z_v) {
  const double depth = buffer_depth(scene.camera, conventions, z_v);
  const double unit = last_digit(depth, conventions.number_format, depth_unit(scene, conventions));
  return std::abs(view_depth_error(scene.camera, conventions, depth, unit));
}

/// How many numbers the depth buffer has between two depths z_v, counting one of the two.
inline double depths_between(const Scene& scene, const Conventions& conventions, double z_v, double other) {
  const double a = buffer_depth(scene.camera, conventions, z_v), b = buffer_depth(scene.camera, conventions, other);
  if (const double unit = depth_unit(scene, conventions); unit > 0) return std::abs(a - b) / unit;
  // The bits of a floating-point number, read as a whole one, count the numbers from 0 to it.
  const auto place = [&](double depth) {
    const double size = conventions.number_format == NumberFormat::float32
                            ? static_cast<double>(std::bit_cast<std::uint32_t>(static_cast<float>(std::abs(depth))))
                            : static_cast<double>(std::bit_cast<std::uint64_t>(std::abs(depth)));
    return depth < 0 ? -size : size;
  };
  return std::abs(place(a) - place(b));
}

/// The z_v between the near plane and the far one that as many of the buffer's depths are nearer than as are farther.
inline double middle_depth(const Scene& scene, const Conventions& conventions) {
  double from = scene.camera.near, to = scene.camera.far;
  const double half = depths_between(scene, conventions, from, to) / 2;
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = (from + to) / 2;
    (depths_between(scene, conventions, scene.camera.near, middle) < half ? from : to) = middle;
  }
  return (from + to) / 2;
}

}  // namespace zstep::formulas
