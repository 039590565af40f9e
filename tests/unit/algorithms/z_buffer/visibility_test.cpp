// What the Z-buffer draws against what a ray through each pixel's centre meets first.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

constexpr double near_edge = 1e-7;  // pixels nearer than this to an edge may go either way

struct Hit {
  std::int32_t polygon = no_polygon;
  double z_v = no_depth;
  bool doubtful = false;  // so near an edge, or another polygon's depth, that rounding decides
};

// The nearest polygon on the line of sight through (x_p, y_p), between the clipping planes.
Hit cast(const Scene& scene, const std::vector<glm::dvec3>& view, double x_p, double y_p) {
  const bool perspective = scene.camera.kind == Camera::Kind::perspective;
  const glm::dvec3 from = perspective ? glm::dvec3(0) : glm::dvec3(x_p, y_p, 0);
  const glm::dvec3 along = perspective ? glm::dvec3(x_p, y_p, 1) : glm::dvec3(0, 0, 1);
  Hit hit;
  for (const Facet& facet : scene.facets) {
    const auto corner = [&](std::int32_t i) {
      return view[static_cast<std::size_t>(
          scene.corners[static_cast<std::size_t>(facet.first_corner + i % facet.corner_count)])];
    };
    glm::dvec3 normal(0);
    for (std::int32_t i = 1; i + 1 < facet.corner_count; ++i) {
      normal += glm::cross(corner(i) - corner(0), corner(i + 1) - corner(0));
    }
    const double t = glm::dot(corner(0) - from, normal) / glm::dot(along, normal);
    const glm::dvec3 point = from + t * along;
    if (!std::isfinite(t) || point.z < scene.camera.near - near_edge || point.z > scene.camera.far + near_edge)
      continue;
    // Even-odd in the coordinate plane that the polygon is broadest in.
    const glm::dvec3 size = glm::abs(normal);
    const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    bool inside = false, doubtful = std::abs(point.z - scene.camera.near) < near_edge ||
                                    std::abs(point.z - scene.camera.far) < near_edge;
    for (std::int32_t i = 0; i < facet.corner_count; ++i) {
      const glm::dvec3 a = corner(i), b = corner(i + 1);
      if ((a[v] <= point[v]) != (b[v] <= point[v]) &&
          point[u] < a[u] + (b[u] - a[u]) * (point[v] - a[v]) / (b[v] - a[v])) {
        inside = !inside;
      }
      const double s = std::clamp(glm::dot(point - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
      doubtful |= glm::length(point - (a + s * (b - a))) < near_edge;
    }
    if (doubtful || (inside && std::abs(point.z - hit.z_v) < near_edge)) hit.doubtful = true;
    if (inside && point.z < hit.z_v) hit.polygon = facet.polygon, hit.z_v = point.z;
  }
  return hit;
}

struct Agreement {
  int agreed = 0, doubtful = 0, drawn = 0;
};

Agreement hold_against_rays(const Scene& scene) {
  Conventions conventions;
  conventions.cull = false;
  NullRecorder record;
  const Picture picture = z_buffer::run(scene, conventions, record);
  std::vector<glm::dvec3> view;
  for (const glm::dvec3& point : scene.points) view.push_back(glm::dvec3(scene.camera.view * glm::dvec4(point, 1)));

  Agreement agreement;
  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t x = 0; x < picture.width; ++x) {
      const double half = scene.camera.window, aspect = 1.0 * picture.width / picture.height;
      const double x_p = ((x + 0.5) / picture.width * 2 - 1) * half * aspect;
      const double y_p = (1 - (y + 0.5) / picture.height * 2) * half;
      const Hit hit = cast(scene, view, x_p, y_p);
      if (hit.doubtful) {
        ++agreement.doubtful;
        continue;
      }
      const std::size_t pixel = picture.at(x, y);
      REQUIRE(picture.polygon[pixel] == hit.polygon);
      const double z_v = view_depth(scene.camera, conventions, picture.depth[pixel]);
      if (hit.polygon == no_polygon) {
        REQUIRE(z_v == no_depth);
      } else {
        REQUIRE(z_v == doctest::Approx(hit.z_v).epsilon(1e-10));
        ++agreement.drawn;
      }
      ++agreement.agreed;
    }
  }
  return agreement;
}

}  // namespace

TEST_SUITE("z_buffer/visibility") {
  TEST_CASE("the eye inside a cube sees a wall at every pixel, each once") {
    test::Numbers random(5);
    for (int run = 0; run < 30; ++run) {
      Scene scene = test::cube(1);
      scene.raster = {48, 32, false};
      const glm::dvec3 target = random.in_box(0.1), eye = random.in_box(0.8);
      test::look(scene, Camera::Kind::perspective, eye, target, 0.01, 10);
      Conventions conventions;
      conventions.cull = false;
      CollectRecorder record;
      const Picture picture = z_buffer::run(scene, conventions, record);
      std::vector<int> visits(picture.polygon.size(), 0);
      for (const DepthCompare& compare : record.all<DepthCompare>()) ++visits[picture.at(compare.x, compare.y)];
      CHECK(std::count(visits.begin(), visits.end(), 1) == 48 * 32);
      CHECK(!record.all<ClipCross>().empty());
      const Agreement agreement = hold_against_rays(scene);
      CHECK(agreement.drawn == agreement.agreed);
      CHECK(agreement.doubtful < 5);
    }
  }

  TEST_CASE("from inside, culling leaves nothing of the cube") {
    Scene scene = test::cube(1);
    test::look(scene, Camera::Kind::perspective, {0.3, 0.1, 0.2}, {1, 0, 0}, 0.01, 10);
    NullRecorder record;
    const Picture picture = z_buffer::run(scene, {}, record);
    CHECK(std::count(picture.polygon.begin(), picture.polygon.end(), no_polygon) == 64 * 64);
  }

  TEST_CASE("random concave polygons through each other, through the eye and beyond: as the rays say") {
    test::Numbers random(17);
    Agreement sum;
    for (int run = 0; run < 40; ++run) {
      Scene scene;
      scene.raster = {40, 30, false};
      for (int i = 0; i < 12; ++i) {
        // One after the other, since compilers disagree on the order of arguments.
        const double radius = random.between(0.5, 3);
        const glm::dvec3 centre = random.in_box(2.5);
        test::add_polygon(scene, test::random_star(random, centre, radius, 3 + i % 5));
      }
      const auto kind = run % 2 == 0 ? Camera::Kind::perspective : Camera::Kind::orthographic;
      scene.camera.window = random.between(0.4, 2);
      const glm::dvec3 target = random.in_box(1), eye = random.in_box(3);
      test::look(scene, kind, eye, target, 0.3, 5);
      const Agreement agreement = hold_against_rays(scene);
      sum.agreed += agreement.agreed, sum.doubtful += agreement.doubtful, sum.drawn += agreement.drawn;
    }
    CHECK(sum.drawn > 15000);
    CHECK(sum.doubtful < 40);
  }
}
