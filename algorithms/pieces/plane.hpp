// Planes: A x + B y + C z + D = 0.
#pragma once

#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "traces/formulas/planes.hpp"

namespace zstep::pieces {

struct Plane {
  double a = 0, b = 0, c = 0, d = 0;

  glm::dvec3 normal() const { return {a, b, c}; }
  /// Zero on the plane; its sign tells the side. A distance where the normal has length 1.
  double value(glm::dvec3 point) const { return a * point.x + b * point.y + c * point.z + d; }
  /// z of the plane above (x, y): -(A x + B y + D)/C. Not finite where the plane is seen edge-on (C = 0).
  double depth(double x, double y) const { return formulas::plane_depth(a, b, c, d, x, y); }
  Plane flipped() const { return {-a, -b, -c, -d}; }
};

/// The plane of a polygon: Newell's normal, of length 1, through the mean of its corners. All zero when the polygon
/// encloses no area. M. E. Newell, after Sutherland, Sproull and Schumacker, "A Characterization of Ten Hidden-Surface
/// Algorithms", 1974.
Plane plane_of(std::span<const glm::dvec3> corners);

/// The largest distance of a corner from the polygon's plane. Of polygons in files it is that of the last digit.
double bend_of(const Plane& plane, std::span<const glm::dvec3> corners);

}  // namespace zstep::pieces
