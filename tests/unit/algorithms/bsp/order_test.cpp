// One tree, any eye: what the order of drawing must do.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "algorithms/bsp/bsp.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using namespace zstep::bsp;
using test::Numbers;

namespace {

Scene stars(int count, unsigned seed) {
  Numbers random(seed);
  Scene scene = test::cube(0.4);
  for (int i = 0; i < count; ++i) test::add_polygon(scene, test::random_star(random, random.in_box(1), 0.8, 3 + i % 5));
  scene.raster = {48, 36, false};
  return scene;
}

Conventions with(const std::map<std::string, std::string>& options, bool cull = false) {
  Conventions conventions;
  conventions.cull = cull;
  conventions.options = options;
  return conventions;
}

Picture z_buffered(const Scene& scene, bool cull = false) {
  NullRecorder nothing;
  return z_buffer::run(scene, with({}, cull), nothing);
}

// Pixels at which two pictures show another polygon, but for depths that are equal to 1e-5.
int differing(const Picture& one, const Picture& other, const Camera& camera) {
  int count = 0;
  for (std::size_t pixel = 0; pixel < one.polygon.size(); ++pixel) {
    if (one.polygon[pixel] == other.polygon[pixel]) continue;
    const double a = view_depth(camera, {}, one.depth[pixel]), b = view_depth(camera, {}, other.depth[pixel]);
    count += !(std::abs(a - b) <= 1e-5 * std::abs(a));
  }
  return count;
}

}  // namespace

TEST_SUITE("bsp/order") {
  TEST_CASE("a BSP draws back to front from 100 random eyes with one build") {
    Numbers random(5);
    Scene scene = stars(24, 7);
    NullRecorder nothing;
    const Tree tree = build(scene, {}, nothing);
    const Conventions conventions = with({});
    std::int64_t painted = 0, seen = 0;
    int differences = 0;
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 eye = (0.2 + 0.02 * i) * glm::normalize(random.in_box(1));  // inside the scene, and outside
      const auto kind = i % 4 == 3 ? Camera::Kind::orthographic : Camera::Kind::perspective;
      test::look(scene, kind, eye, random.in_box(0.3), kind == Camera::Kind::perspective ? 0.01 : -4, 8);
      CollectRecorder record;
      const Picture picture = draw(tree, scene, conventions, record);
      Picture depths(scene.raster.width, scene.raster.height);
      int wrong = 0;
      for (const PixelPaint& paint : record.all<PixelPaint>()) {
        double& stored = depths.depth[depths.at(paint.x, paint.y)];
        const double before = view_depth(scene.camera, conventions, stored);
        wrong += view_depth(scene.camera, conventions, paint.z) > before + 1e-6 * std::abs(before);
        stored = paint.z;
        ++painted;
      }
      CAPTURE(i);
      CHECK(wrong == 0);
      const Picture truth = z_buffered(scene);
      differences += differing(picture, truth, scene.camera);
      seen += std::count_if(truth.polygon.begin(), truth.polygon.end(), [](std::int32_t p) { return p >= 0; });
    }
    CHECK(differences == 0);
    CHECK(painted > seen * 2);
    CHECK(seen > 50'000);
  }

  TEST_CASE("whatever the options, the picture is the same") {
    Scene scene = stars(30, 11);
    test::look(scene, Camera::Kind::perspective, {0.3, -1.6, 0.5}, {0, 0, 0}, 0.05, 4);
    for (const bool cull : {false, true}) {
      const Picture truth = z_buffered(scene, cull);
      for (const std::string root : {"first", "fewest-splits", "random"}) {
        for (const std::string order : {"back-to-front", "front-to-back"}) {
          for (const std::string discard : {"off", "on"}) {
            CAPTURE(root);
            CAPTURE(order);
            CAPTURE(discard);
            CAPTURE(cull);
            NullRecorder nothing;
            const auto conventions = with({{"root", root}, {"order", order}, {"discard", discard}}, cull);
            CHECK(differing(run(scene, conventions, nothing), truth, scene.camera) == 0);
          }
        }
      }
    }
  }

  TEST_CASE("front to back each pixel is painted once, and the rest is counted as saved") {
    Scene scene = stars(30, 11);
    test::look(scene, Camera::Kind::perspective, {0.3, -1.6, 0.5}, {0, 0, 0}, 0.05, 4);
    CollectRecorder back, front;
    const Picture one = run(scene, with({}), back), other = run(scene, with({{"order", "front-to-back"}}), front);
    const auto seen = std::count_if(one.polygon.begin(), one.polygon.end(), [](std::int32_t p) { return p >= 0; });
    CHECK(static_cast<std::int64_t>(front.all<PixelPaint>().size()) == seen);
    std::int64_t saved = 0;
    for (const Saved& saving : front.all<Saved>()) saved += saving.coherence == Coherence::order ? saving.tests : 0;
    CHECK(saved == static_cast<std::int64_t>(back.all<PixelPaint>().size()) - seen);
    CHECK(saved > seen / 2);
  }

  TEST_CASE("subtrees behind the eye are passed over: fewer eye tests, the same bits") {
    Scene scene = stars(30, 11);
    test::look(scene, Camera::Kind::perspective, {0, 0, 0.9}, {0.3, 0.1, 3}, 0.05, 4);  // most of it is behind
    CollectRecorder on, off;
    const Picture one = run(scene, with({}), on), other = run(scene, with({{"discard", "off"}}), off);
    CHECK(one == other);
    CHECK(off.all<NodeSkip>().empty());
    std::size_t saved = 0;
    for (const Saved& saving : on.all<Saved>()) saved += static_cast<std::size_t>(saving.tests);
    CHECK(saved > 0);
    CHECK(on.all<EyeSide>().size() + saved == off.all<EyeSide>().size());
    for (const NodeSkip& skip : on.all<NodeSkip>()) CHECK((skip.value > 0) != skip.front);
  }

  TEST_CASE("back faces are dropped by the test that orders the drawing") {
    Scene scene = test::cube(1);
    scene.raster = {32, 32, false};
    test::look(scene, Camera::Kind::perspective, 5, 30, 60, 1, 10);
    CollectRecorder record;
    const Picture picture = run(scene, with({}, true), record);
    CHECK(differing(picture, z_buffered(scene, true), scene.camera) == 0);
    CHECK(record.all<PieceDraw>().size() == 3);
    CHECK(record.all<PolygonReject>().size() == 3);
    CHECK(record.all<FacingTest>().empty());
    CHECK(record.all<EyeSide>().size() == 6);
  }

  TEST_CASE("a teapot and 1,000 triangles, as the Z-buffer draws them") {
    Numbers random(3);
    Scene soup;
    for (int i = 0; i < 1000; ++i) test::add_polygon(soup, test::random_star(random, random.in_box(1), 0.15, 3));
    soup.raster = {64, 48, false};
    test::look(soup, Camera::Kind::perspective, 3, 40, 60, 1, 6);
    NullRecorder nothing;
    CHECK(differing(run(soup, with({}), nothing), z_buffered(soup), soup.camera) == 0);
    const Scene teapot = look_at_scene(load_scene("teapot").scene, {});
    CHECK(differing(run(teapot, with({}, true), nothing), z_buffered(teapot, true), teapot.camera) == 0);
  }
}
