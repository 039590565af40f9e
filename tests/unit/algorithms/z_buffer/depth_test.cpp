// Depths: which of them may be interpolated, and how far increments stray from the formula.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

Picture draw(const Scene& scene, const Conventions& conventions) {
  NullRecorder record;
  return z_buffer::run(scene, conventions, record);
}

// A wall that recedes to the right: from x_v = -1 at z_v = 2 to x_v = 5 at z_v = 10, so from x_p = -0.5 to 0.5.
Scene receding_wall() {
  Scene scene;
  scene.raster = {65, 65, false};
  test::add_polygon(scene, std::vector<glm::dvec3>{{-2, -1, -1}, {-10, 5, -1}, {-10, 5, 1}, {-2, -1, 1}});
  test::look(scene, Camera::Kind::perspective, glm::dvec3(0), {-1, 0, 0}, 1, 20);
  return scene;
}

}  // namespace

TEST_SUITE("z_buffer/depth") {
  TEST_CASE("pseudodepth is linear on the raster: every pixel has the wall's true depth") {
    const Scene scene = receding_wall();
    const Conventions conventions;
    const Picture picture = draw(scene, conventions);
    int drawn = 0;
    for (std::int32_t x = 0; x < 65; ++x) {
      const std::size_t pixel = picture.at(x, 32);
      if (picture.polygon[pixel] == no_polygon) continue;
      // The wall is x_v = (3 z_v - 10)/4; the ray x_v = x_p z_v meets it at z_v = 10/(3 - 4 x_p).
      const double x_p = (x + 0.5) / 65 * 2 - 1;
      CHECK(view_depth(scene.camera, conventions, picture.depth[pixel]) ==
            doctest::Approx(10 / (3 - 4 * x_p)).epsilon(1e-13));
      ++drawn;
    }
    CHECK(drawn == 33);
  }

  TEST_CASE("z_v is not: in the middle of this wall it reads 6 where the truth is 3 1/3") {
    const Scene scene = receding_wall();
    Conventions conventions;
    conventions.depth = Conventions::Depth::view;
    const Picture picture = draw(scene, conventions);
    CHECK(picture.polygon[picture.at(32, 32)] == 0);  // x_p = 0
    CHECK(picture.depth[picture.at(32, 32)] == doctest::Approx(6));
  }

  TEST_CASE("z_v is linear on the raster under an orthographic camera") {
    Scene scene = receding_wall();
    test::look(scene, Camera::Kind::orthographic, glm::dvec3(0), {-1, 0, 0}, 1, 20);
    Conventions conventions;
    conventions.cull = false;  // seen so, it is the wall's other side
    for (const auto depth : {Conventions::Depth::view, Conventions::Depth::pseudodepth}) {
      conventions.depth = depth;
      const Picture picture = draw(scene, conventions);
      const double z_v = view_depth(scene.camera, conventions, picture.depth[picture.at(32, 32)]);
      CHECK(z_v == doctest::Approx(2 + 8 * (0.0 + 1) / 6).epsilon(1e-13));
    }
  }

  TEST_CASE("increments stay within 1e-11 of the direct formulas on a raster of 256") {
    test::Numbers random(31);
    std::vector<std::vector<glm::dvec3>> polygons;
    for (int i = 0; i < 300; ++i) {
      std::vector<glm::dvec3> polygon;
      for (int corner = 0; corner < 3 + i % 4; ++corner) {
        polygon.push_back({random.between(-20, 276), random.between(-20, 276), random.between(-1, 1)});
      }
      polygons.push_back(polygon);
    }
    // One at a time, so that no polygon hides a difference of another.
    double worst = 0;
    int coverage_differs = 0;
    for (const auto& polygon : polygons) {
      const Scene scene = test::screen_scene(256, 256, {polygon});
      Conventions conventions;
      const Picture direct = draw(scene, conventions);
      conventions.interpolation = Conventions::Interpolation::increments;
      const Picture increments = draw(scene, conventions);
      for (std::size_t pixel = 0; pixel < direct.depth.size(); ++pixel) {
        if (direct.polygon[pixel] != increments.polygon[pixel]) ++coverage_differs;
        else if (direct.polygon[pixel] != no_polygon)
          worst = std::max(worst, std::abs(direct.depth[pixel] - increments.depth[pixel]));
      }
    }
    INFO("largest difference: ", worst);
    CHECK(coverage_differs == 0);
    CHECK(worst > 0);  // they are not the same numbers
    CHECK(worst < 1e-11);
  }
}
