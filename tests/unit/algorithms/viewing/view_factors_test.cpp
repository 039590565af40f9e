// T_1 … T_4 against the matrix that the methods use.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "algorithms/viewing/camera.hpp"

using namespace zstep;

namespace {

double farthest_apart(const glm::dmat4& a, const glm::dmat4& b) {
  double most = 0;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) most = std::max(most, std::abs(a[column][row] - b[column][row]));
  return most;
}

}  // namespace

TEST_SUITE("viewing/view_factors") {
  TEST_CASE("law: T_4 T_3 T_2 T_1 is the matrix that the methods use, for any eye") {
    std::mt19937 random(18);
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int k = 0; k < 400; ++k) {
      CAPTURE(k);
      Camera camera;
      camera.polar = k % 2 == 0;
      if (camera.polar) {
        camera.rho = between(0.5, 200), camera.theta = between(-360, 360), camera.phi = between(0, 180);
        if (k % 10 == 0) camera.theta = 90 * (k % 7), camera.phi = k % 20 == 0 ? 0 : 90;
        camera.view = viewing::eckert_view(camera.rho, camera.theta, camera.phi);
        camera.eye = viewing::eckert_eye(camera.rho, camera.theta, camera.phi);
      } else {
        camera.eye = {between(-50, 50), between(-50, 50), between(-50, 50)};
        const glm::dvec3 target(between(-50, 50), between(-50, 50), between(-50, 50));
        camera.view = viewing::look_at_view(camera.eye, target, {0, 0, k % 3 == 0 ? -1 : 1});
      }
      const auto t = viewing::view_factors(camera);
      REQUIRE(t);
      const double size = 1 + glm::length(camera.eye);
      CHECK(farthest_apart((*t)[3] * (*t)[2] * (*t)[1] * (*t)[0], camera.view) < 1e-13 * size);
      // And each does what it is said to do.
      CHECK(glm::length(glm::dvec3((*t)[0] * glm::dvec4(camera.eye, 1))) == 0);
      for (std::size_t n = 1; n < 4; ++n) {
        CHECK(farthest_apart((*t)[n] * glm::transpose((*t)[n]), glm::dmat4(1)) < 1e-14);
        CHECK(glm::determinant((*t)[n]) == doctest::Approx(n == 3 ? -1 : 1));
      }
      CHECK((*t)[1] * glm::dvec4(0, 0, 1, 0) == glm::dvec4(0, 0, 1, 0));
      CHECK((*t)[2] * glm::dvec4(1, 0, 0, 0) == glm::dvec4(1, 0, 0, 0));
    }
  }

  TEST_CASE("a tilted camera, and one without an eye, are none of four") {
    Camera camera;
    camera.polar = false;
    camera.eye = {3, 4, 5};
    camera.view = viewing::look_at_view(camera.eye, {0, 0, 0}, {0, 0, 1});
    CHECK(viewing::view_factors(camera));
    camera.view = viewing::look_at_view(camera.eye, {0, 0, 0}, {0, 1, 1});
    CHECK_FALSE(viewing::view_factors(camera));
    camera.view = viewing::look_at_view(camera.eye, {0, 0, 0}, {0, 0, 1});
    camera.kind = Camera::Kind::orthographic;
    CHECK_FALSE(viewing::view_factors(camera));
  }
}
