#include "algorithms/shadow_buffer/shadow_buffer.hpp"

#include <cmath>
#include <glm/mat4x4.hpp>
#include <vector>

#include "algorithms/viewing/camera.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "traces/formulas/of_shadows.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/math/whole.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::shadow_buffer {

namespace {

/// The point of the world that is seen at a pixel, from its depth: the way of a vertex, backwards.
glm::dvec3 point_at(const viewing::Lens& lens, const glm::dmat4& world_of_view, std::int32_t x, std::int32_t y,
                    double z_v) {
  const double x_p = formulas::window_x<double>(x, lens.window_x, lens.width, lens.raster),
               y_p = formulas::window_y<double>(y, lens.window_y, lens.height, lens.raster);
  const double per_plane = lens.orthographic ? 1 : z_v / lens.d;
  return glm::dvec3(world_of_view * glm::dvec4(x_p * per_plane, y_p * per_plane, z_v, 1));
}

/// The light's picture, and what it is seen with.
struct SeenByLight {
  const Picture& picture;
  const Camera& camera;
  const viewing::Lens lens;
  const Conventions& conventions;

  glm::dvec3 view(glm::dvec3 point) const { return glm::dvec3(camera.view * glm::dvec4(point, 1)); }
  /// Is what this pixel holds not before a point at z_v, but for the bias? Beside the picture all is dark.
  bool lights(double z_v, double bias, double column, double row) const {
    const bool inside = z_v >= camera.near && column >= 0 && column < picture.width && row >= 0 && row < picture.height;
    if (!inside) return false;
    const std::size_t pixel = picture.at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
    return z_v - bias <= view_depth(camera, conventions, picture.depth[pixel]);
  }
};

/// The share of the light that reaches the point of a pixel.
template <Recorder R>
double share_of_light(const SeenByLight& light, const formulas::ShadowOptions& options, std::int32_t x, std::int32_t y,
                      glm::dvec3 view, const formulas::Vector<double>& normal, R& record) {
  formulas::LightSlopes<double> slopes{0, 0};
  if (options.slope_bias != 0)
    slopes = formulas::light_slopes(normal, light.camera, light.lens.raster, {view.x, view.y, view.z});
  const double bias = formulas::light_bias(view.z, options.bias, options.slope_bias, slopes.greater());
  if (options.slope_bias != 0) record(step::slope_bias, ShadowBias{x, y, slopes.dz_dx, slopes.dz_dy, bias});

  const glm::dvec3 plane = light.lens.project(view);
  const glm::dvec2 raster = light.lens.to_viewport(plane.x, plane.y);
  const double column = std::round(raster.x), row = std::round(raster.y);
  const bool lit = light.lights(view.z, bias, column, row);
  record(step::compare_light, ShadowCompare{x, y, raster.x, raster.y, plane.z, lit});
  if (options.across == 1) return lit ? 1 : 0;

  double count = lit ? 1 : 0;
  const auto compare = [&](std::int32_t i, std::int32_t j) {
    const bool lit_there = light.lights(view.z, bias, i, j);
    record(step::compare_neighbour, ShadowNeighbour{x, y, i, j, lit_there});
    count += lit_there ? 1 : 0;
  };
  if (view.z >= light.camera.near)
    formulas::for_each_neighbour(column, row, options.across, light.lens.raster, compare);
  const double share = count / (options.across * options.across);
  record(step::share, LightShare{x, y, share});
  return share;
}

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Scene from_light = scene;
  from_light.camera = viewing::camera_of(*scene.light);

  record(step::pass, PassBegin{Pass::light});
  const Picture seen_by_light = z_buffer::run(from_light, conventions, record);

  record(step::pass, PassBegin{Pass::eye});
  Picture picture = z_buffer::run(scene, conventions, record);
  picture.use_ink();

  const viewing::Lens eye(scene.camera, scene.raster, conventions.depth);
  const SeenByLight light{seen_by_light, from_light.camera,
                          viewing::Lens(from_light.camera, scene.raster, conventions.depth), conventions};
  const glm::dmat4 world_of_view = glm::inverse(scene.camera.view);
  const formulas::ShadowOptions given = formulas::shadow_options(conventions);
  std::vector<formulas::Vector<double>> normals;
  for (std::int32_t polygon = 0; polygon < std::ssize(scene.polygons); ++polygon)
    normals.push_back(formulas::normal_of_polygon<double>(scene, polygon));
  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t x = 0; x < picture.width; ++x) {
      const std::size_t pixel = picture.at(x, y);
      const std::int32_t polygon = picture.polygon[pixel];
      if (polygon == no_polygon) continue;

      const double z_v = view_depth(scene.camera, conventions, picture.depth[pixel]);
      const glm::dvec3 point = point_at(eye, world_of_view, x, y, z_v);
      const double share = share_of_light(light, given, x, y, light.view(point), normals[polygon], record);
      if (share == 1) continue;

      const Color color = scene.polygons[polygon].color;
      const auto dark = [&](std::uint8_t shade) {
        return nearest_byte(shade * formulas::kept_of_color(in_shadow, share));
      };
      const Color shaded{dark(color.red), dark(color.green), dark(color.blue)};
      picture.ink[pixel] = ink_of(shaded);
      record(step::darken, ColorWrite{x, y, shaded.red, shaded.green, shaded.blue});
    }
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::shadow_buffer
