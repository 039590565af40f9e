// Scenes that benchmarks share, and how they reckon.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/viewing/camera.hpp"
#include "traces/scene.hpp"

namespace zstep::bench {

inline void look(Scene& scene, std::int32_t width, std::int32_t height) {
  scene.raster = {width, height, false};
  scene.camera.near = 1, scene.camera.far = 10;
  scene.camera.view = viewing::eckert_view(4, 30, 60);
  scene.camera.eye = viewing::eckert_eye(4, 30, 60);
}

inline void add_polygon(Scene& scene, const std::vector<std::int32_t>& corners) {
  scene.facets.push_back({static_cast<std::int32_t>(scene.polygons.size()),
                          static_cast<std::int32_t>(scene.corners.size()), static_cast<std::int32_t>(corners.size())});
  scene.corners.insert(scene.corners.end(), corners.begin(), corners.end());
  scene.polygons.push_back({});
}

/// A torus of rings x sides quadrilaterals, or of twice as many triangles.
inline Scene torus(int rings, int sides, bool triangles = false) {
  Scene scene;
  constexpr double turn = 6.28318530717958647692;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const double u = turn * i / rings, v = turn * j / sides, r = 2 + 0.8 * std::cos(v);
      scene.points.push_back({r * std::cos(u), r * std::sin(u), 0.8 * std::sin(v)});
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const int next_i = (i + 1) % rings, next_j = (j + 1) % sides;
      const std::int32_t quad[4] = {i * sides + j, next_i * sides + j, next_i * sides + next_j, i * sides + next_j};
      if (triangles) {
        add_polygon(scene, {quad[0], quad[1], quad[2]});
        add_polygon(scene, {quad[0], quad[2], quad[3]});
      } else {
        add_polygon(scene, {quad[0], quad[1], quad[2], quad[3]});
      }
    }
  }
  return scene;
}

/// Leaves through the z axis, each over much of the picture and through all others.
inline Scene leaves(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    const double angle = 3.14159265358979323846 * (i + 0.3) / count, x = 3 * std::cos(angle), y = 3 * std::sin(angle);
    const auto first = static_cast<std::int32_t>(scene.points.size());
    for (const double side : {-1.0, 1.0}) {
      scene.points.push_back({side * x, side * y, -side * 2});
      scene.points.push_back({side * x, side * y, side * 2});
    }
    add_polygon(scene, {first, first + 1, first + 2, first + 3});
  }
  return scene;
}

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// How many triangles its facets are, all of them convex.
inline std::int64_t triangles_in(const Scene& scene) {
  std::int64_t count = 0;
  for (const Facet& facet : scene.facets) count += facet.corner_count - 2;
  return count;
}

}  // namespace zstep::bench
