// Built-in scenes and meshes.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/built_in/built_in.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;

namespace {

struct Outcomes {
  int wins_over_nothing = 0, wins_over_polygon = 0, fails = 0, ties = 0;
};

/// Draws with the Z-buffer, holding each compare against a buffer kept alongside.
Outcomes compares_of(const SceneFile& file) {
  const Scene scene = look_at_scene(file.scene, {});
  CollectRecorder events;
  z_buffer::run(scene, file.conventions, events);
  Picture kept(scene.raster.width, scene.raster.height);
  Outcomes outcomes;
  for (const DepthCompare& compare : events.all<DepthCompare>()) {
    double& stored = kept.depth[kept.at(compare.x, compare.y)];
    if (!compare.nearer) ++(compare.z == stored ? outcomes.ties : outcomes.fails);
    else ++(stored == no_depth ? outcomes.wins_over_nothing : outcomes.wins_over_polygon);
    if (compare.nearer) stored = compare.z;
  }
  return outcomes;
}

std::map<std::int32_t, int> pixels_of(const SceneFile& file) {
  NullRecorder record;
  const Picture picture = z_buffer::run(look_at_scene(file.scene, {}), file.conventions, record);
  std::map<std::int32_t, int> count;
  for (const std::int32_t polygon : picture.polygon) ++count[polygon];
  return count;
}

}  // namespace

TEST_SUITE("built-in scenes") {
  TEST_CASE("every one loads, is in the picture, and leaves a margin round itself") {
    CHECK(built_in_scenes().size() >= 9);
    for (const BuiltIn& about : built_in_scenes()) {
      const SceneFile file = load_scene(std::string(about.name));
      CAPTURE(file.scene.name);
      CHECK(file.scene.name == about.name);
      CHECK(file.scene.source == "built-in");
      CHECK(!about.description.empty());
      NullRecorder record;
      const Scene scene = look_at_scene(file.scene, {});
      const Picture picture = z_buffer::run(scene, file.conventions, record);
      int drawn = 0, on_border = 0;
      for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
          if (picture.polygon[picture.at(x, y)] == no_polygon) continue;
          ++drawn;
          if (x == 0 || y == 0 || x == picture.width - 1 || y == picture.height - 1) ++on_border;
        }
      CHECK(drawn * 10 > picture.width * picture.height);
      if (scene.camera.kind != Camera::Kind::screen) CHECK(on_border == 0);
    }
  }

  TEST_CASE("pyramid-behind: a compare wins against nothing, wins against a polygon, fails and ties") {
    const Outcomes outcomes = compares_of(load_scene("pyramid-behind"));
    CHECK(outcomes.wins_over_nothing > 100);
    CHECK(outcomes.wins_over_polygon > 20);
    CHECK(outcomes.fails > 20);
    CHECK(outcomes.ties > 50);
    const SceneFile file = load_scene("pyramid-behind");
    auto pixels = pixels_of(file);
    CHECK(file.scene.polygons[0].name == "F");
    CHECK(pixels[0] > 50);
    CHECK(file.scene.polygons[6].name == "G");
    CHECK(pixels[6] == 0);
  }

  TEST_CASE("cyclic: each triangle hides a part of the next") {
    const SceneFile file = load_scene("cyclic");
    auto all = pixels_of(file);
    for (std::int32_t polygon = 0; polygon < 3; ++polygon) {
      // Drawn alone and drawn with the one before it in the circle, which loses pixels to it.
      const std::size_t k = static_cast<std::size_t>(polygon), next = (k + 1) % 3;
      const auto id = static_cast<std::int32_t>(next);
      SceneFile alone = file, other_alone = file, pair = file;
      alone.scene.facets = {file.scene.facets[next]};
      other_alone.scene.facets = {file.scene.facets[k]};
      pair.scene.facets = {file.scene.facets[k], file.scene.facets[next]};
      CHECK(pixels_of(pair)[id] == pixels_of(alone)[id]);
      CHECK(pixels_of(pair)[polygon] < pixels_of(other_alone)[polygon]);
    }
    for (std::int32_t polygon = 0; polygon < 3; ++polygon) CHECK(all[polygon] > 20);
  }

  TEST_CASE("intersecting: both triangles are nearer somewhere where both are") {
    const Outcomes outcomes = compares_of(load_scene("intersecting"));
    CHECK(outcomes.wins_over_polygon > 5);
    CHECK(outcomes.fails > 5);
  }

  TEST_CASE("solids face outwards") {
    for (const char* name : {"cube", "pyramid", "dodecahedron"}) {
      const PolygonSoup soup = *built_in_mesh(name);
      for (const Facet& outline : soup.outlines) {
        const auto corners = soup.corners_of(outline);
        CHECK(is_planar(soup.points, corners));
        CHECK(glm::dot(newell_normal(soup.points, corners), soup.points[static_cast<std::size_t>(corners[0])]) > 0);
      }
    }
    CHECK(built_in_mesh("dodecahedron")->outlines[0].corner_count == 5);
  }

  TEST_CASE("the teapot's size, orientation and seams, at several levels") {
    for (const int level : {1, 2, 3, 5, 8, 16, 40}) {
      CAPTURE(level);
      const PolygonSoup soup = teapot(level);
      CHECK(soup.outlines.size() == static_cast<std::size_t>(28 * level * level));
      // The borders of neighbouring patches are the same points: no two points are nearly but not quite one.
      std::map<std::tuple<long, long, long>, int> cells;
      const auto cell = [](double v) { return std::lround(v * 1e7); };
      for (const glm::dvec3& p : soup.points) CHECK(++cells[{cell(p.x), cell(p.y), cell(p.z)}] == 1);
      // Open at the rim and the bottom of the pot, at the lid's edge, at both ends of handle and spout, and nowhere
      // else.
      const Mesh mesh = build_mesh(soup.points, soup.outlines, soup.corners);
      CHECK(mesh.loose_faces == 0);
      // At level 1 both halves of the handle are the same flat strip.
      if (level > 1) CHECK(mesh.boundary_edges == 3 * 4 * level + 4 * 2 * level);
      int triangles = 0;
      for (const Facet& outline : soup.outlines) triangles += outline.corner_count == 3 ? 1 : 0;
      CHECK(triangles >= 4 * level);
    }
    const PolygonSoup soup = teapot(16);
    glm::dvec3 low(9), high(-9);
    for (const glm::dvec3& p : soup.points) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    CHECK(low.x == doctest::Approx(-1).epsilon(0.001));
    CHECK(high.x == doctest::Approx(1).epsilon(0.001));
    CHECK(low.z == doctest::Approx(-high.z));
    CHECK(low.y == doctest::Approx(-high.y).epsilon(1e-4));
    // The belly faces away from the pot's axis.
    for (const Facet& outline : soup.outlines) {
      const auto corners = soup.corners_of(outline);
      const glm::dvec3 p = soup.points[static_cast<std::size_t>(corners[0])], n = newell_normal(soup.points, corners);
      const glm::dvec2 out(p.x + (554258.0 - 500000.0) / 804258, p.y);
      if (outline.polygon >= 4 * 256 && outline.polygon < 12 * 256) CHECK(out.x * n.x + out.y * n.y > 0);
    }
  }

  TEST_CASE("names and levels") {
    CHECK(load_scene("teapot:2").scene.polygons.size() == 112);
    CHECK(load_scene("teapot:2").scene.name == "teapot:2");
    CHECK(load_scene("teapot").scene.polygons.size() == 1792);
    for (const char* name :
         {"teapot:", "teapot:0", "teapot:65", "teapot:x", "teapot:-1", "teapot:99999999999999999999"})
      CHECK(contains(input_error([&] { load_scene(name); }), "the level is not a whole number from 1 to 64"));
    CHECK(contains(input_error([&] { load_scene("teapots"); }), "name a .toml, .obj"));
    CHECK(contains(input_error([&] { load_scene(""); }), "there is no such scene"));
  }
}
