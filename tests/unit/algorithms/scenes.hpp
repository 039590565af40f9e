// Small scenes, built where a test can read them.
#pragma once

#include <initializer_list>
#include <utility>
#include <vector>

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

/// Polygons of points (x_s, y_s, z) of their own, on a raster; nothing is viewed.
inline Scene screen_scene(std::int32_t width, std::int32_t height,
                          const std::vector<std::vector<glm::dvec3>>& polygons) {
  Scene scene;
  scene.camera.kind = Camera::Kind::screen;
  scene.raster = {width, height, false};
  for (const auto& polygon : polygons) {
    std::vector<std::int32_t> corners;
    for (const glm::dvec3& point : polygon) {
      corners.push_back(static_cast<std::int32_t>(scene.points.size()));
      scene.points.push_back(point);
    }
    add_polygon(scene, corners);
  }
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
