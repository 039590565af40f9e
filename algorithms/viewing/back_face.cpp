#include "algorithms/viewing/back_face.hpp"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "traces/formulas/outlines.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::clipping {

namespace {

constexpr double zero_area = 1e-14;  // below it is rounding

bool orthographic(const Scene& scene) { return scene.camera.kind == Camera::Kind::orthographic; }

template <class Element>
const Element& nth(const std::vector<Element>& elements, Corners corners, std::size_t n) {
  return elements[corners[n < corners.size() ? n : 0]];
}

// From the eye to a facet's first corner; for an orthographic camera the direction of all lines of sight.
glm::dvec3 line_of_sight(const Scene& scene, Corners corners) {
  return orthographic(scene) ? -scene.camera.eye : nth(scene.points, corners, 0) - scene.camera.eye;
}

}  // namespace

glm::dvec3 newell_normal(const Scene& scene, Corners corners) {
  return formulas::newell_normal(glm::dvec3(0), corners.size(),
                                 [&](std::size_t i) { return nth(scene.points, corners, i); });
}

double determinant(const Scene& scene, Corners corners, const viewing::Vertices& vertices) {
  const auto view = [&](std::size_t i) { return nth(vertices, corners, i).view; };
  const glm::dvec3 sum = formulas::newell_about_origin(glm::dvec3(0), corners.size(), view);
  return glm::dot(orthographic(scene) ? glm::dvec3(0, 0, 1) : view(0), sum);
}

double plane_at_eye(const Scene& scene, Corners corners) {
  const glm::dvec3 abc = newell_normal(scene, corners), eye = scene.camera.eye;
  const double d = orthographic(scene) ? 0 : -glm::dot(abc, nth(scene.points, corners, 0));
  return formulas::plane_value(abc.x, abc.y, abc.z, d, eye.x, eye.y, eye.z);
}

double view_dot_normal(const Scene& scene, Corners corners) {
  return glm::dot(line_of_sight(scene, corners), newell_normal(scene, corners));
}

double projected_normal_z(const Scene& scene, Corners corners, const viewing::Vertices& vertices) {
  const auto vertex = [&](std::size_t i) -> const viewing::Vertex& { return nth(vertices, corners, i); };
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (!(vertex(i).view.z >= scene.camera.near)) return std::numeric_limits<double>::quiet_NaN();
  return formulas::newell_z(
      0.0, corners.size(), [&](std::size_t i) { return vertex(i).raster.x; },
      [&](std::size_t i) { return vertex(i).raster.y; });
}

bool degenerate(const Scene& scene, Corners corners) {
  if (corners.size() < 3) return true;
  const glm::dvec3 origin = nth(scene.points, corners, 0);
  double extent = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    extent = std::fmax(extent, glm::length(nth(scene.points, corners, i) - origin));
  }
  const double area = glm::length(newell_normal(scene, corners));
  return !(area > zero_area * extent * extent) || !std::isfinite(area);
}

template <Recorder R>
Facing test_facing(const Scene& scene, Corners corners, const viewing::Vertices& vertices, R& record) {
  FacingTest test{determinant(scene, corners, vertices), plane_at_eye(scene, corners), view_dot_normal(scene, corners),
                  projected_normal_z(scene, corners, vertices), Facing::edge_on};

  const double scale = glm::length(line_of_sight(scene, corners)) * glm::length(newell_normal(scene, corners));
  if (test.view_dot_normal > formulas::edge_on_sine * scale) test.facing = Facing::back;
  if (test.view_dot_normal < -formulas::edge_on_sine * scale) test.facing = Facing::front;
  record(step::facing, test);
  return test.facing;
}

#define INSTANTIATE(R) template Facing test_facing<R>(const Scene&, Corners, const viewing::Vertices&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::clipping
