
#include "algorithms/ray_tracing/ray_tracing.hpp"

#include <limits>

#include "algorithms/ray_casting/ray_casting.hpp"
#include "algorithms/shadow_buffer/shadow_buffer.hpp"
#include "traces/math/whole.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::ray_tracing {

namespace {

using ray_casting::first_hit;
using ray_casting::Meets;
using ray_casting::Nearest;
using ray_casting::Ray;

constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec3 light_of(Color color) { return glm::dvec3(color.red, color.green, color.blue) / 255.0; }

Color color_of(glm::dvec3 light) {
  const auto part = [](double value) { return nearest_byte(255 * value); };
  return {part(light.x), part(light.y), part(light.z)};
}

/// The diagonal of the box around a scene's points.
double extent_of(const Scene& scene) {
  glm::dvec3 low(infinity), high(-infinity);
  for (const glm::dvec3& point : scene.points) low = glm::min(low, point), high = glm::max(high, point);
  return scene.points.empty() ? 0 : glm::length(high - low);
}

struct Pixel {
  std::int32_t x, y;
};

struct Brought {
  glm::dvec3 light;
  Nearest nearest;
};

template <Recorder R>
struct Tracer {
  const Scene& scene;
  ray_casting::Space space;
  std::int64_t depth;  // rays may come from rays so often
  R& record;
  double here = 1e-9 * extent_of(scene);  // what is nearer to a ray's start is at its start
  std::int32_t rays = 0;                  // how many began

  std::int32_t begin(Step<RayBegin> step, RayRole role, std::int32_t parent, Pixel at, const Ray& ray) {
    const std::int32_t number = rays++;
    const glm::dvec3 from = ray.from, along = ray.along;
    record(step, RayBegin{number, parent, role, at.x, at.y, from.x, from.y, from.z, along.x, along.y, along.z});
    return number;
  }

  void end(std::int32_t number, const Nearest& nearest, glm::dvec3 light) {
    const double t = nearest.facet >= 0 ? nearest.t : infinity;
    record(step::ray_end, RayEnd{number, nearest.facet, t, nearest.tests, light.x, light.y, light.z});
  }

  // Does the lamp shine on a point of a facet?
  bool lit(glm::dvec3 point, std::int32_t facet, std::int32_t parent, Pixel at) {
    const Ray ray{point, scene.light->position - point, 0, 1};
    const std::int32_t number = begin(step::shadow_ray, RayRole::shadow, parent, at, ray);
    const Nearest nearest = first_hit(space, ray, Meets{false, facet, here / glm::length(ray.along)}, record);
    const bool free = nearest.facet < 0;
    end(number, nearest, glm::dvec3(free ? 1 : 0));
    return free;
  }

  // What a facet's point sends back along the ray.
  glm::dvec3 light_from(const Ray& ray, std::int32_t number, const Nearest& nearest, Pixel at, std::int64_t deep) {
    const glm::dvec3 point = ray.at(nearest.t), along = glm::normalize(ray.along);
    const glm::dvec3 normal = ray_casting::target_of(scene, nearest.facet).plane.normal();
    const Polygon& polygon = polygon_of(nearest.facet);
    const double opacity = polygon.material->opacity, reflectance = polygon.material->reflectance,
                 refraction = polygon.material->refraction;

    glm::dvec3 own = light_of(polygon.color);
    if (scene.light && !lit(point, nearest.facet, number, at)) own *= shadow_buffer::in_shadow;
    if (deep == depth) return own;

    double mirror = reflectance, through = (1 - reflectance) * (1 - opacity);
    const double own_part = (1 - reflectance) * opacity;
    const bool entering = glm::dot(along, normal) < 0;
    const auto bent = refracted(along, normal, entering ? 1 : refraction, entering ? refraction : 1);
    if (!bent) mirror += through, through = 0;

    glm::dvec3 light = own_part * own;
    if (mirror > 0) {
      const Ray next{point, mirrored(along, normal), 0, infinity};
      const std::int32_t child = begin(step::mirrored_ray, RayRole::reflected, number, at, next);
      light += mirror * trace(next, child, Meets{false, nearest.facet, here}, at, deep + 1).light;
    }
    if (through > 0) {
      const Ray next{point, *bent, 0, infinity};
      const std::int32_t child = begin(step::transmitted_ray, RayRole::transmitted, number, at, next);
      light += through * trace(next, child, Meets{false, nearest.facet, here, true}, at, deep + 1).light;
    }
    return light;
  }

  Brought trace(const Ray& ray, std::int32_t number, Meets meets, Pixel at, std::int64_t deep) {
    const Nearest nearest = first_hit(space, ray, meets, record);
    const bool met = nearest.facet >= 0;
    const glm::dvec3 light = met ? light_from(ray, number, nearest, at, deep) : light_of(scene.background);
    end(number, nearest, light);
    return {light, nearest};
  }

  const Polygon& polygon_of(std::int32_t facet) const { return scene.polygons[scene.facets[facet].polygon]; }
};

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Picture picture(scene.raster.width, scene.raster.height);
  picture.use_ink();
  record(step::clear, BuffersClear{no_depth});

  const auto boxes = choice_of<ray_casting::Boxes>(options, conventions, "boxes");
  Tracer<R> tracer{scene, make_space(scene, boxes, record), whole_number(options, conventions, "depth"), record};
  const ray_casting::EyeRays rays(scene, conventions.depth);
  const Meets meets{conventions.cull && scene.camera.kind != Camera::Kind::screen, -1};

  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t x = 0; x < picture.width; ++x) {
      const Ray ray = rays.through(x, y);
      const std::int32_t number = tracer.begin(step::eye_ray, RayRole::eye, -1, {x, y}, ray);
      const auto [light, nearest] = tracer.trace(ray, number, meets, {x, y}, 0);
      if (nearest.facet < 0) continue;

      const std::size_t pixel = picture.at(x, y);
      const std::int32_t polygon = scene.facets[nearest.facet].polygon;
      const double z = rays.depth(nearest.t);
      picture.polygon[pixel] = polygon;
      picture.depth[pixel] = z;
      record(step::paint, PixelPaint{x, y, z, polygon});

      const Color color = color_of(light);
      picture.ink[pixel] = ink_of(color);
      record(step::color, ColorWrite{x, y, color.red, color.green, color.blue});
    }
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::ray_tracing
