// An attribute of a polygon's vertices, from these to a pixel: a texture coordinate, a colour, whatever is linear on
// the polygon itself.
//
// Under perspective a is not linear on the picture, but a/z_v and 1/z_v are. So both are interpolated as depths are,
// and divided at each pixel: J. F. Blinn, Hyperbolic Interpolation, IEEE Computer Graphics and Applications 12(4),
// 1992; P. S. Heckbert and H. P. Moreton, Interpolation for Polygon Texture Mapping and Shading, in State of the Art in
// Computer Graphics, 1991.
#pragma once

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

}  // namespace zstep::formulas
