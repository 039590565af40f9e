#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/viewing/camera.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

namespace zstep {

namespace {

double checked(double value, std::string_view option) {
  if (!(std::abs(value) <= scene::largest_coordinate))
    throw InputError(option, fmt::format("{} is no number for it", value), "give a number of ordinary size");
  return value;
}

double positive(double value, std::string_view option) {
  if (!(checked(value, option) > 0))
    throw InputError(option, fmt::format("it is {}", value), "it must be greater than 0");
  return value;
}

void apply_raster(Raster& raster, const ViewOptions& options) {
  raster.width = options.width.value_or(raster.width);
  raster.height = options.height.value_or(raster.height);
  raster.y_up = options.y_up.value_or(raster.y_up);
  raster.corners = options.corners.value_or(raster.corners);
  if (raster.width < 1 || raster.height < 1 || raster.width > largest_side || raster.height > largest_side ||
      std::int64_t{raster.width} * raster.height > most_pixels)
    throw InputError("--size", fmt::format("{}x{} is no size of a raster", raster.width, raster.height),
                     fmt::format("each side is 1 to {}, and there are at most {} pixels", largest_side, most_pixels));
}

/// A ball that holds all points: the centre of their bounding box, the distance of the farthest from it.
struct Ball {
  glm::dvec3 centre{0};
  double radius = 1;
};

Ball ball_around(const std::vector<glm::dvec3>& points) {
  if (points.empty()) return {};
  glm::dvec3 low = points.front(), high = low;
  for (const glm::dvec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  Ball ball{low + (high - low) / 2.0, 0};
  for (const glm::dvec3& point : points) ball.radius = std::max(ball.radius, glm::length(point - ball.centre));
  if (!(ball.radius > 0)) ball.radius = 1;
  return ball;
}

/// The bounding box's centre to the origin, the farthest vertex at distance 1; the light keeps its place among them.
void fit(Scene& scene) {
  if (scene.fit) return;  // it is there already
  const Ball ball = ball_around(scene.points);
  const Fit move{ball.centre, ball.radius};
  if (scene.file_points.empty()) scene.file_points = scene.points;
  for (glm::dvec3& point : scene.points) point = move(point);
  scene.fit = move;
  if (!scene.light) return;
  Light& light = *scene.light;
  light.position = move(light.position);
  light.target = move(light.target);
  light.near /= move.radius;
  light.far /= move.radius;
}

/// The distance from which a ball round the origin that holds the whole scene just fits into the window, plus a
/// twentieth.
double distance_for_all(const Scene& scene) {
  double radius = 0;
  for (const glm::dvec3& point : scene.points) radius = std::max(radius, glm::length(point));
  if (!(radius > 0)) radius = 1;
  const Camera& camera = scene.camera;
  if (camera.kind == Camera::Kind::orthographic) return 2 * radius;
  const double aspect = ratio(scene.raster.width, scene.raster.height);
  const double half = camera.window * std::min(1.0, aspect);  // of the window's shorter side
  return 1.05 * radius * std::sqrt(half * half + camera.d * camera.d) / half;
}

void place_eye(Scene& scene, const ViewOptions& options) {
  Camera& camera = scene.camera;
  if (options.rho || options.theta || options.phi) camera.polar = true;
  if (camera.polar || options.d || options.window || options.orthographic) camera.matrices.reset();
  if (!take_matrices(camera, scene.raster))
    throw InputError(scene.name, "its projection has no eye",
                     "the rows of x_c, y_c and w_c must go with three directions");
  if (options.rho) camera.rho = positive(*options.rho, "--rho");
  if (options.theta) camera.theta = checked(*options.theta, "--theta");
  if (options.phi) camera.phi = checked(*options.phi, "--phi");
  if (camera.polar) {
    if (!(camera.rho > 0)) camera.rho = distance_for_all(scene);
    camera.view = viewing::eckert_view(camera.rho, camera.theta, camera.phi);
    camera.eye = viewing::eckert_eye(camera.rho, camera.theta, camera.phi);
  }
  if (camera.kind == Camera::Kind::orthographic)  // z_v grows along the third row, away from the eye
    camera.eye = glm::normalize(-glm::dvec3(camera.view[0][2], camera.view[1][2], camera.view[2][2])) + 0.0;
}

/// Near and far, where they are not given: the extent of z_v widened by a hundredth on both sides; in perspective the
/// near plane stays in front of the eye, at a thousandth of far at least, so that the eye may stand inside the scene.
void choose_depths(Scene& scene, const ViewOptions& options) {
  Camera& camera = scene.camera;
  if (options.near) camera.near = checked(*options.near, "--near");
  if (options.far) camera.far = std::isinf(*options.far) ? *options.far : checked(*options.far, "--far");
  const bool perspective = camera.kind == Camera::Kind::perspective;
  const bool near_given = options.near || camera.near != 0, far_given = options.far || camera.far != 0;

  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const glm::dvec3& point : scene.points) {
    const double z = (camera.view * glm::dvec4(point, 1)).z;
    low = std::min(low, z);
    high = std::max(high, z);
  }
  if (scene.points.empty()) low = high = 1;
  const double size = std::max(std::abs(low), std::abs(high));
  double pad = std::max(0.01 * (high - low), 1e-6 * size);
  if (high == low) pad = 0.01 * size;
  if (!(pad > 0)) pad = 1;
  if (!far_given) {
    camera.far = high + pad;
    if (perspective && !(camera.far > 0)) camera.far = 1;  // everything is behind the eye
    if (near_given && !(camera.far > camera.near)) camera.far = camera.near + pad;
  }
  if (!near_given) {
    camera.near = low - pad;
    const double reach = !std::isinf(camera.far) ? camera.far : high + pad > 0 ? high + pad : 1;
    if (perspective) camera.near = std::max(camera.near, reach / 1000);
    if (far_given && !(camera.far > camera.near)) camera.near = perspective ? camera.far / 1000 : camera.far - pad;
  }
  if (perspective && std::isinf(camera.far)) camera.far = infinitely_far * camera.near;
  if (perspective && !(camera.near > 0))
    throw InputError("--near", fmt::format("it is {}", camera.near), "in perspective it must be greater than 0");
  if (!(camera.far > camera.near))
    throw InputError("--far", fmt::format("it is {}, but near is {}", camera.far, camera.near),
                     "give the greater distance to far");
  if (!near_given || !far_given) return;
  if (const std::string against = planes_against_matrix(camera); !against.empty())
    throw InputError(scene.name, against, std::string(row_of_depth_remedy));
}

/// What is not given of the light: a window that a ball round the scene just fits into, plus a twentieth, but at most
/// 80 degrees to each side (a light inside the scene does not shine backwards); planes before and behind that ball.
void complete_light(Scene& scene) {
  if (!scene.light) return;
  Light& light = *scene.light;
  const Ball ball = ball_around(scene.points);
  const glm::dvec3 ahead = glm::normalize(light.target - light.position), to_ball = ball.centre - light.position;
  const double distance = glm::length(to_ball), along = glm::dot(ahead, to_ball);
  if (!(light.window > 0)) {
    constexpr double widest = 80 * 3.14159265358979323846 / 180;
    const double aside = portable::atan2(glm::length(glm::cross(ahead, to_ball)), along);
    const double half = distance > ball.radius ? portable::asin(ball.radius / distance) : widest;
    light.window = 1.05 * portable::tan(std::min(widest, aside + half));
  }
  if (!(light.far > 0))
    light.far = std::max(along + 1.01 * ball.radius, light.near > 0 ? 2 * light.near : 0.01 * ball.radius);
  if (!(light.near > 0)) {
    light.near = along - 1.01 * ball.radius;
    if (!(light.near < light.far)) light.near = light.far / 2;
    light.near = std::max(light.near, light.far / 1000);
  }
  if (!(light.near < light.far) || !std::isfinite(light.window) || !std::isfinite(light.far))
    throw InputError(scene.name, "the scene and its light lie too far from each other", "move the light");
}

}  // namespace

Scene look_at_scene(Scene scene, const ViewOptions& options) {
  apply_raster(scene.raster, options);
  Camera& camera = scene.camera;
  if (camera.kind == Camera::Kind::screen) {
    if (options.rho || options.theta || options.phi || options.d || options.window || options.near || options.far ||
        options.depth_range || options.orthographic || options.fit || options.corners)
      throw InputError(scene.name, "the scene is in screen coordinates, so it has no camera",
                       "leave out rho, theta, phi, d, window, near, far, depth-range, ortho, fit and seen-at");
    camera.polar = false;
    return scene;
  }
  if (scene.surface && scene.raster.y_up)
    throw InputError(options.y_up ? "--y-axis" : scene.name, "the rows of a surface's picture go down",
                     "horizons are held against rows; leave y_axis out");
  if (options.fit) fit(scene);
  if (options.orthographic)
    camera.kind = *options.orthographic ? Camera::Kind::orthographic : Camera::Kind::perspective;
  if (options.d) camera.d = positive(*options.d, "d");
  if (options.window) camera.window = positive(*options.window, "window");
  if (options.depth_range) camera.depth_range = *options.depth_range;
  place_eye(scene, options);
  choose_depths(scene, options);
  complete_light(scene);
  return scene;
}

}  // namespace zstep
