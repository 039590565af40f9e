// Planarity and ear clipping.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;

namespace {

std::vector<std::int32_t> count_up(std::size_t n) {
  std::vector<std::int32_t> corners;
  for (std::size_t i = 0; i < n; ++i) corners.push_back(static_cast<std::int32_t>(i));
  return corners;
}

std::vector<std::int32_t> cut(const std::vector<glm::dvec3>& points) {
  std::vector<std::int32_t> triangles;
  CHECK(EarClipper().cut(points, count_up(points.size()), triangles));
  CHECK(triangles.size() == 3 * (points.size() - 2));
  return triangles;
}

/// A closed random outline that does not cross itself in the x-y plane, with z at random.
std::vector<glm::dvec3> rough_star(Numbers& random, int corners, double roughness) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = i * 6.28318530717958647692 / corners, length = random.between(0.2, 1);
    points.push_back({length * std::cos(angle), length * std::sin(angle), random.between(-roughness, roughness)});
  }
  return points;
}

SceneFile load(MeshFormat format, const std::string& text) {
  SceneBuilder builder({});
  builder.add(read_mesh_bytes(format, text, "m"), "m", {});
  return builder.finish();
}

}  // namespace

TEST_SUITE("facets") {
  TEST_CASE("Newell's normal is twice the area, towards the side that sees the corners counter-clockwise") {
    const std::vector<glm::dvec3> square{{5, 5, 2}, {7, 5, 2}, {7, 7, 2}, {5, 7, 2}};
    CHECK(newell_normal(square, count_up(4)) == glm::dvec3(0, 0, 8));
    const std::vector<std::int32_t> back{3, 2, 1, 0};
    CHECK(newell_normal(square, back) == glm::dvec3(0, 0, -8));
  }

  TEST_CASE("planar within 1e-5 of the diagonal, wherever and however large the polygon is") {
    Numbers random(7);
    for (const double size : {1e-9, 1.0, 1e12})
      for (int i = 0; i < 200; ++i) {
        std::vector<glm::dvec3> star = random_star(random, size * random.in_box(3), size, 3 + i % 9);
        const auto corners = count_up(star.size());
        CHECK(is_planar(star, corners));
        if (star.size() < 5) continue;
        const glm::dvec3 normal = glm::normalize(newell_normal(star, corners));
        star[1] += 1e-3 * size * normal;
        CHECK(!is_planar(star, corners));
      }
  }

  TEST_CASE("what encloses no area: planar on one line, else not") {
    CHECK(is_planar(std::vector<glm::dvec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, count_up(4)));
    CHECK(is_planar(std::vector<glm::dvec3>{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, count_up(4)));
    CHECK(!is_planar(std::vector<glm::dvec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, count_up(4)));  // a bow tie
  }

  TEST_CASE("ears cover the polygon: areas add up, and every triangle turns as the polygon does") {
    Numbers random(11);
    for (int i = 0; i < 500; ++i) {
      const auto star = rough_star(random, 4 + i % 30, 0.3);
      const auto triangles = cut(star);
      double area = 0;
      for (std::size_t k = 0; k < triangles.size(); k += 3) {
        const double z = newell_normal(star, std::span(triangles).subspan(k, 3)).z;
        CHECK(z >= -1e-12);
        area += z;
      }
      CHECK(area == doctest::Approx(newell_normal(star, count_up(star.size())).z).epsilon(1e-9));
    }
  }

  TEST_CASE("ears in every orientation of the plane") {
    Numbers random(13);
    for (int i = 0; i < 200; ++i) {
      auto star = random_star(random, random.in_box(2), 1, 5 + i % 10);
      const glm::dvec3 normal = newell_normal(star, count_up(star.size()));
      for (glm::dvec3& point : star) point += 0.01 * random.between(-1, 1) * glm::normalize(normal);
      const auto triangles = cut(star);
      double area = 0;
      for (std::size_t k = 0; k < triangles.size(); k += 3)
        area += glm::dot(newell_normal(star, std::span(triangles).subspan(k, 3)), glm::normalize(normal));
      CHECK(area == doctest::Approx(glm::length(normal)).epsilon(1e-6));
    }
  }

  TEST_CASE("outlines that cross themselves, repeat points or have no area still come to an end") {
    cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}});
    cut({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    cut({{0, 0, 0}, {3, 0, 0}, {3, 3, 1}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}});
    Numbers random(17);
    for (int i = 0; i < 200; ++i) {
      std::vector<glm::dvec3> points;
      for (int k = 0; k < 4 + i % 20; ++k) points.push_back(random.in_box(1));
      cut(points);
    }
  }

  TEST_CASE("a polygon that is not planar becomes facets of one polygon, a planar one stays whole") {
    const SceneFile file = load(
        MeshFormat::obj, "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nv -1 2 0\nv -1 0 0\nf 1 2 3 4\nf 1 4 5 6\nf 1 6 2\n");
    const Scene& scene = file.scene;
    REQUIRE(scene.polygons.size() == 3);
    REQUIRE(scene.facets.size() == 4);
    CHECK(scene.facets[0].polygon == 0);
    CHECK(scene.facets[1].polygon == 0);
    CHECK(scene.facets[1].corner_count == 3);
    CHECK(scene.facets[2] == Facet{1, 6, 4});
    CHECK(scene.facets[3].polygon == 2);
    CHECK(file.notes.size() == 2);  // the cut, and the last polygon without area
  }

  TEST_CASE("repeated corners go, what has fewer than three left keeps its index but is not drawn") {
    const Scene scene =
        load(MeshFormat::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2 3 3 1\nf 1 2\nf 3\nf 1 2 1\nf 3 2 1\n").scene;
    REQUIRE(scene.polygons.size() == 5);
    REQUIRE(scene.facets.size() == 2);
    CHECK(scene.facets[0] == Facet{0, 0, 3});
    CHECK(scene.facets[1] == Facet{4, 3, 3});
    CHECK(scene.corners == std::vector<std::int32_t>{0, 1, 2, 2, 1, 0});
  }

  TEST_CASE("a polygon of very many corners is refused, not chewed on") {
    const auto polygon_of = [](int corners) {
      std::string text, face = "f";
      for (int i = 0; i < corners; ++i) {
        text += fmt::format("v {} {} {}\n", i % 1000, i / 1000, i % 7);
        face += fmt::format(" {}", i + 1);
      }
      return text + face + "\n";
    };
    const std::string most = input_error([&] { load(MeshFormat::obj, polygon_of(20000)); });
    CHECK(contains(most, "m:20001: polygons that are not planar have too many corners"));
    const std::string more = input_error([&] { load(MeshFormat::obj, polygon_of(20001)); });
    CHECK(contains(more, "m:20002: there are more than 20000 corners of one polygon"));
  }
}
