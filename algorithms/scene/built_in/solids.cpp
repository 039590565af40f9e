#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include <glm/geometric.hpp>

#include "algorithms/scene/built_in/built_in.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::scene {

namespace {

std::string no_place() { return "built-in mesh"; }

PolygonSoup solid(std::initializer_list<glm::dvec3> points,
                  std::initializer_list<std::initializer_list<int>> outlines) {
  PolygonSoup soup;
  soup.points = points;
  for (const auto& outline : outlines) {
    for (const int corner : outline) soup.add_corner(corner, no_place);
    soup.close_outline(0, std::nullopt, no_place);
  }
  return soup;
}

PolygonSoup cube_solid() {
  return solid({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
               {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}, {3, 2, 1, 0}});
}

PolygonSoup pyramid_solid() {
  return solid({{1, 1, -1}, {-1, 1, -1}, {-1, -1, -1}, {1, -1, -1}, {0, 0, 1}},
               {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {3, 2, 1, 0}});
}

/// Twelve pentagons, their planes perpendicular to the directions of an icosahedron's corners (0, ±g, ±1), (±g, ±1, 0),
/// (±1, 0, ±g). The corners: those of a cube and (0, ±1/g, ±g), (±1/g, ±g, 0), (±g, 0, ±1/g), g the golden ratio.
PolygonSoup dodecahedron_solid() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  PolygonSoup soup;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) soup.points.push_back({x, y, z});
  std::vector<glm::dvec3> directions;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      for (const glm::dvec3 p : {glm::dvec3(0, a / g, b * g), glm::dvec3(a / g, b * g, 0), glm::dvec3(b * g, 0, a / g)})
        soup.points.push_back(p);
      for (const glm::dvec3 n : {glm::dvec3(0, b * g, a), glm::dvec3(b * g, a, 0), glm::dvec3(a, 0, b * g)})
        directions.push_back(n);
    }
  for (const glm::dvec3 n : directions) {
    std::vector<std::int32_t> ring;  // the five corners furthest out in this direction
    for (std::size_t i = 0; i < soup.points.size(); ++i)
      if (glm::dot(soup.points[i], n) > 2.5) ring.push_back(static_cast<std::int32_t>(i));
    const glm::dvec3 middle = n * (glm::dot(soup.points[static_cast<std::size_t>(ring[0])], n) / glm::dot(n, n));
    const glm::dvec3 u = soup.points[static_cast<std::size_t>(ring[0])] - middle, v = glm::cross(n, u) / glm::length(n);
    std::sort(ring.begin(), ring.end(), [&](std::int32_t a, std::int32_t b) {
      const auto angle = [&](std::int32_t i) {
        const glm::dvec3 p = soup.points[static_cast<std::size_t>(i)] - middle;
        const double turn = portable::atan2(glm::dot(p, v), glm::dot(p, u));
        return turn < -1e-9 ? turn + 7 : turn;
      };
      return angle(a) < angle(b);
    });
    for (const std::int32_t corner : ring) soup.add_corner(corner, no_place);
    soup.close_outline(0, std::nullopt, no_place);
  }
  return soup;
}

}  // namespace

std::vector<std::string_view> built_in_meshes() { return {"cube", "pyramid", "dodecahedron", "teapot"}; }

std::optional<PolygonSoup> built_in_mesh(const std::string& name, const std::string& where) {
  if (name == "cube") return cube_solid();
  if (name == "pyramid") return pyramid_solid();
  if (name == "dodecahedron") return dodecahedron_solid();
  if (const auto level = teapot_level(name, where)) return teapot(*level);
  return std::nullopt;
}

}  // namespace zstep::scene
