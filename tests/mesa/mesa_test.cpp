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
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/half_space/half_space.hpp"
#include "algorithms/interpolation/interpolation.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "sim/truth/explain_difference.hpp"
#include "tests/matrices.hpp"
#include "tests/mesa/mesa.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/check/check.hpp"
#include "traces/record/recorder.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;

namespace {

constexpr double depth_tolerance = compare::tie_tolerance;

// Whether an edge runs within the tolerance, be it of a polygon that is seen there or of a hidden one.
bool at_edge(const compare::Truth& truth, std::int32_t x, std::int32_t y) {
  const auto here = truth.at(x, y);
  return std::any_of(here.begin(), here.end(),
                     [](const compare::Candidate& facet) { return facet.edge <= compare::edge_tolerance; });
}

// Whether a difference of depth is what the last bits of float32 coordinates on the raster explain, with our depth
// right.
bool explained_by_steepness(const compare::Truth& truth, std::int32_t x, std::int32_t y, std::int32_t polygon,
                            double our_z, double mesas_z) {
  const double shift = truth.width() * 0x1p-22;  // pixels: four roundings at the raster's width
  for (const compare::Candidate& facet : truth.at(x, y)) {
    const bool ours = facet.polygon == polygon && std::abs(our_z - facet.z) <= 1e-9 * facet.z + facet.z_slack;
    if (ours && std::abs(mesas_z - facet.z) <= compare::tie_tolerance * facet.z + 2 * shift * facet.slope) return true;
  }
  return false;
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
  const compare::Truth truth(scene, cull);

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
      } else if (at_edge(truth, x, y)) {
        ++count.at_edges;
      } else if (our_polygon != mesas_polygon && difference <= depth_tolerance) {
        ++count.ties;
      } else if (our_polygon == mesas_polygon && explained_by_steepness(truth, x, y, our_polygon, our_z, mesas_z)) {
        ++count.steep;
      } else if (++count.unexplained <= 5) {
        INFO("pixel (", x, ", ", y, "): polygon ", our_polygon, " at ", our_z, ", Mesa has ", mesas_polygon, " at ",
             mesas_z);
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

namespace {

/// What OpenGL writes of each facet, as a run on a scene under OpenGL's conventions.
Trace run_of_mesa(const Scene& scene, const Scene& drawn, bool cull) {
  Conventions conventions;
  conventions.depth = Conventions::Depth::zero_to_one, conventions.cull = cull;
  conventions.number_format = NumberFormat::float32, conventions.positions = Conventions::Positions::subpixels;
  Header header = header_for(method("z-buffer"), conventions);
  header.written = {WrittenAs::Centre::half, WrittenAs::Axes::right_handed};
  const auto step = [&](std::string_view name) { return find_step(header.page, name)->id; };
  TraceRecorder recorder(header, scene);
  record_any(recorder, step("clear"), BuffersClear{no_depth});
  Picture before(scene.raster.width, scene.raster.height);
  test::drawn_by_opengl(drawn, cull, [&](std::int32_t facet, const Picture& now) {
    const std::int32_t polygon = scene.facets[static_cast<std::size_t>(facet)].polygon;
    record_any(recorder, step("polygon"), PolygonBegin{polygon, facet});
    for (std::int32_t y = 0; y < now.height; ++y)
      for (std::int32_t x = 0; x < now.width; ++x) {
        const std::size_t pixel = now.at(x, y);
        if (now.polygon[pixel] == before.polygon[pixel] && now.depth[pixel] == before.depth[pixel]) continue;
        record_any(recorder, step("write_depth"), DepthWrite{x, y, now.depth[pixel]});
        record_any(recorder, step("write_pixel"), PixelWrite{x, y, now.polygon[pixel]});
      }
    before = now;
  });
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "Mesa");
}

}  // namespace

TEST_SUITE("mesa") {
  TEST_CASE("which Mesa") { MESSAGE(test::mesa_version()); }

  TEST_CASE("check doubts nothing that Mesa draws, under OpenGL's conventions") {
    for (const std::string name : {"cube", "dodecahedron", "pyramid-behind", "cyclic", "teapot:2"})
      for (const bool orthographic : {false, true}) {
        CAPTURE(name);
        CAPTURE(orthographic);
        ViewOptions options;
        options.theta = 33, options.phi = 62, options.width = 160, options.height = 120, options.y_up = true;
        if (orthographic) options.orthographic = true;
        const Scene scene = look_at_scene(load_scene(name).scene, options);
        const Trace run = run_of_mesa(scene, scene, false);
        const CheckReport report = check(run);
        for (std::size_t i = 0; i < std::min<std::size_t>(5, report.causes.size()); ++i) {
          const Fault& fault = report.causes[i].first;
          const std::string rule(fault.rule ? rule_text(*fault.rule).name : "");
          FAIL_CHECK("step ", fault.step, ": ", fault.field, " ", fault.recorded, " ", fault.expected, " ", rule);
        }
        MESSAGE(name, ": ", report.numbers, " depths, of which ", report.wrong_steps, " are wrong");
        CHECK(report.numbers > 1000);
      }
  }

  TEST_CASE("through frusta beside the line of sight, and with a far plane at infinity") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const std::string name : {"dodecahedron", "pyramid-behind", "teapot:2"})
      for (const double far : {20.0, infinity}) {
        CAPTURE(name);
        CAPTURE(far);
        ViewOptions options;
        options.theta = 33, options.phi = 62, options.width = 320, options.height = 200;
        const Scene in_sight = look_at_scene(load_scene(name).scene, options);
        const double n = in_sight.camera.near / 2;
        const glm::dmat4 projection = test::frustum(-0.2 * n, 0.4 * n, -0.3 * n, 0.15 * n, n, far);
        Scene scene = test::seen_through(in_sight, projection, n, far);
        hold_against_mesa(scene, false);
        scene.raster.y_up = true;
        const CheckReport report = check(run_of_mesa(scene, scene, false));
        CHECK(report.causes.empty());
        CHECK(report.numbers > 1000);
      }
  }

  TEST_CASE("check finds that Mesa's pixels are not those of centres half a pixel beside") {
    ViewOptions options;
    options.theta = 33, options.phi = 62, options.width = 160, options.height = 120, options.y_up = true;
    const Scene scene = look_at_scene(load_scene("cube").scene, options);
    Scene moved = scene;
    moved.camera.view[3][0] += 0.5 * 2 * moved.camera.window / moved.raster.height * moved.camera.rho / moved.camera.d;
    CHECK(check(run_of_mesa(scene, moved, false)).wrong_steps > 100);
  }

  TEST_CASE("with vertices at 256ths of a pixel half-space draws Mesa's picture, pixel for pixel") {
    int drawn = 0;
    double largest = 0;
    for (const std::string name : {"cube", "dodecahedron", "pyramid-behind", "cyclic"})
      for (const bool orthographic : {false, true}) {
        CAPTURE(name);
        ViewOptions options;
        options.theta = 33, options.phi = 62, options.width = 160, options.height = 120, options.y_up = true;
        if (orthographic) options.orthographic = true;
        const Scene scene = look_at_scene(load_scene(name).scene, options);
        Conventions conventions;
        conventions.depth = Conventions::Depth::zero_to_one, conventions.cull = false;
        conventions.positions = Conventions::Positions::subpixels;
        NullRecorder record;
        const Picture ours = half_space::run(scene, conventions, record), mesas = test::drawn_by_opengl(scene, false);
        CHECK(ours.polygon == mesas.polygon);
        for (std::size_t pixel = 0; pixel < ours.polygon.size(); ++pixel) {
          if (ours.polygon[pixel] == no_polygon) continue;
          ++drawn;
          largest = std::max(largest, std::abs(ours.depth[pixel] - mesas.depth[pixel]));
        }
      }
    MESSAGE(drawn, " pixels, depths to ", largest);
    CHECK(largest < 1e-3);  // Mesa's planes go through the vertices where they were before they came to 256ths
    CHECK(drawn > 10'000);
  }

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

  TEST_CASE("colours and texture coordinates of vertices, perspective-correct, and an image by texels and mixed") {
    // A box whose inside is seen, and an image of noise. Of four corners' numbers that go with no plane each program
    // makes its own.
    test::Numbers random(19);
    Scene scene = test::cube(1);
    scene.raster = {320, 240, false};
    test::look(scene, Camera::Kind::perspective, {0.7, -0.5, 0.3}, {-0.6, 0.5, -0.2}, 0.1, 4);
    VertexAttribute color{color_attribute, 3, {}, {}, {}, {}}, uv{uv_attribute, 2, {}, {}, {}, {}};
    for (std::int32_t point = 0; point < size32(scene.points); ++point) {
      const glm::dvec3& p = scene.points[static_cast<std::size_t>(point)];
      color.values.insert(color.values.end(), {0.5 + 0.4 * p.x, 0.5 - 0.3 * p.y, 0.5 + 0.2 * p.z + 0.1 * p.x});
      uv.values.insert(uv.values.end(), {0.7 * p.x + 0.4 * p.y, 0.9 * p.z - 0.3 * p.y});
      color.of_point.push_back(point), uv.of_point.push_back(point);
    }
    scene.attributes = {color, uv};
    Texture noise{"noise.ppm", 16, 8, {}};
    const auto byte = [&] { return static_cast<std::uint8_t>(128 + 127 * random.in_box(1).x); };
    for (int k = 0; k < 16 * 8; ++k) noise.texels.push_back({byte(), byte(), byte()});
    scene.textures = {noise};
    Material textured;
    textured.texture = 0;
    for (Polygon& polygon : scene.polygons) polygon.material = textured;

    const compare::Truth truth(scene, false);
    const Picture mesas = test::draw_with_mesa(scene, false);
    struct Way {
      const char* shade;
      int most_off;  // of 255
    };
    // Mesa mixes texels by 8 bits of a fraction, and has coordinates in float32.
    for (const Way way : {Way{"colors", 1}, Way{"nearest", 0}, Way{"bilinear", 3}})
      for (const char* name : {"z-buffer", "half-space"}) {
        CAPTURE(std::string(way.shade));
        CAPTURE(std::string(name));
        Conventions conventions;
        conventions.cull = false, conventions.attribute = Conventions::Attribute::perspective;
        conventions.options["shade"] = way.shade;
        check_run(method(name), scene, conventions);
        NullRecorder record;
        const Picture ours = name == std::string("z-buffer") ? interpolation::run(scene, conventions, record)
                                                             : half_space::run(scene, conventions, record);
        const bool colors = way.shade == std::string("colors");
        const std::vector<Color> theirs =
            test::colors_by_opengl(scene, false, colors ? nullptr : &noise, way.shade == std::string("bilinear"));
        int drawn = 0, off = 0, largest = 0;
        for (std::int32_t y = 0; y < ours.height; ++y)
          for (std::int32_t x = 0; x < ours.width; ++x) {
            const std::size_t pixel = ours.at(x, y);
            if (ours.polygon[pixel] == no_polygon || ours.polygon[pixel] != mesas.polygon[pixel] ||
                at_edge(truth, x, y))
              continue;
            const Color a = color_at(ours, scene, pixel), b = theirs[pixel];
            const int by = std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
            ++drawn, off += by > way.most_off, largest = std::max(largest, by);
          }
        MESSAGE(std::string(name), ", ", std::string(way.shade), ": ", drawn, " pixels, ", off,
                " of them off by more than ", way.most_off, ", at most by ", largest);
        CHECK(drawn > 50'000);
        // Where a centre lies between two texels, 256ths of a pixel decide.
        CHECK(off <= (way.shade == std::string("nearest") ? drawn / 100 : 0));
      }
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
