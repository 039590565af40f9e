// An attribute of a polygon's vertices, from these to a pixel: a texture coordinate, a colour, whatever is linear on
// the polygon itself.
//
// Under perspective a is not linear on the picture, but a/z_v and 1/z_v are. So both are interpolated as depths are,
// and divided at each pixel: J. F. Blinn, Hyperbolic Interpolation, IEEE Computer Graphics and Applications 12(4),
// 1992; P. S. Heckbert and H. P. Moreton, Interpolation for Polygon Texture Mapping and Shading, in State of the Art in
// Computer Graphics, 1991.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include <glm/geometric.hpp>

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

/// What an attribute makes of a polygon's colour.
enum class Shade : std::uint8_t {
  stripes,  ///< x_w, as if a texture were projected along y and z: stripes of the polygon's colour
  gouraud,  ///< colours of the vertices: H. Gouraud, Continuous Shading of Curved Surfaces, 1971
  checker,  ///< texture coordinates: the squares of a checker, of the polygon's colour
};
}  // namespace zstep::formulas

namespace zstep {
template <>
inline constexpr std::array<std::string_view, 3> words_of<formulas::Shade>{"stripes", "gouraud", "checker"};
}

namespace zstep::formulas {

inline constexpr const char* shade_key = "shade";  ///< of Conventions::options
inline constexpr ByEnum<Shade, const char*> attribute_of_shade{nullptr, color_attribute, uv_attribute};

/// The numbers that a run interpolates, one after the other, to shade a pixel.
struct Shading {
  Shade shade = Shade::stripes;
  const VertexAttribute* attribute = nullptr;  ///< none: x_w
  std::int32_t components = 1;

  /// Does the scene have what the shade is made of?
  bool is_known() const { return shade == Shade::stripes || attribute != nullptr; }
};
inline Shading shading_of(const Scene& scene, const Conventions& conventions) {
  Shading shading;
  const auto given = conventions.options.find(shade_key);
  if (given == conventions.options.end()) return shading;
  shading.shade = value_called<Shade>(given->second).value_or(Shade::stripes);
  if (shading.shade == Shade::stripes) return shading;
  shading.attribute = attribute_named(scene, attribute_of_shade[shading.shade]);
  shading.components = shading.shade == Shade::gouraud ? 3 : 2;
  if (shading.attribute && shading.attribute->components < shading.components) shading.attribute = nullptr;
  return shading;
}

/// Which of them is called what.
inline std::string_view component_name(Shade shade, std::int32_t component) {
  constexpr std::array<std::string_view, 3> colors{"red", "green", "blue"};
  constexpr std::array<std::string_view, 2> texture{"u", "v"};
  const std::size_t k = component;
  return shade == Shade::gouraud ? colors[k] : shade == Shade::checker ? texture[k] : "a";
}

/// A component at a vertex of a polygon; 0 where it has none.
inline double component_of(const VertexAttribute& attribute, std::int32_t polygon, std::int32_t point,
                           std::int32_t component) {
  const std::int32_t value = attribute.value_of(polygon, point);
  return value == no_value ? 0 : attribute.values[static_cast<std::size_t>(value) * attribute.components + component];
}

/// A component at a vertex of a facet. Of a vertex that clipping made, it follows from its view coordinates: for x_w
/// by T_v, which turns and moves, so that its inverse has T_v's columns for rows; else on the plane through the facet's
/// first vertex and the two neighbours that make the largest triangle with it. `view_of` gives view coordinates of
/// points.
template <class ViewOf>
double attribute_of(const Scene& scene, const Shading& shading, std::int32_t component, std::int32_t facet,
                    std::int32_t vertex, const glm::dvec3& view, ViewOf&& view_of) {
  const bool is_point = vertex >= 0 && vertex < std::ssize(scene.points);
  if (!shading.attribute) {
    if (is_point) return scene.points[vertex].x;
    const glm::dmat4& t_v = scene.camera.view;
    return t_v[0][0] * (view.x - t_v[3][0]) + t_v[0][1] * (view.y - t_v[3][1]) + t_v[0][2] * (view.z - t_v[3][2]);
  }
  if (facet < 0 || facet >= std::ssize(scene.facets)) return 0;
  const Facet& of = scene.facets[facet];
  const auto at = [&](std::int32_t point) { return component_of(*shading.attribute, of.polygon, point, component); };
  if (is_point) return at(vertex);
  const std::span corners(scene.corners.data() + of.first_corner, static_cast<std::size_t>(of.corner_count));
  if (corners.size() < 3) return 0;
  const glm::dvec3 origin = view_of(corners[0]);
  std::size_t best = 1;
  glm::dvec3 normal(0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const glm::dvec3 across = glm::cross(view_of(corners[i]) - origin, view_of(corners[i + 1]) - origin);
    if (glm::dot(across, across) > glm::dot(normal, normal)) best = i, normal = across;
  }
  const double size = glm::dot(normal, normal);
  if (size == 0) return at(corners[0]);
  const glm::dvec3 p = view_of(corners[best]) - origin, q = view_of(corners[best + 1]) - origin, here = view - origin;
  const double s = glm::dot(glm::cross(here, q), normal) / size, t = glm::dot(glm::cross(p, here), normal) / size;
  const double a_0 = at(corners[0]);
  return a_0 + s * (at(corners[best]) - a_0) + t * (at(corners[best + 1]) - a_0);
}

/// The attribute is seen as stripes, so many to a unit of it; every other one keeps this part of its polygon's colour.
inline constexpr double stripes_a_unit = 4, in_dark_stripe = 0.45;
inline double stripe_shade(double a) { return std::fmod(std::floor(a * stripes_a_unit), 2) == 0 ? 1 : in_dark_stripe; }
/// Whether a is so near to the edge of a stripe that its last digits decide which one it is in.
inline bool at_stripe_edge(double a) {
  constexpr double some = 1e-6;
  return std::abs(a * stripes_a_unit - std::round(a * stripes_a_unit)) < some * (1 + std::abs(a));
}

/// Squares, as many to a unit of u and of v.
inline double checker_shade(double u, double v) {
  return std::fmod(std::floor(u * stripes_a_unit) + std::floor(v * stripes_a_unit), 2) == 0 ? 1 : in_dark_stripe;
}

/// The three channels of a pixel of a polygon of this colour, 0 … 255, not rounded, from the numbers that were
/// interpolated there.
inline std::array<double, 3> shaded(Shade shade, const Color& color, std::span<const double> a) {
  std::array<double, 3> channels{};
  const std::array<double, 3> own{double(color.red), double(color.green), double(color.blue)};
  for (std::size_t k = 0; k < 3; ++k)
    channels[k] = shade == Shade::gouraud   ? 255 * std::clamp(a[k], 0.0, 1.0)
                  : shade == Shade::checker ? own[k] * checker_shade(a[0], a[1])
                                            : own[k] * stripe_shade(a[0]);
  return channels;
}
/// Whether these numbers are so near to the edge of a stripe or a square that their last digits decide.
inline bool at_shade_edge(Shade shade, std::span<const double> a) {
  return shade == Shade::stripes ? at_stripe_edge(a[0])
                                 : shade == Shade::checker && (at_stripe_edge(a[0]) || at_stripe_edge(a[1]));
}

}  // namespace zstep::formulas
