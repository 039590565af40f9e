// What is interpolated over a polygon to shade it, and what it makes of the polygon's colour.
//
// Gouraud: light is computed at the vertices, and interpolated (H. Gouraud, Continuous Shading of Curved Surfaces, IEEE
// Transactions on Computers C-20(6), 1971). Phong: the normal is interpolated, and light computed at each pixel (Bui
// Tuong Phong, Illumination for Computer Generated Pictures, CACM 18(6), 1975), with eye and lamp as far away as there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "traces/conventions.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

enum class Shade : std::uint8_t {
  stripes,   ///< x_w, as if a texture were projected along y and z: stripes of the polygon's colour
  scalar,    ///< the scene's first attribute of one number, as stripes, too
  colors,    ///< colours of the vertices
  gouraud,   ///< light at the vertices, by their normals
  phong,     ///< normals of the vertices, and light at the pixel
  checker,   ///< texture coordinates, as the squares of a checker of the polygon's colour
  nearest,   ///< texture coordinates, and the texel in which they lie
  bilinear,  ///< texture coordinates, and the four texels whose centres are round them
};
}  // namespace zstep::formulas

namespace zstep {
template <>
inline constexpr std::array<std::string_view, 8> words_of<formulas::Shade>{"stripes", "scalar",  "colors",  "gouraud",
                                                                           "phong",   "checker", "nearest", "bilinear"};
}

namespace zstep::formulas {

inline constexpr const char* shade_key = "shade";  ///< of Conventions::options

/// The numbers that a shade interpolates, and the attribute of the vertices that they are made of.
struct Ingredients {
  const char* attribute;                  ///< its name in the scene; nullptr: none by a name
  std::string_view called;                ///< for who has none
  std::int32_t components;                ///< numbers that the attribute has at least
  std::array<std::string_view, 3> names;  ///< of what is interpolated
  std::int32_t count;                     ///< of them
};
inline constexpr ByEnum<Shade, Ingredients> ingredients{{{
    {nullptr, "x_w", 0, {"a"}, 1},
    {nullptr, "an attribute of one number", 1, {"a"}, 1},
    {color_attribute, "colours", 3, {"red", "green", "blue"}, 3},
    {normal_attribute, "normals", 3, {"diffuse", "highlight"}, 2},
    {normal_attribute, "normals", 3, {"n_x", "n_y", "n_z"}, 3},
    {uv_attribute, "texture coordinates", 2, {"u", "v"}, 2},
    {uv_attribute, "texture coordinates", 2, {"u", "v"}, 2},
    {uv_attribute, "texture coordinates", 2, {"u", "v"}, 2},
}}};
constexpr bool is_of_texture(Shade shade) { return shade == Shade::nearest || shade == Shade::bilinear; }
constexpr bool is_of_light(Shade shade) { return shade == Shade::gouraud || shade == Shade::phong; }
constexpr bool is_of_stripes(Shade shade) { return shade == Shade::stripes || shade == Shade::scalar; }

/// A direction at length 1; nothing stays nothing.
inline glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}
/// Unit vectors from every point of the scene: lamp and eye are taken as infinitely far away, where they are not.
struct Lighting {
  glm::dvec3 to_light{0}, to_eye{0};
};
/// Without a lamp the light comes from where the eye is.
inline Lighting lighting_of(const Scene& scene) {
  const Camera& camera = scene.camera;
  const glm::dvec3 ahead = camera.kind == Camera::Kind::screen
                               ? glm::dvec3(0, 0, 1)
                               : glm::dvec3(camera.view[0][2], camera.view[1][2], camera.view[2][2]);
  const glm::dvec3 to_eye = -unit(ahead);
  return {scene.light ? unit(scene.light->position - scene.light->target) : to_eye, to_eye};
}

/// What a point sends to the eye: a part of its own colour, and of white besides.
struct Reflected {
  double diffuse, highlight;
};
inline constexpr double ambient_light = 0.2, highest_light = 0.5;
inline constexpr int sharpness_doublings = 5;  ///< of cos's exponent: 32
/// Lambert's cosine of the angle between normal and lamp, over a part that comes from everywhere; and a power of the
/// cosine between the eye and the mirrored ray to the lamp.
inline Reflected reflected(const Lighting& lighting, const glm::dvec3& normal) {
  const glm::dvec3 n = unit(normal);
  const double towards_light = glm::dot(n, lighting.to_light);
  if (!(towards_light > 0)) return {ambient_light, 0};
  double mirrored = std::max(0.0, glm::dot(2 * towards_light * n - lighting.to_light, lighting.to_eye));
  for (int i = 0; i < sharpness_doublings; ++i) mirrored *= mirrored;
  return {ambient_light + (1 - ambient_light) * towards_light, highest_light * mirrored};
}

/// What a run interpolates to shade a pixel, one number after the other.
struct Shading {
  Shade shade = Shade::stripes;
  const VertexAttribute* attribute = nullptr;  ///< none: x_w
  Lighting lighting{};

  std::int32_t components() const { return ingredients[shade].count; }
  std::string_view name(std::int32_t component) const {
    return attribute ? ingredients[shade].names[static_cast<std::size_t>(component)] : "x_w";
  }
  /// Does the scene have what the shade is made of?
  bool is_known() const { return shade == Shade::stripes || attribute != nullptr; }
};
inline Shade shade_of(const Conventions& conventions) {
  const auto given = conventions.options.find(shade_key);
  return given == conventions.options.end() ? Shade::stripes
                                            : value_called<Shade>(given->second).value_or(Shade::stripes);
}
inline Shading shading_of(const Scene& scene, const Conventions& conventions) {
  Shading shading;
  shading.shade = shade_of(conventions);
  if (shading.shade == Shade::stripes) return shading;
  const Ingredients& of = ingredients[shading.shade];
  for (const VertexAttribute& attribute : scene.attributes) {
    const bool is_it = of.attribute ? attribute.name == of.attribute && attribute.components >= of.components
                                    : attribute.components == of.components;
    if (is_it && !shading.attribute) shading.attribute = &attribute;
  }
  if (is_of_light(shading.shade)) shading.lighting = lighting_of(scene);
  return shading;
}

/// A number that is interpolated, at a vertex of a polygon; 0 where the vertex has no value.
inline double at_vertex(const Shading& shading, std::int32_t polygon, std::int32_t point, std::int32_t component) {
  const VertexAttribute& attribute = *shading.attribute;
  const std::int32_t value = attribute.value_of(polygon, point);
  if (value == no_value) return 0;
  const double* numbers = attribute.values.data() + static_cast<std::ptrdiff_t>(value) * attribute.components;
  if (shading.shade != Shade::gouraud) return numbers[component];
  const Reflected light = reflected(shading.lighting, {numbers[0], numbers[1], numbers[2]});
  return component == 0 ? light.diffuse : light.highlight;
}

/// The same at a vertex of a facet that clipping may have made. Then it follows from its view coordinates: for x_w by
/// T_v, which turns and moves, so that its inverse has T_v's columns for rows; else on the plane through the facet's
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
  const auto at = [&](std::int32_t point) { return at_vertex(shading, of.polygon, point, component); };
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
  if (!(size > 0)) return at(corners[0]);
  const glm::dvec3 p = view_of(corners[best]) - origin, q = view_of(corners[best + 1]) - origin, here = view - origin;
  const double s = glm::dot(glm::cross(here, q), normal) / size, t = glm::dot(glm::cross(p, here), normal) / size;
  const double a_0 = at(corners[0]);
  return a_0 + s * (at(corners[best]) - a_0) + t * (at(corners[best + 1]) - a_0);
}

/// So many stripes, or squares of a checker, to a unit; every other one keeps this part of its polygon's colour.
inline constexpr double stripes_a_unit = 4, in_dark_stripe = 0.45;
inline double stripe_shade(double a) { return std::fmod(std::floor(a * stripes_a_unit), 2) == 0 ? 1 : in_dark_stripe; }
inline double checker_shade(double u, double v) {
  return std::fmod(std::floor(u * stripes_a_unit) + std::floor(v * stripes_a_unit), 2) == 0 ? 1 : in_dark_stripe;
}

/// Where texture coordinates lie on an image, in texels from its lower left corner, as OBJ has them. It is repeated
/// beyond its edges.
struct OnTexture {
  double column, row;
};
inline OnTexture on_texture(const Texture& texture, double u, double v) {
  return {(u - std::floor(u)) * texture.width, (v - std::floor(v)) * texture.height};
}
/// A texel, counted from there; its numbers may lie beyond the edges by as many as the image has.
inline Color texel(const Texture& texture, std::int32_t column, std::int32_t row) {
  const std::int32_t x = (column + texture.width) % texture.width, y = (row + texture.height) % texture.height;
  return texture.texels[pixel_at(x, texture.height - 1 - y, texture.width)];
}
inline Color nearest_texel(const Texture& texture, double u, double v) {
  const auto [column, row] = on_texture(texture, u, v);
  return texel(texture, static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
}
/// The four texels, left before right and lower before upper, and what part of the colour each gives.
struct FourTexels {
  std::array<Color, 4> color;
  std::array<double, 4> part;
};
inline FourTexels four_texels(const Texture& texture, double u, double v) {
  const auto [column, row] = on_texture(texture, u, v);
  const double left = std::floor(column - 0.5), lower = std::floor(row - 0.5);
  const double right_part = column - 0.5 - left, upper_part = row - 0.5 - lower;
  const auto x = static_cast<std::int32_t>(left), y = static_cast<std::int32_t>(lower);
  return {{texel(texture, x, y), texel(texture, x + 1, y), texel(texture, x, y + 1), texel(texture, x + 1, y + 1)},
          {(1 - right_part) * (1 - upper_part), right_part * (1 - upper_part), (1 - right_part) * upper_part,
           right_part * upper_part}};
}

/// The texture of a polygon; nullptr where it has none.
inline const Texture* texture_of(const Scene& scene, std::int32_t polygon) {
  const std::int32_t texture = scene.polygons[polygon].material->texture;
  return texture == no_texture ? nullptr : &scene.textures[texture];
}

/// The three channels of a pixel of a polygon, 0 to 255, not rounded, from the numbers that were interpolated there.
inline std::array<double, 3> shaded(const Scene& scene, const Shading& shading, std::int32_t polygon,
                                    std::span<const double> a) {
  const auto channels = [](const Color& color, double part = 1) {
    return std::array<double, 3>{color.red * part, color.green * part, color.blue * part};
  };
  const Color& own = scene.polygons[polygon].color;
  const auto lit = [&](const Reflected& light) {
    std::array<double, 3> result = channels(own, light.diffuse);
    for (double& channel : result) channel = std::clamp(channel + 255 * light.highlight, 0.0, 255.0);
    return result;
  };
  const Texture* texture = is_of_texture(shading.shade) ? texture_of(scene, polygon) : nullptr;
  switch (shading.shade) {
    case Shade::colors: {
      std::array<double, 3> result{};
      for (std::size_t k = 0; k < 3; ++k) result[k] = 255 * std::clamp(a[k], 0.0, 1.0);
      return result;
    }
    case Shade::gouraud:
      return lit({a[0], a[1]});
    case Shade::phong:
      return lit(reflected(shading.lighting, {a[0], a[1], a[2]}));
    case Shade::checker:
      return channels(own, checker_shade(a[0], a[1]));
    case Shade::nearest:
      return channels(texture ? nearest_texel(*texture, a[0], a[1]) : own);
    case Shade::bilinear: {
      if (!texture) return channels(own);
      const FourTexels four = four_texels(*texture, a[0], a[1]);
      std::array<double, 3> result{};
      for (std::size_t i = 0; i < 4; ++i) {
        const std::array<double, 3> of_one = channels(four.color[i], four.part[i]);
        for (std::size_t k = 0; k < 3; ++k) result[k] += of_one[k];
      }
      return result;
    }
    case Shade::stripes:
    case Shade::scalar:
      break;
  }
  return channels(own, stripe_shade(a[0]));
}

/// Whether these numbers are so near to where the colour jumps (the edge of a stripe, a square or a texel, light that
/// only grazes) that their last digits decide.
inline bool at_shade_edge(const Scene& scene, const Shading& shading, std::int32_t polygon, std::span<const double> a) {
  constexpr double some = 1e-6;
  const auto at_whole = [](double value) { return std::abs(value - std::round(value)) < some * (1 + std::abs(value)); };
  if (is_of_stripes(shading.shade)) return at_whole(a[0] * stripes_a_unit);
  if (shading.shade == Shade::checker) return at_whole(a[0] * stripes_a_unit) || at_whole(a[1] * stripes_a_unit);
  if (shading.shade == Shade::phong)
    return std::abs(glm::dot(unit(glm::dvec3(a[0], a[1], a[2])), shading.lighting.to_light)) < some;
  const Texture* texture = is_of_texture(shading.shade) ? texture_of(scene, polygon) : nullptr;
  if (!texture) return false;
  if (shading.shade == Shade::nearest) return at_whole(a[0] * texture->width) || at_whole(a[1] * texture->height);
  return std::max(std::abs(a[0]), std::abs(a[1])) * std::max(texture->width, texture->height) > 1 / some;
}

}  // namespace zstep::formulas
