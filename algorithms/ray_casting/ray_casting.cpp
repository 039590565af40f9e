#include "algorithms/ray_casting/ray_casting.hpp"

#include "algorithms/ray_casting/first_hit.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::ray_casting {

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Picture picture(scene.raster.width, scene.raster.height);
  record(step::clear, BuffersClear{no_depth});

  Space space = make_space(scene, choice_of<Boxes>(options, conventions, "boxes"), record);
  const EyeRays rays(scene, conventions.depth);
  const Meets meets{conventions.cull && scene.camera.kind != Camera::Kind::screen, -1};

  std::int32_t number = 0;
  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t x = 0; x < picture.width; ++x, ++number) {
      const Ray ray = rays.through(x, y);
      const glm::dvec3 from = ray.from, along = ray.along;
      const RayBegin begin{number, -1, RayRole::eye, x, y, from.x, from.y, from.z, along.x, along.y, along.z};
      record(step::ray, begin);

      const Nearest nearest = first_hit(space, ray, meets, record);
      const bool met = nearest.facet >= 0;
      const std::int32_t polygon = met ? scene.facets[static_cast<std::size_t>(nearest.facet)].polygon : no_polygon;
      const Color color = met ? scene.polygons[static_cast<std::size_t>(polygon)].color : scene.background;
      const double red = color.red / 255.0, green = color.green / 255.0, blue = color.blue / 255.0;
      record(step::ray_end, RayEnd{number, nearest.facet, met ? nearest.t : no_depth, nearest.tests, red, green, blue});
      if (!met) continue;

      const double z = rays.depth(nearest.t);
      picture.polygon[picture.at(x, y)] = polygon;
      picture.depth[picture.at(x, y)] = z;
      record(step::paint, PixelPaint{x, y, z, polygon});
    }
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::ray_casting
