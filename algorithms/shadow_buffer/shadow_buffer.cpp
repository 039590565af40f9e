#include "algorithms/shadow_buffer/shadow_buffer.hpp"

#include <cmath>
#include <glm/mat4x4.hpp>

#include "algorithms/viewing/camera.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
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

/// Does the light reach a point? `seen` is its picture, `camera` what it is seen with.
struct AtLight {
  double x, y, z;  ///< where the point is in the light's picture, and its depth there
  bool lit;
};
AtLight at_light(const Picture& seen, const Camera& camera, const viewing::Lens& lens, const Conventions& conventions,
                 glm::dvec3 point, double bias) {
  const auto view = glm::dvec3(camera.view * glm::dvec4(point, 1));
  const glm::dvec3 plane = lens.project(view);
  const glm::dvec2 raster = lens.to_viewport(plane.x, plane.y);
  AtLight at{raster.x, raster.y, plane.z, false};
  const double column = std::round(raster.x), row = std::round(raster.y);
  const bool inside = view.z >= camera.near && column >= 0 && column < seen.width && row >= 0 && row < seen.height;
  if (!inside) return at;

  const double stored = seen.depth[seen.at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row))];
  at.lit = view.z * (1 - bias) <= view_depth(camera, conventions, stored);
  return at;
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
  const viewing::Lens light(from_light.camera, scene.raster, conventions.depth);
  const glm::dmat4 world_of_view = glm::inverse(scene.camera.view);
  const double bias = static_cast<double>(whole_number(options, conventions, "bias")) / 1000;
  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t x = 0; x < picture.width; ++x) {
      const std::size_t pixel = picture.at(x, y);
      if (picture.polygon[pixel] == no_polygon) continue;

      const double z_v = view_depth(scene.camera, conventions, picture.depth[pixel]);
      const glm::dvec3 point = point_at(eye, world_of_view, x, y, z_v);
      const AtLight at = at_light(seen_by_light, from_light.camera, light, conventions, point, bias);
      record(step::compare_light, ShadowCompare{x, y, at.x, at.y, at.z, at.lit});
      if (at.lit) continue;

      const Color color = scene.polygons[picture.polygon[pixel]].color;
      const auto dark = [](std::uint8_t shade) { return nearest_byte(shade * in_shadow); };
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
