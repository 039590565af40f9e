#include "algorithms/scene/facets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "traces/formulas/outlines.hpp"

namespace zstep::scene {

namespace {

const glm::dvec3& at(std::span<const glm::dvec3> points, std::int32_t corner) {
  return points[static_cast<std::size_t>(corner)];
}

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Drops the axis along which the normal is longest; what is left keeps the turning sense seen from the normal's tip.
glm::dvec2 flatten(glm::dvec3 p, glm::dvec3 normal) {
  const glm::dvec3 size = glm::abs(normal);
  if (size.z >= size.x && size.z >= size.y) return normal.z > 0 ? glm::dvec2(p.x, p.y) : glm::dvec2(p.y, p.x);
  if (size.x >= size.y) return normal.x > 0 ? glm::dvec2(p.y, p.z) : glm::dvec2(p.z, p.y);
  return normal.y > 0 ? glm::dvec2(p.z, p.x) : glm::dvec2(p.x, p.z);
}

}  // namespace

glm::dvec3 newell_normal(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners) {
  return formulas::newell_normal(glm::dvec3(0), corners.size(), [&](std::size_t i) { return at(points, corners[i]); });
}

bool is_planar(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners) {
  if (corners.size() <= 3) return true;
  glm::dvec3 low = at(points, corners[0]), high = low, mean(0);
  for (const std::int32_t corner : corners) {
    low = glm::min(low, at(points, corner));
    high = glm::max(high, at(points, corner));
    mean += at(points, corner) / static_cast<double>(corners.size());
  }
  const double extent = glm::length(high - low);
  const double tolerance = planarity_tolerance * extent;
  const glm::dvec3 normal = newell_normal(points, corners);
  if (glm::length(normal) > planarity_tolerance * extent * extent) {
    const glm::dvec3 unit = glm::normalize(normal);
    return std::all_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
      return std::abs(glm::dot(unit, at(points, corner) - mean)) <= tolerance;
    });
  }
  // No area, so no plane of Newell's: on one line, or an outline that crosses itself.
  const glm::dvec3 first = at(points, corners[0]);
  glm::dvec3 along(0);
  for (const std::int32_t corner : corners)
    if (glm::length(at(points, corner) - first) > glm::length(along)) along = at(points, corner) - first;
  if (glm::length(along) == 0) return true;
  return std::all_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
    return glm::length(glm::cross(at(points, corner) - first, along)) <= tolerance * glm::length(along);
  });
}

bool EarClipper::cut(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners,
                     std::vector<std::int32_t>& triangles) {
  const glm::dvec3 normal = newell_normal(points, corners);
  std::vector<glm::dvec2> flat;
  for (const std::int32_t corner : corners) flat.push_back(flatten(at(points, corner), normal));
  std::vector<std::int32_t> left(corners.size());  // places in `corners`, in order
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::int32_t>(i);
  const std::size_t before = triangles.size();

  const auto p = [&](std::size_t i) { return flat[static_cast<std::size_t>(left[i])]; };
  std::size_t start = 0;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t ear = n, sharpest = start % n;
    double sharpest_turn = -1e300;
    for (std::size_t k = 0; k < n && ear == n; ++k) {
      const std::size_t i = (start + k) % n, previous = (i + n - 1) % n, next = (i + 1) % n;
      const glm::dvec2 a = p(previous), b = p(i), c = p(next);
      const double turn = cross(b - a, c - b);
      if (turn > sharpest_turn) {
        sharpest_turn = turn;
        sharpest = i;
      }
      ++steps_;
      if (turn <= 0) continue;
      bool empty = true;
      for (std::size_t j = 0; j < n && empty; ++j) {
        if (j == previous || j == i || j == next) continue;
        ++steps_;
        const glm::dvec2 q = flat[static_cast<std::size_t>(left[j])];
        if (q == a || q == b || q == c) continue;  // the same place again, as where a hole is bridged
        empty = !(cross(b - a, q - a) >= 0 && cross(c - b, q - b) >= 0 && cross(a - c, q - c) >= 0);
      }
      if (empty) ear = i;
    }
    if (steps_ > most_steps) {
      triangles.resize(before);
      return false;
    }
    if (ear == n) ear = sharpest;
    const std::size_t previous = (ear + n - 1) % n, next = (ear + 1) % n;
    for (const std::size_t i : {previous, ear, next}) triangles.push_back(corners[static_cast<std::size_t>(left[i])]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    start = ear;  // the next candidate is the corner after the ear, so that ears come from all round
  }
  for (const std::int32_t i : left) triangles.push_back(corners[static_cast<std::size_t>(i)]);
  return true;
}

std::vector<std::int32_t> outline_of(std::span<const glm::dvec3> points, std::span<const std::int32_t> triangles) {
  // An edge that two triangles share runs once in each direction; those of the outline have no opposite.
  std::map<std::int32_t, std::int32_t> next;
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    edges.insert({triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1]});
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from}) && !next.try_emplace(from, to).second) return {};  // it meets itself
  std::vector<std::int32_t> ring;
  if (!next.empty())
    for (std::int32_t at = next.begin()->first; ring.size() < next.size() && next.contains(at); at = next.at(at))
      ring.push_back(at);
  if (3 * ring.size() != triangles.size() + 6) return {};
  EarClipper clipper;
  std::vector<std::int32_t> cut;
  for (std::size_t turned = 0; turned < ring.size(); ++turned) {
    cut.clear();
    if (clipper.cut(points, ring, cut) && std::equal(cut.begin(), cut.end(), triangles.begin(), triangles.end()))
      return ring;
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
  return {};
}

void put_in_order(Scene& scene, std::span<const std::int32_t> place_of) {
  const std::vector<Polygon> polygons = scene.polygons;
  for (std::size_t k = 0; k < polygons.size(); ++k) scene.polygons[static_cast<std::size_t>(place_of[k])] = polygons[k];
  std::vector<Facet> facets = std::exchange(scene.facets, {});
  const std::vector<std::int32_t> corners = std::exchange(scene.corners, {});
  for (Facet& facet : facets) facet.polygon = place_of[static_cast<std::size_t>(facet.polygon)];
  std::stable_sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.polygon < b.polygon; });
  for (Facet facet : facets) {
    const auto first = corners.begin() + facet.first_corner;
    facet.first_corner = static_cast<std::int32_t>(scene.corners.size());
    scene.corners.insert(scene.corners.end(), first, first + facet.corner_count);
    scene.facets.push_back(facet);
  }
}

}  // namespace zstep::scene
