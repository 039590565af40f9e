// An attribute of a polygon's vertices, from these to a pixel: a texture coordinate, a shade, whatever is linear on the
// polygon itself.
//
// Under perspective a is not linear on the picture, but a/z_v and 1/z_v are. So both are interpolated as depths are,
// and divided at each pixel: J. F. Blinn, Hyperbolic Interpolation, IEEE Computer Graphics and Applications 12(4),
// 1992; P. S. Heckbert and H. P. Moreton, Interpolation for Polygon Texture Mapping and Shading, in State of the Art in
// Computer Graphics, 1991.
#pragma once

#include <cmath>
#include <cstdint>

#include "traces/formulas/outlines.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

/// What is interpolated of an attribute.
template <class T>
struct OverDepth {
  T over_z, one_over_z;  ///< a/z_v and 1/z_v; a and 1 where a itself is linear on the picture, or taken for it
};
template <class T>
OverDepth<T> over_depth(const T& a, const T& z_v) {
  return {a / z_v, T(1) / z_v};
}
template <class T>
OverDepth<T> on_line(const OverDepth<T>& p_0, const OverDepth<T>& p_1, const T& q, const T& q_0, const T& q_1) {
  return {on_line(p_0.over_z, p_1.over_z, q, q_0, q_1), on_line(p_0.one_over_z, p_1.one_over_z, q, q_0, q_1)};
}

/// By how much the attribute is off at t of the way between depths z_0 and z_1 where a itself is taken for linear on
/// the picture: what is computed minus what is right.
template <class T>
T linear_attribute_error(const T& a_0, const T& a_1, const T& z_0, const T& z_1, const T& t) {
  return (a_1 - a_0) * t * (T(1) - t) * (z_1 - z_0) / (z_1 - t * (z_1 - z_0));
}

/// Is a divided by z_v before it is interpolated? Parallel projection leaves it linear.
inline bool attribute_over_depth(const Scene& scene, const Conventions& conventions) {
  return conventions.attribute == Conventions::Attribute::perspective && scene.camera.kind == Camera::Kind::perspective;
}

/// The attribute of a vertex is its x_w, as if a texture were projected along y and z. Of a vertex that clipping made,
/// it follows from its view coordinates: T_v turns and moves, so its inverse has T_v's columns for rows.
inline double attribute_of(const Scene& scene, std::int32_t vertex, const glm::dvec3& view) {
  if (vertex >= 0 && vertex < std::ssize(scene.points)) return scene.points[vertex].x;
  const glm::dmat4& t_v = scene.camera.view;
  return t_v[0][0] * (view.x - t_v[3][0]) + t_v[0][1] * (view.y - t_v[3][1]) + t_v[0][2] * (view.z - t_v[3][2]);
}

/// The attribute is seen as stripes, so many to a unit of it; every other one keeps this part of its polygon's colour.
inline constexpr double stripes_a_unit = 4, in_dark_stripe = 0.45;
inline double stripe_shade(double a) { return std::fmod(std::floor(a * stripes_a_unit), 2) == 0 ? 1 : in_dark_stripe; }
/// Whether a is so near to the edge of a stripe that its last digits decide which one it is in.
inline bool at_stripe_edge(double a) {
  constexpr double some = 1e-6;
  return std::abs(a * stripes_a_unit - std::round(a * stripes_a_unit)) < some * (1 + std::abs(a));
}

}  // namespace zstep::formulas
