// The camera against the formulas as the notes print them.
#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "algorithms/viewing/camera.hpp"

using namespace zstep;

namespace {

constexpr double degree = 3.14159265358979323846 / 180;

Camera camera_between(Camera::Kind kind, double near, double far) {
  Camera camera;
  camera.kind = kind;
  camera.near = near;
  camera.far = far;
  return camera;
}

}  // namespace

TEST_SUITE("viewing/camera") {
  TEST_CASE("T_v is the matrix printed in Eckert's lecture") {
    const double rho = 7, theta = 33, phi = 71;
    const double s_t = std::sin(theta * degree), c_t = std::cos(theta * degree);
    const double s_p = std::sin(phi * degree), c_p = std::cos(phi * degree);
    const double printed[4][4] = {
        {-s_t, c_t, 0, 0}, {-c_p * c_t, -c_p * s_t, s_p, 0}, {-s_p * c_t, -s_p * s_t, -c_p, rho}, {0, 0, 0, 1}};
    const glm::dmat4 view = viewing::eckert_view(rho, theta, phi);
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        CHECK(view[column][row] == doctest::Approx(printed[row][column]).epsilon(1e-14));
      }
    }
  }

  TEST_CASE("T_v takes the eye to the origin and the origin to distance rho, at every angle") {
    for (int theta = -400; theta <= 400; theta += 37) {
      for (int phi = 0; phi <= 180; phi += 15) {
        const glm::dmat4 view = viewing::eckert_view(5, theta, phi);
        const glm::dvec4 eye(viewing::eckert_eye(5, theta, phi), 1);
        CHECK(glm::length(glm::dvec3(view * eye)) < 1e-14 * 20);
        CHECK(glm::dvec3(view * glm::dvec4(0, 0, 0, 1)) == glm::dvec3(0, 0, 5));
        CHECK(glm::determinant(glm::dmat3(view)) == doctest::Approx(-1));  // left-handed
      }
    }
  }

  TEST_CASE("right angles and halves are exact") {
    CHECK(viewing::eckert_eye(4, 0, 90) == glm::dvec3(4, 0, 0));
    CHECK(viewing::eckert_eye(4, 90, 90) == glm::dvec3(0, 4, 0));
    CHECK(viewing::eckert_eye(4, 180, 90) == glm::dvec3(-4, 0, 0));
    CHECK(viewing::eckert_eye(4, -450, 90) == glm::dvec3(0, -4, 0));
    CHECK(viewing::eckert_view(4, 30, 60)[0][0] == -0.5);
    CHECK(viewing::eckert_view(4, 30, 60)[2][2] == -0.5);
  }

  TEST_CASE("looking from Eckert's eye at the origin is T_v") {
    const glm::dmat4 expected = viewing::eckert_view(6, 40, 50);
    const glm::dmat4 view = viewing::look_at_view(viewing::eckert_eye(6, 40, 50), {0, 0, 0}, {0, 0, 1});
    for (int column = 0; column < 4; ++column) {
      CHECK(glm::length(view[column] - expected[column]) < 1e-14 * 6);
    }
  }

  TEST_CASE("an up vector along the line of sight is replaced") {
    const glm::dmat4 view = viewing::look_at_view({0, 0, 5}, {0, 0, 1}, {0, 0, 2});
    CHECK(glm::determinant(glm::dmat3(view)) == doctest::Approx(-1));
    CHECK(glm::dvec3(view * glm::dvec4(0, 0, 1, 1)) == glm::dvec3(0, 0, 4));
  }

  TEST_CASE("field of view") {
    CHECK(viewing::window_for_field_of_view(90, 2) == doctest::Approx(2));
    CHECK(viewing::window_for_field_of_view(60, 1) == doctest::Approx(1 / std::sqrt(3.0)));
  }

  TEST_CASE("pseudodepth takes near to -1 and far to +1, keeps the order, and is undone by view_depth") {
    for (const auto kind : {Camera::Kind::perspective, Camera::Kind::orthographic}) {
      const Camera camera = camera_between(kind, 1.5, 40);
      const viewing::Lens lens(camera, {64, 48}, Conventions::Depth::pseudodepth);
      CHECK(lens.project({0, 0, 1.5}).z == doctest::Approx(-1));
      CHECK(lens.project({0, 0, 40}).z == doctest::Approx(1));
      double before = -2;
      for (double z_v = 1.5; z_v <= 40; z_v += 0.25) {
        const double z = lens.project({0.3, 0.2, z_v}).z;
        CHECK(z > before);
        CHECK(view_depth(camera, {}, z) == doctest::Approx(z_v).epsilon(1e-13));
        before = z;
      }
      CHECK(view_depth(camera, {}, no_depth) == no_depth);
    }
  }

  TEST_CASE("view_depth returns what is z_v, or a screen scene's z, already") {
    Conventions eckert;
    eckert.depth = Conventions::Depth::view;
    CHECK(view_depth(camera_between(Camera::Kind::perspective, 1, 10), eckert, 3.25) == 3.25);
    CHECK(view_depth(camera_between(Camera::Kind::screen, 0, 0), {}, 3.25) == 3.25);
  }

  TEST_CASE("clip coordinates divided by w are the projection") {
    for (const auto kind : {Camera::Kind::perspective, Camera::Kind::orthographic}) {
      Camera camera = camera_between(kind, 2, 9);
      camera.d = 1.5;
      camera.window = 0.75;
      const viewing::Lens lens(camera, {64, 32}, Conventions::Depth::pseudodepth);
      const glm::dvec3 point(0.7, -1.1, 5);
      const glm::dvec4 clip = lens.clip_coordinates(point);
      const glm::dvec3 projected = lens.project(point);
      CHECK(clip.x / clip.w == doctest::Approx(projected.x / (0.75 * 2)));
      CHECK(clip.y / clip.w == doctest::Approx(projected.y / 0.75));
      CHECK(clip.z / clip.w == doctest::Approx(projected.z));
    }
  }

  TEST_CASE("the window's corners fall half a pixel outside the outermost pixel centres") {
    const viewing::Lens lens(camera_between(Camera::Kind::perspective, 1, 10), {64, 32},
                             Conventions::Depth::pseudodepth);
    CHECK(lens.to_viewport(-2, 1) == glm::dvec2(-0.5, -0.5));
    CHECK(lens.to_viewport(2, -1) == glm::dvec2(63.5, 31.5));
    CHECK(lens.to_viewport(0, 0) == glm::dvec2(31.5, 15.5));
  }
}
