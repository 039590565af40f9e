// Polygons into planar facets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "traces/scene.hpp"

namespace zstep::scene {

/// Newell's normal: the sum of the cross products of neighbouring corners, seen from the first. Its length is twice the
/// area that the polygon encloses, its direction that from which the corners run counter-clockwise. M. E. Newell, after
/// I. E. Sutherland, R. F. Sproull and R. A. Schumacker, "A Characterization of Ten Hidden-Surface Algorithms", 1974.
glm::dvec3 newell_normal(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners);

/// Whether no corner is further from the polygon's plane (through the mean of its corners, along Newell's normal) than
/// planarity_tolerance times the diagonal of its bounding box. Polygons that enclose no area are planar if their
/// corners lie on one line.
inline constexpr double planarity_tolerance = 1e-5;
bool is_planar(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners);

/// Cuts polygons that are not planar into triangles.
class EarClipper {
 public:
  /// Appends the corners of corners.size() - 2 triangles, each in the order of the polygon, to `triangles`. Ears are
  /// cut in the plane of Newell's normal; where the outline crosses itself there and no ear is left, the sharpest
  /// corner is cut. False, with nothing appended, when the work in all calls together would take too long (see
  /// most_steps).
  bool cut(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners,
           std::vector<std::int32_t>& triangles);

  static constexpr std::int64_t most_steps = 500'000'000;

 private:
  std::int64_t steps_ = 0;
};

/// The outline that EarClipper cuts into just these triangles: empty where there is none.
std::vector<std::int32_t> outline_of(std::span<const glm::dvec3> points, std::span<const std::int32_t> triangles);

/// Puts the polygons of a scene into another order, and the facets with them: polygon k becomes place_of[k].
void put_in_order(Scene& scene, std::span<const std::int32_t> place_of);

}  // namespace zstep::scene
