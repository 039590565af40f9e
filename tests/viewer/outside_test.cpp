// The scene from outside: what stands where in the room, and that looking changes nothing.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "sim/viewer/model/outside.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Trace golden(const char* name) { return open_jsonl(test::in_checkout(std::string("tests/golden/") + name + ".jsonl")); }

}  // namespace

TEST_CASE("law: what a room has behind a place of the raster is seen there by the run's own camera") {
  int cameras = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    const Scene& scene = trace.scene();
    if (scene.camera.kind == Camera::Kind::screen) return;
    CAPTURE(name);
    std::mt19937 random(7);
    for (int k = 0; k < (scene.light ? 80 : 40); ++k) {
      const bool by_lamp = k >= 40;  // then by the light, whose picture is made like the eye's
      cameras += k % 40 == 0;
      const Room room(scene, by_lamp);
      const Camera& camera = room.camera();
      CHECK(camera.eye == (by_lamp ? scene.light->position : scene.camera.eye));
      const viewing::Lens lens(camera, scene.raster, Conventions::Depth::view);
      const auto share = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
      const double x = share() * scene.raster.width, y = share() * scene.raster.height,
                   z = room.near() + 0.01 + share() * (room.end() - room.near());
      const glm::dvec3 view(camera.view * glm::dvec4(room.behind(x, y, z), 1));
      CHECK(view.z == doctest::Approx(z));
      const glm::dvec3 plane = lens.project(view);
      const glm::dvec2 at = lens.to_viewport(plane.x, plane.y);
      CHECK(at.x == doctest::Approx(x));
      CHECK(at.y == doctest::Approx(y));
    }
  });
  CHECK(cameras > 8);
}

TEST_CASE("a screen scene stands in its room as it is on the raster, and farther away what is deeper") {
  const Trace trace = golden("edges");
  const Scene& scene = trace.scene();
  REQUIRE(scene.camera.kind == Camera::Kind::screen);
  const Room room(scene);
  for (const glm::dvec3& point : scene.points) {
    const glm::dvec3 there = room.place(point);
    CHECK(there.x == point.x);
    CHECK(there.z == (scene.raster.y_up ? point.y : -point.y));
    CHECK(glm::length(room.behind(point.x, point.y, point.z) - there) < 1e-9);
    CHECK(room.place(point + glm::dvec3(0, 0, 1)).y > there.y);
  }
}

TEST_CASE("a plane cuts the box of a room in a convex outline that lies in the plane") {
  const Trace trace = golden("bsp-behind");
  const Room room(trace.scene());
  for (const glm::dvec3 normal : {glm::dvec3(1, 0, 0), {0, 0, 1}, {1, 2, -1}, {0.3, -0.2, 0.9}}) {
    const glm::dvec3 middle = (room.low() + room.high()) / 2.0;
    const double d = -glm::dot(normal, middle);
    const std::vector<glm::dvec3> corners = room.section(normal.x, normal.y, normal.z, d);
    REQUIRE(corners.size() >= 3);
    REQUIRE(corners.size() <= 6);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      CHECK(std::abs(glm::dot(normal, corners[k]) + d) < 1e-9);
      const auto at = [&](std::size_t i) { return corners[(k + i) % corners.size()]; };
      // All turns go the same way.
      CHECK(glm::dot(normal, glm::cross(at(1) - at(0), at(2) - at(1))) > 0);
    }
    CHECK(room.section(normal.x, normal.y, normal.z, d + 1000 * glm::length(normal)).empty());
  }
}

TEST_CASE("law: at first all of a scene is seen from outside, with its eye and its window") {
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    const Room room(trace.scene());
    for (const auto& size : {std::pair{640, 360}, {200, 300}, {90, 60}}) {
      const int width = size.first, height = size.second;
      CAPTURE(width);
      const Outside outside(room, {}, width, height);
      double left = width, right = 0, top = height, bottom = 0;
      for (const glm::dvec3& mark : room.marks()) {
        const auto spot = outside.spot(mark);
        REQUIRE(spot);
        left = std::min(left, spot->x), right = std::max(right, spot->x);
        top = std::min(top, spot->y), bottom = std::max(bottom, spot->y);
      }
      CHECK(left >= 0);
      CHECK(right <= width);
      CHECK(top >= 0);
      CHECK(bottom <= height);
      // It fills the picture one way or the other.
      CHECK(std::max((right - left) / width, (bottom - top) / height) > 0.8);
    }
  });
}

TEST_CASE("walking round a scene changes its picture and nothing else, and leads back") {
  const Trace trace = golden("pyramid");
  App app(trace, nullptr, {}, 1280, 720);
  app.session().go_to(trace.size() / 2);
  app.set_lead("scene");
  const test::Bytes first = test::picture(app);
  const State before = app.session().state();
  double highest = 0, lowest = 0;
  for (int k = 1; k <= 20; ++k) {
    test::press(app, SDLK_6);
    highest = std::max(highest, app.ui().look.tilt), lowest = std::min(lowest, app.ui().look.tilt);
    if (k == 1) CHECK(test::picture(app) != first);
  }
  CHECK(highest == most_tilt);
  CHECK(lowest == least_tilt);
  test::press(app, SDLK_5);
  CHECK(test::picture(app) != first);
  CHECK(app.session().state() == before);
  CHECK(seen_from_outside(app.ui()));
  test::press(app, SDLK_v, KMOD_LSHIFT);
  CHECK(!seen_from_outside(app.ui()));
  CHECK(test::picture(app) != first);
  test::press(app, SDLK_v, KMOD_LSHIFT);
  CHECK(test::picture(app) == first);
}
