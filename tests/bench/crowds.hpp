// The scenes at which a trace has its full size: many copies of one mesh, and very many very small triangles.
#pragma once

#include <random>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "algorithms/scene/load.hpp"
#include "tests/bench/scenes.hpp"

namespace zstep::bench {

/// A mesh of triangles, its centre at the origin and its farthest point at distance 1.
struct Mesh {
  std::vector<glm::dvec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The teapot at this level of tessellation; every facet of it as a fan of triangles.
inline Mesh teapot(int level) {
  const Scene scene = load_scene("teapot:" + std::to_string(level)).scene;
  Mesh mesh;
  mesh.points = scene.points;
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& point : mesh.points) low = glm::min(low, point), high = glm::max(high, point);
  double far = 0;
  for (glm::dvec3& point : mesh.points) point -= (low + high) / 2.0, far = std::max(far, glm::length(point));
  for (glm::dvec3& point : mesh.points) point /= far;
  for (const Facet& facet : scene.facets) {
    const auto corner = [&](std::int32_t i) { return scene.corners[static_cast<std::size_t>(facet.first_corner + i)]; };
    for (std::int32_t i = 1; i + 1 < facet.corner_count; ++i)
      mesh.triangles.push_back({corner(0), corner(i), corner(i + 1)});
  }
  return mesh;
}

/// Copies of the mesh, turned, sized and placed at random before the camera.
inline Scene crowd(const Mesh& mesh, int copies, std::int32_t width, std::int32_t height) {
  std::mt19937_64 random(48);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Scene scene;
  scene.name = std::to_string(copies) + " copies";
  for (int copy = 0; copy < copies; ++copy) {
    const glm::dvec3 x = glm::normalize(glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)));
    const glm::dvec3 y = glm::normalize(glm::cross(x, glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1))));
    const glm::dmat3 turn = glm::dmat3(x, y, glm::cross(x, y)) * between(2.1, 2.8);
    const glm::dvec3 to(between(-0.8, 0.8), between(-0.8, 0.8), between(-0.8, 0.8));
    const auto first = static_cast<std::int32_t>(scene.points.size());
    for (const glm::dvec3& point : mesh.points) scene.points.push_back(turn * point + to);
    for (const auto& triangle : mesh.triangles)
      add_polygon(scene, {first + triangle[0], first + triangle[1], first + triangle[2]});
  }
  look(scene, width, height);
  scene.camera.d = 2.6;
  scene.camera.near = 0.5;
  return scene;
}

}  // namespace zstep::bench
