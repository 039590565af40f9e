#include "traces/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "traces/formulas/rounding.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep {

glm::dmat4 view_of_matrices(const glm::dmat4& projection, const Raster& raster) {
  const double aspect = static_cast<double>(raster.width) / raster.height;
  glm::dmat4 rows(0);
  for (int column = 0; column < 4; ++column) {
    rows[column][0] = projection[column][0] * aspect;
    rows[column][1] = projection[column][1];
    rows[column][2] = projection[column][3];
  }
  rows[3][3] = 1;
  return rows;
}

bool take_matrices(Camera& camera, const Raster& raster) {
  if (!camera.matrices) return true;
  camera.view = view_of_matrices(camera.matrices->projection, raster) * camera.matrices->view;
  camera.polar = false, camera.d = 1, camera.window = 1;
  const glm::dmat3 axes(camera.view);
  const double volume = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
  if (!(std::abs(glm::determinant(axes)) > 1e-12 * volume)) return false;
  camera.eye = -(glm::inverse(axes) * glm::dvec3(camera.view[3])) + 0.0;
  return true;
}

std::string planes_against_matrix(const Camera& camera) {
  if (!camera.matrices) return "";
  const glm::dmat4& m = camera.matrices->projection;
  const auto row = [&](int i) { return glm::dvec3(m[0][i], m[1][i], m[2][i]); };
  const glm::dvec3 z = row(2), w = row(3);
  if (z == glm::dvec3(0) && m[3][2] == 0) return "";
  // z_c = along w_c + rest, so that depths follow from the distance.
  const double along = glm::dot(z, w) / glm::dot(w, w), rest = m[3][2] - along * m[3][3];
  constexpr double rounding = 1e-4;  // of matrices in float32
  if (glm::length(z - along * w) > rounding * glm::length(z))
    return "the row of z_c of its projection does not go with the distance w_c";
  const double at_near = along + rest / camera.near, at_far = along + rest / camera.far;
  const auto [low, high] = camera.depth_range;
  for (const auto& [from, to] : {std::pair(-1.0, 1.0), {0.0, 1.0}, {1.0, 0.0}, {1.0, -1.0}, {low, high}, {high, low}})
    if (std::max(std::abs(at_near - from), std::abs(at_far - to)) <= rounding * std::abs(to - from)) return "";
  return fmt::format("the row of z_c of its projection gives {:.6g} at near = {} and {:.6g} at far = {}", at_near,
                     camera.near, at_far, is_infinitely_far(camera) ? "inf" : fmt::format("{}", camera.far));
}

double view_depth(const Camera& camera, const Conventions& conventions, double buffer_depth) {
  using enum Conventions::Depth;
  if (camera.kind == Camera::Kind::screen || std::isinf(buffer_depth)) return buffer_depth;
  const auto [low, high] = camera.depth_range;
  const bool ranged = conventions.depth == reversed || conventions.depth == zero_to_one;
  const double f = camera.near, F = camera.far, q = ranged ? (buffer_depth - low) / (high - low) : buffer_depth;
  const bool parallel = camera.kind == Camera::Kind::orthographic;
  switch (conventions.depth) {
    case pseudodepth:
      return parallel ? formulas::depth_of_parallel_pseudodepth(f, F, q) : formulas::depth_of_pseudodepth(f, F, q);
    case reciprocal:
      return 1 / q;
    case reversed:
      return parallel ? F - q * (F - f) : f * F / (f + q * (F - f));
    case foley:
      return parallel ? f - q * (F - f) : f * F / (F + q * (F - f));
    case zero_to_one:
      return parallel ? f + q * (F - f) : f * F / (F - q * (F - f));
    case view:
    case corrected:
      break;
  }
  return q;
}

double buffer_depth(const Camera& camera, const Conventions& conventions, double view_depth) {
  using enum Conventions::Depth;
  if (camera.kind == Camera::Kind::screen || std::isinf(view_depth)) return view_depth;
  if (conventions.depth == corrected) return view_depth;
  const auto scale = formulas::depth_scale(camera, conventions.depth, [](double number) { return number; });
  return formulas::vertex_depth(scale, view_depth);
}

double view_depth_error(const Camera& camera, const Conventions& conventions, double buffer_depth, double off) {
  using enum Conventions::Depth;
  if (camera.kind == Camera::Kind::screen || conventions.depth == view || conventions.depth == corrected) return off;
  const double f = camera.near, F = camera.far;
  const double range = zstep::buffer_depth(camera, conventions, F) - zstep::buffer_depth(camera, conventions, f);
  if (camera.kind == Camera::Kind::orthographic) return off * (F - f) / range;
  // 1/z_v is linear in the number of the buffer, and 1/z - 1/z' = (z' - z)/(z z').
  const double z = view_depth(camera, conventions, buffer_depth),
               exact = view_depth(camera, conventions, buffer_depth - off);
  return -off * (1 / F - 1 / f) / range * z * exact;
}

std::pair<double, double> ends_of_depths(const Scene& scene, Conventions::Depth depth) {
  Conventions conventions;
  conventions.depth = depth;
  double from = 0, to = 0;
  if (scene.camera.kind == Camera::Kind::screen) {
    const auto by_z = [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; };
    const auto [least, greatest] = std::minmax_element(scene.points.begin(), scene.points.end(), by_z);
    if (least != scene.points.end()) from = least->z, to = greatest->z;
  } else {
    from = buffer_depth(scene.camera, conventions, scene.camera.near);
    to = buffer_depth(scene.camera, conventions, scene.camera.far);
  }
  return std::minmax(from, to);
}

double depth_range(const Scene& scene, Conventions::Depth depth) {
  const auto [least, greatest] = ends_of_depths(scene, depth);
  const double range = greatest - least;
  return std::isfinite(range) && range > 0 ? range : 1;
}

double depth_unit(const Scene& scene, const Conventions& conventions) {
  const double greatest = formulas::greatest_number(conventions.number_format);
  return greatest == 0 ? 0 : depth_range(scene, conventions.depth) / greatest;
}

double formulas::least_depth(const Scene& scene, Conventions::Depth depth) {
  const double least = ends_of_depths(scene, depth).first;
  return std::isfinite(least) ? least : 0;
}

std::int32_t VertexAttribute::value_of(std::int32_t polygon, std::int32_t point) const {
  const auto found = std::lower_bound(own.begin(), own.end(), Own{polygon, point, no_value});
  if (found != own.end() && found->polygon == polygon && found->point == point) return found->value;
  return point >= 0 && point < std::ssize(of_point) ? of_point[point] : no_value;
}

const VertexAttribute* attribute_named(const Scene& scene, std::string_view name) {
  for (const VertexAttribute& attribute : scene.attributes)
    if (attribute.name == name) return &attribute;
  return nullptr;
}

const Placement* placement_of(const Scene& scene, std::int32_t point) {
  const auto& placements = scene.placements;
  const auto after =
      std::upper_bound(placements.begin(), placements.end(), point,
                       [](std::int32_t p, const Placement& placement) { return p < placement.first_point; });
  if (after == placements.begin()) return nullptr;
  const Placement& last = *std::prev(after);
  return point - last.first_point < last.point_count ? &last : nullptr;
}

Color color_at(const Picture& picture, const Scene& scene, std::size_t pixel) {
  if (!picture.ink.empty() && picture.ink[pixel] != no_ink) return color_of(picture.ink[pixel]);
  const std::int32_t polygon = picture.polygon[pixel];
  return polygon == no_polygon ? scene.background : scene.polygons.at(polygon).color;
}

glm::dmat4 view_from_rows(glm::dvec4 row_1, glm::dvec4 row_2, glm::dvec4 row_3) {
  glm::dmat4 matrix(1.0);
  for (int column = 0; column < 4; ++column) {
    matrix[column][0] = row_1[column] + 0.0;  // -0 becomes 0: it is going to be read
    matrix[column][1] = row_2[column] + 0.0;
    matrix[column][2] = row_3[column] + 0.0;
  }
  return matrix;
}

glm::dmat4 look_at_view(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up) {
  const glm::dvec3 away = glm::normalize(target - eye);
  glm::dvec3 right = glm::cross(away, up);
  if (!(glm::length(right) > 1e-9 * glm::length(up))) {
    const glm::dvec3 along = glm::abs(away);
    const glm::dvec3 axis = along.z <= along.x && along.z <= along.y ? glm::dvec3(0, 0, 1)
                            : along.y <= along.x                     ? glm::dvec3(0, 1, 0)
                                                                     : glm::dvec3(1, 0, 0);
    right = glm::cross(away, axis);
  }
  right = glm::normalize(right);
  const glm::dvec3 upwards = glm::cross(right, away);
  return view_from_rows({right, -glm::dot(right, eye)}, {upwards, -glm::dot(upwards, eye)},
                        {away, -glm::dot(away, eye)});
}

Camera camera_of(const Light& light) {
  Camera camera;
  camera.polar = false;
  camera.d = 1;
  camera.window = light.window;
  camera.near = light.near;
  camera.far = light.far;
  camera.view = look_at_view(light.position, light.target, {0, 0, 1});
  camera.eye = light.position;
  return camera;
}

}  // namespace zstep
