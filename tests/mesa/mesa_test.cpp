// The Z-buffer's pictures against Mesa's.
//
// Mesa puts vertices onto a grid of 1/256 pixel and computes in float32, so the two may differ where a pixel's centre
// lies within 1.5/256 of a pixel of some polygon's edge, and where two polygons have the same depth but for 1e-5 of it.
// Every pixel that differs must be explained by one of these; elsewhere depths agree to 1e-5.
//
// One thing more: a polygon seen almost edge-on can be so steep that the last bits of a float32 coordinate on the
// raster are worth more than 1e-5 of its depth. Such a pixel must be within what those bits explain, and zstep's own
// depth there must be that of the polygon's plane.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "algorithms/scene/load.hpp"
#include "algorithms/viewing/clip.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/mesa/mesa.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

constexpr double edge_tolerance = 1.5 / 256;  // pixels
constexpr double depth_tolerance = 1e-5;      // of the depth

struct Segment {
  glm::dvec2 from, to;
};

// The edges of all facets on the raster, those facing away included.
std::vector<Segment> edges_on_raster(const Scene& scene) {
  NullRecorder record;
  const viewing::Lens lens(scene.camera, scene.raster, Conventions::Depth::pseudodepth);
  viewing::Vertices vertices = viewing::view_vertices(scene, lens, record);
  std::vector<Segment> segments;
  clipping::Outline outline;
  for (const Facet& facet : scene.facets) {
    if (!clipping::find_outline(scene, facet, false, lens, vertices, outline, record)) continue;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const auto at = [&](std::size_t n) { return glm::dvec2(vertices[static_cast<std::size_t>(outline[n])].raster); };
      segments.push_back({at(i), at(i + 1 < outline.size() ? i + 1 : 0)});
    }
  }
  return segments;
}

double distance_to_nearest(const std::vector<Segment>& segments, glm::dvec2 pixel) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) {
    const glm::dvec2 along = segment.to - segment.from;
    const double length = glm::dot(along, along);
    const double t = length > 0 ? std::clamp(glm::dot(pixel - segment.from, along) / length, 0.0, 1.0) : 0;
    nearest = std::min(nearest, glm::length(pixel - (segment.from + t * along)));
  }
  return nearest;
}

// z_v of the plane of a polygon's facet nearest to z_v = `near_to`, at a place on the raster; by ray and plane alone.
double depth_of_plane(const Scene& scene, std::int32_t polygon, glm::dvec2 place, double near_to) {
  const Camera& camera = scene.camera;
  const double half_x = camera.window * scene.raster.width / scene.raster.height;
  const double x_p = ((place.x + 0.5) / scene.raster.width * 2 - 1) * half_x;
  const double y_p = (1 - (place.y + 0.5) / scene.raster.height * 2) * camera.window;
  const bool perspective = camera.kind == Camera::Kind::perspective;
  const glm::dvec3 from = perspective ? glm::dvec3(0) : glm::dvec3(x_p, y_p, 0);
  const glm::dvec3 along = perspective ? glm::dvec3(x_p / camera.d, y_p / camera.d, 1) : glm::dvec3(0, 0, 1);

  double best = std::numeric_limits<double>::infinity();
  for (const Facet& facet : scene.facets) {
    if (facet.polygon != polygon) continue;
    const auto corner = [&](std::int32_t i) {
      const auto index = static_cast<std::size_t>(scene.corners[static_cast<std::size_t>(facet.first_corner + i)]);
      return glm::dvec3(camera.view * glm::dvec4(scene.points[index], 1));
    };
    glm::dvec3 normal(0);
    for (std::int32_t i = 1; i + 1 < facet.corner_count; ++i) {
      normal += glm::cross(corner(i) - corner(0), corner(i + 1) - corner(0));
    }
    const double z_v = from.z + along.z * glm::dot(corner(0) - from, normal) / glm::dot(along, normal);
    if (std::abs(z_v - near_to) < std::abs(best - near_to)) best = z_v;
  }
  return best;
}

// Whether a difference of depth is what the last bits of float32 coordinates on the raster explain, with our depth
// right.
bool explained_by_steepness(const Scene& scene, std::int32_t polygon, glm::dvec2 pixel, double our_z, double mesas_z) {
  const double truth = depth_of_plane(scene, polygon, pixel, our_z);
  if (std::abs(our_z - truth) > 1e-9 * truth) return false;
  const double shift = scene.raster.width * 0x1p-22;  // pixels: four roundings at the raster's width
  double range = 0;
  for (const glm::dvec2 by :
       {glm::dvec2(shift, 0), glm::dvec2(-shift, 0), glm::dvec2(0, shift), glm::dvec2(0, -shift)}) {
    range = std::max(range, std::abs(depth_of_plane(scene, polygon, pixel + by, our_z) - truth));
  }
  return std::abs(mesas_z - truth) <= depth_tolerance * truth + 2 * range;
}

struct Count {
  int drawn = 0, at_edges = 0, ties = 0, steep = 0, unexplained = 0;
  double worst_depth = 0;
};

Count hold_against_mesa(const Scene& scene, bool cull) {
  NullRecorder record;
  Conventions conventions;
  conventions.cull = cull;
  const Picture ours = z_buffer::run(scene, conventions, record), mesas = test::draw_with_mesa(scene, cull);
  const std::vector<Segment> edges = edges_on_raster(scene);

  Count count;
  for (std::int32_t y = 0; y < ours.height; ++y) {
    for (std::int32_t x = 0; x < ours.width; ++x) {
      const std::size_t pixel = ours.at(x, y);
      const std::int32_t our_polygon = ours.polygon[pixel], mesas_polygon = mesas.polygon[pixel];
      if (our_polygon == no_polygon && mesas_polygon == no_polygon) continue;

      const double our_z = view_depth(scene.camera, conventions, ours.depth[pixel]), mesas_z = mesas.depth[pixel];
      const double difference = std::abs(our_z - mesas_z) / our_z;  // NaN where only one drew
      if (our_polygon == mesas_polygon && difference <= depth_tolerance) {
        count.worst_depth = std::max(count.worst_depth, difference);
        ++count.drawn;
      } else if (distance_to_nearest(edges, {x, y}) <= edge_tolerance) {
        ++count.at_edges;
      } else if (our_polygon != mesas_polygon && difference <= depth_tolerance) {
        ++count.ties;
      } else if (our_polygon == mesas_polygon && explained_by_steepness(scene, our_polygon, {x, y}, our_z, mesas_z)) {
        ++count.steep;
      } else if (++count.unexplained <= 5) {
        INFO("pixel (", x, ", ", y, "): polygon ", our_polygon, " at ", our_z, ", Mesa has ", mesas_polygon, " at ",
             mesas_z, "; ", distance_to_nearest(edges, {x, y}), " px from an edge");
        CHECK(our_polygon == mesas_polygon);
        CHECK(difference <= depth_tolerance);
      }
    }
  }
  MESSAGE(count.drawn, " pixels agree, depths to ", count.worst_depth, "; at edges ", count.at_edges, ", ties ",
          count.ties, ", steep ", count.steep);
  CHECK(count.unexplained == 0);
  CHECK(count.drawn > ours.width * ours.height / 10);
  return count;
}

}  // namespace

TEST_SUITE("mesa") {
  TEST_CASE("which Mesa") { MESSAGE(test::mesa_version()); }

  TEST_CASE("teapot, cube and dodecahedron, from three cameras each, perspective and orthographic") {
    struct View {
      double rho, theta, phi;
    };
    Count sum;
    for (const std::string name : {"teapot", "cube", "dodecahedron"}) {
      for (const View view : {View{3, 30, 60}, View{2.5, 200, 80}, View{4, -75, 25}}) {
        for (const bool orthographic : {false, true}) {
          CAPTURE(name);
          CAPTURE(view.theta);
          CAPTURE(orthographic);
          ViewOptions options;
          options.rho = view.rho, options.theta = view.theta, options.phi = view.phi;
          options.d = 1;
          options.window = orthographic ? 1 : 1 / view.rho;
          options.orthographic = orthographic;
          options.width = 640, options.height = 480;
          options.fit = true;
          const Count count = hold_against_mesa(look_at_scene(load_scene(name).scene, options), true);
          sum.drawn += count.drawn, sum.at_edges += count.at_edges, sum.ties += count.ties, sum.steep += count.steep;
        }
      }
    }
    MESSAGE("in all 18: ", sum.drawn, " pixels agree; at edges ", sum.at_edges, ", ties ", sum.ties, ", steep ",
            sum.steep);
    // So few that the rule cannot hide a fault.
    CHECK(sum.at_edges < sum.drawn / 5000);
    CHECK(sum.ties < sum.drawn / 100000);
    CHECK(sum.steep < sum.drawn / 100000);
  }

  TEST_CASE("the eye inside a cube, and polygons through each other, clipped by all planes") {
    test::Numbers random(8);
    for (int run = 0; run < 10; ++run) {
      Scene scene = test::cube(1);
      scene.raster = {320, 240, false};
      for (int i = 0; i < 8; ++i) {
        const glm::dvec3 centre = random.in_box(0.8);
        test::add_polygon(scene, std::vector<glm::dvec3>{centre + random.in_box(0.9), centre + random.in_box(0.9),
                                                         centre + random.in_box(0.9)});
      }
      const auto kind = run % 2 == 0 ? Camera::Kind::perspective : Camera::Kind::orthographic;
      const glm::dvec3 target = random.in_box(1), eye = random.in_box(0.5);
      test::look(scene, kind, eye, target, 0.1, 2);
      CAPTURE(run);
      const Count count = hold_against_mesa(scene, false);
      CHECK(count.at_edges < count.drawn / 1000);
      CHECK(count.ties < count.drawn / 1000);
      CHECK(count.steep < count.drawn / 50);
    }
  }
}
