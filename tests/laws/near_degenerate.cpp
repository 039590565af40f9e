#include "tests/laws/near_degenerate.hpp"

#include <cmath>

#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/scenes.hpp"

namespace zstep::test {

namespace {

constexpr std::int32_t size = 16;  // of the rasters

/// A few last digits up or down, or none.
double nudged(Numbers& random, double value) {
  const int digits = static_cast<int>(random.between(0, 7)) - 3;
  for (int i = 0; i < std::abs(digits); ++i) value = std::nextafter(value, digits > 0 ? 1e300 : -1e300);
  return value;
}
glm::dvec3 nudged(Numbers& random, glm::dvec3 p) {
  const double x = nudged(random, p.x), y = nudged(random, p.y);
  return {x, y, nudged(random, p.z)};
}
glm::dvec3 on_picture(Numbers& random) {
  const double x = random.between(-1, size), y = random.between(-1, size);
  return {x, y, random.between(1, 3)};
}
/// A point of the plane through three, and inside them for weights of one sum and sign.
glm::dvec3 mixed(Numbers& random, const std::vector<glm::dvec3>& of, bool on_edge) {
  const double a = random.between(-0.5, 1.5), b = on_edge ? 1 - a : random.between(-0.5, 1.5);
  return nudged(random, a * of[0] + b * of[1] + (1 - a - b) * of[2]);
}

using Triangle = std::vector<glm::dvec3>;

/// A triangle that has two of its vertices on a line through pixel centres.
Triangle through_centers(Numbers& random) {
  const auto whole = [&] { return std::floor(random.between(0, size)); };
  const double x_0 = whole(), y_0 = whole(), x_1 = whole(), y_1 = whole(), t = random.between(-2, 2);
  const double s = random.between(-2, 2), z_0 = random.between(1, 3), z_1 = random.between(1, 3);
  return {nudged(random, {x_0 + t * (x_1 - x_0), y_0 + t * (y_1 - y_0), z_0}),
          nudged(random, {x_0 + s * (x_1 - x_0), y_0 + s * (y_1 - y_0), z_1}), on_picture(random)};
}

Scene on_screen(Numbers& random, std::uint64_t family) {
  std::vector<Triangle> triangles{{on_picture(random), on_picture(random), on_picture(random)}};
  const Triangle first = triangles[0];
  switch (family) {
    case 0:  // edges through pixel centres
      triangles[0] = through_centers(random);
      triangles.push_back(through_centers(random));
      break;
    case 1:  // in one plane
      triangles.push_back({mixed(random, first, false), mixed(random, first, false), mixed(random, first, false)});
      break;
    case 2:  // an edge or a vertex in the other's plane
      triangles.push_back({mixed(random, first, false), mixed(random, first, false), on_picture(random)});
      break;
    case 3: {  // an edge along another's, and slivers
      const Triangle edge{mixed(random, first, true), mixed(random, first, true)};
      triangles.push_back({edge[0], edge[1], on_picture(random)});
      triangles.push_back({edge[0], edge[1], mixed(random, first, true)});
      break;
    }
    default: {  // one plane once more, of a shape that does not ask for it: the same triangle moved by last digits
      Triangle moved;
      for (const glm::dvec3& corner : first) moved.push_back(nudged(random, corner));
      triangles.push_back(moved);
    }
  }
  return screen_scene(size, size, triangles);
}

Scene in_space(Numbers& random, std::uint64_t family) {
  const glm::dvec3 eye(4, -1.5, 1.25);
  Scene scene;
  scene.raster = {size, size, false};
  const Triangle first{random.in_box(1), random.in_box(1), random.in_box(1)};
  add_polygon(scene, first);
  if (family == 0) {  // in one plane with the eye
    const glm::dvec3 a = random.in_box(1), b = random.in_box(1);
    const double s = random.between(-0.5, 0.5), t = random.between(-0.5, 0.5);
    add_polygon(scene, {a, b, nudged(random, a + s * (b - a) + t * (eye - a))});
  } else {  // an edge along another's, in its plane or not
    const glm::dvec3 a = mixed(random, first, true), b = mixed(random, first, true);
    add_polygon(scene, {a, b, random.in_box(1)});
    add_polygon(scene, {mixed(random, first, false), mixed(random, first, false), mixed(random, first, false)});
  }
  look(scene, family == 2 ? Camera::Kind::orthographic : Camera::Kind::perspective, eye, {0, 0, 0}, 1, 8);
  // A vertex on the side of the window: x_v = w_x z_v/d.
  if (family == 1) {
    const glm::dmat4& view = scene.camera.view;
    const glm::dvec3 right(view[0][0], view[1][0], view[2][0]), away(view[0][2], view[1][2], view[2][2]);
    const double z = random.between(3, 5);
    add_polygon(scene, {nudged(random, eye + z * (away + right * scene.camera.window / scene.camera.d)),
                        random.in_box(1), random.in_box(1)});
  }
  return scene;
}

}  // namespace

NearDegenerate near_degenerate(std::uint64_t number) {
  Numbers random(1000 + number);
  const std::uint64_t family = number % 9;
  if (family < 5)
    return {on_screen(random, family),
            {"z-buffer", "scan-line", "depth-sort", "bsp", "warnock", "ray-casting", "hidden-line"}};
  if (family < 8) return {in_space(random, family - 5), {"z-buffer", "bsp", "ray-casting", "hidden-line"}};
  // Curves that all but lie on one line: each touches the horizons that the ones before have left.
  const double slope = random.between(-0.3, 0.3);
  ViewOptions view;
  view.width = view.height = size;
  Scene scene = look_at_scene(load_scene(fmt::format("y = {} * x", slope)).scene, view);
  look(scene, Camera::Kind::orthographic, 8, 90, 90, 1, 16);
  for (glm::dvec3& point : scene.points) point.z = nudged(random, point.z);
  return {scene, {"floating-horizon"}};
}

std::string scene_file_of(const Scene& scene) {
  std::string text;
  if (scene.camera.kind == Camera::Kind::screen) text += "coordinates = \"screen\"\n";
  const Camera& camera = scene.camera;
  if (camera.kind != Camera::Kind::screen) {
    const bool parallel = camera.kind == Camera::Kind::orthographic;
    const glm::dvec3 eye = parallel ? camera.eye * 4.0 : camera.eye;
    text += fmt::format("[camera]\neye = [{:.17g}, {:.17g}, {:.17g}]\nnear = {}\nfar = {}\northographic = {}\n", eye.x,
                        eye.y, eye.z, camera.near, camera.far, parallel);
  }
  text += fmt::format("[raster]\nwidth = {}\nheight = {}\n", scene.raster.width, scene.raster.height);
  for (const Facet& facet : scene.facets) {
    text += "[[polygon]]\npoints = [";
    for (std::int32_t i = 0; i < facet.corner_count; ++i) {
      const auto corner = static_cast<std::size_t>(facet.first_corner + i);
      const glm::dvec3& p = scene.points[static_cast<std::size_t>(scene.corners[corner])];
      text += fmt::format("{}[{:.17g}, {:.17g}, {:.17g}]", i == 0 ? "" : ", ", p.x, p.y, p.z);
    }
    text += "]\n";
  }
  return text;
}

}  // namespace zstep::test
