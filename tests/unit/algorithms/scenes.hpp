// Small scenes, built where a test can read them.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "algorithms/viewing/camera.hpp"
#include "traces/scene.hpp"

namespace zstep::test {

inline void add_polygon(Scene& scene, const std::vector<std::int32_t>& corners) {
  const auto polygon = static_cast<std::int32_t>(scene.polygons.size());
  const auto first = static_cast<std::int32_t>(scene.corners.size());
  scene.polygons.push_back({"", {}, 0});
  scene.facets.push_back({polygon, first, static_cast<std::int32_t>(corners.size())});
  scene.corners.insert(scene.corners.end(), corners.begin(), corners.end());
}

inline void add_polygon(Scene& scene, const std::vector<glm::dvec3>& points) {
  std::vector<std::int32_t> corners;
  for (const glm::dvec3& point : points) {
    corners.push_back(static_cast<std::int32_t>(scene.points.size()));
    scene.points.push_back(point);
  }
  add_polygon(scene, corners);
}

/// Polygons of points (x_s, y_s, z) of their own, on a raster; nothing is viewed.
inline Scene screen_scene(std::int32_t width, std::int32_t height,
                          const std::vector<std::vector<glm::dvec3>>& polygons) {
  Scene scene;
  scene.camera.kind = Camera::Kind::screen;
  scene.raster = {width, height, false};
  for (const auto& polygon : polygons) add_polygon(scene, polygon);
  return scene;
}

/// Points the camera as Eckert does.
inline void look(Scene& scene, Camera::Kind kind, double rho, double theta, double phi, double near, double far) {
  Camera& camera = scene.camera;
  camera.kind = kind;
  camera.rho = rho, camera.theta = theta, camera.phi = phi;
  camera.near = near, camera.far = far;
  camera.view = viewing::eckert_view(rho, theta, phi);
  camera.eye = viewing::eckert_eye(kind == Camera::Kind::orthographic ? 1 : rho, theta, phi);
}

/// Points the camera from `eye` at `target`, z_w upwards in the picture.
inline void look(Scene& scene, Camera::Kind kind, glm::dvec3 eye, glm::dvec3 target, double near, double far) {
  Camera& camera = scene.camera;
  camera.kind = kind;
  camera.polar = false;
  camera.near = near, camera.far = far;
  camera.view = viewing::look_at_view(eye, target, {0, 0, 1});
  camera.eye = kind == Camera::Kind::orthographic ? glm::normalize(eye - target) : eye;
}

/// Random numbers that are the same with every library. Draw two in one call's arguments and compilers may swap them.
struct Numbers {
  std::mt19937_64 engine;
  explicit Numbers(std::uint64_t seed) : engine(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53; }
  glm::dvec3 in_box(double half) {
    const double x = between(-half, half), y = between(-half, half);
    return {x, y, between(-half, half)};
  }
};

/// A planar polygon around `centre` in a random plane: star-shaped, so concave more often than not, never crossing
/// itself.
inline std::vector<glm::dvec3> random_star(Numbers& random, glm::dvec3 centre, double radius, int corners) {
  const glm::dvec3 normal = glm::normalize(random.in_box(1) + glm::dvec3(1e-6));
  const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8))), v = glm::cross(normal, u);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = (i + random.between(0.1, 0.9)) * 6.28318530717958647692 / corners;
    const double length = radius * random.between(0.2, 1);
    points.push_back(centre + length * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return points;
}

/// The cube of corners ±half, its faces counter-clockwise from outside.
inline Scene cube(double half) {
  Scene scene;
  for (int corner = 0; corner < 8; ++corner) {
    scene.points.push_back({corner & 1 ? half : -half, corner & 2 ? half : -half, corner & 4 ? half : -half});
  }
  for (const auto& face : std::vector<std::vector<std::int32_t>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    add_polygon(scene, face);
  }
  return scene;
}

}  // namespace zstep::test
