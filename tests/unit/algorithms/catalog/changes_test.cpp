#include "algorithms/catalog/changes.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <string>

#include <doctest/doctest.h>

#include <fmt/format.h>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/error.hpp"

using namespace zstep;

namespace {

struct Run {
  Scene scene;
  Conventions conventions;
};
Run run_of(const char* name) {
  SceneFile file = load_scene(name);
  return {look_at_scene(std::move(file.scene), {}), file.conventions};
}

void change(const char* id, Run& run, const std::string& text) {
  make_change(method(id), read_change(text), run.scene, run.conventions);
}

std::string refused(const char* id, Run& run, const std::string& text) {
  const Run before = run;
  try {
    change(id, run, text);
  } catch (const InputError& error) {
    CHECK(run.scene == before.scene);
    CHECK(run.conventions == before.conventions);
    return error.what();
  }
  return "";
}

bool has_part(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("law: everything that can be changed can be set to what it is, and then nothing is changed") {
  for (const Method& one : methods()) {
    for (const char* scene : {"pyramid", "delhi", "cube", "y = sin(x)", "teapot:2"}) {
      Run run = run_of(scene);
      try {
        check_run(one, run.scene, run.conventions);
      } catch (const InputError&) {
        continue;  // a scene that this method cannot draw
      }
      const std::string method_id(one.id);
      CAPTURE(method_id);
      CAPTURE(scene);
      std::set<std::string> names;
      std::size_t looked = 0;
      for (const Changeable& what : changeables(one, run.scene, run.conventions)) {
        CAPTURE(what.name);
        CHECK(names.insert(what.name).second);
        CHECK_FALSE(what.meaning.empty());
        if (++looked > 60) continue;  // of many vertices the first
        Run same = run;
        make_change(one, {what.name, what.value}, same.scene, same.conventions);
        CHECK(same.scene.points == run.scene.points);
        CHECK(same.scene.facets == run.scene.facets);
        CHECK(same.scene.corners == run.scene.corners);
        CHECK(same.scene.camera == run.scene.camera);
        CHECK(same.scene.polygons == run.scene.polygons);
        CHECK(same.scene.raster == run.scene.raster);
        if (!what.choices.empty())
          CHECK(std::find(what.choices.begin(), what.choices.end(), what.value) != what.choices.end());
      }
    }
  }
}

TEST_CASE("changes: camera, raster, conventions and options") {
  Run run = run_of("pyramid");
  const Camera before = run.scene.camera;
  change("z-buffer", run, "theta = 75");
  CHECK(run.scene.camera.theta == 75);
  CHECK(run.scene.camera.view != before.view);
  change("z-buffer", run, "size = 40x30");
  CHECK(run.scene.raster.width == 40);
  CHECK(run.scene.raster.height == 30);
  change("z-buffer", run, "coverage = inclusive");
  CHECK(run.conventions.coverage == Conventions::Coverage::inclusive);
  change("z-buffer", run, "number-format = fixed16");
  CHECK(run.conventions.number_format == NumberFormat::fixed16);
  change("z-buffer", run, "cull = off");
  CHECK_FALSE(run.conventions.cull);
  Run walls = run_of("cube");
  change("bsp", walls, "root = first");
  CHECK(walls.conventions.options.at("root") == "first");
}

TEST_CASE("changes: the clipping planes go with a scene that states none, and stay where one states them") {
  Run cube = run_of("cube");
  change("z-buffer", cube, "near = 1");
  const double far = cube.scene.camera.far;
  change("z-buffer", cube, "theta = 80");
  CHECK(cube.scene.camera.near == 1);
  CHECK(cube.scene.camera.far == far);
  Run own = run_of("cube");
  const Camera before = own.scene.camera;
  change("z-buffer", own, "rho = 20");
  CHECK(own.scene.camera.near > before.near);
  CHECK(own.scene.camera.far > before.far);
}

TEST_CASE("changes: a vertex that moves bends polygons, which are cut, and has no line in a file any more") {
  Run run = run_of("cube");
  const std::size_t facets = run.scene.facets.size();
  const glm::dvec3 old = run.scene.points[0];
  change("z-buffer", run, fmt::format("vertex 0 = {} {} {}", old.x * 1.5, old.y, old.z * 0.5));
  CHECK(run.scene.points[0] == glm::dvec3(old.x * 1.5, old.y, old.z * 0.5));
  CHECK(run.scene.facets.size() > facets);
  CHECK(run.scene.point_lines.empty());
  CHECK(run.scene.file_points.empty());
  std::set<std::int32_t> seen;
  for (const Facet& facet : run.scene.facets) seen.insert(facet.polygon);
  CHECK(seen.size() == run.scene.polygons.size());
  for (const Facet& facet : run.scene.facets) {
    const std::span corners =
        std::span(run.scene.corners)
            .subspan(static_cast<std::size_t>(facet.first_corner), static_cast<std::size_t>(facet.corner_count));
    CHECK(scene::is_planar(run.scene.points, corners));
  }
}

TEST_CASE("changes: the order of polygons, and their colours") {
  Run run = run_of("pyramid");
  const std::size_t count = run.scene.polygons.size();
  std::string back;
  for (std::size_t at = count; at-- > 0;) back += *run.scene.polygons[at].name + " ";
  const Polygon last = run.scene.polygons.back();
  std::multiset<std::int32_t> corners(run.scene.corners.begin(), run.scene.corners.end());
  change("z-buffer", run, "polygons = " + back);
  CHECK(run.scene.polygons.front() == last);
  CHECK(std::multiset<std::int32_t>(run.scene.corners.begin(), run.scene.corners.end()) == corners);
  CHECK(std::is_sorted(run.scene.facets.begin(), run.scene.facets.end(),
                       [](const Facet& a, const Facet& b) { return a.polygon < b.polygon; }));
  change("z-buffer", run, "colour A = #102030");
  const auto a = std::find_if(run.scene.polygons.begin(), run.scene.polygons.end(),
                              [](const Polygon& polygon) { return *polygon.name == "A"; });
  CHECK(a->color == Color{0x10, 0x20, 0x30});
}

TEST_CASE("changes: of many vertices a thousand are listed, and all can be moved") {
  Run run = run_of("teapot:16");
  REQUIRE(run.scene.points.size() > 5000);
  const std::vector<Changeable> all = changeables(method("z-buffer"), run.scene, run.conventions);
  CHECK(all.size() < 1100);
  CHECK(can_change(method("z-buffer"), run.scene, run.conventions, "vertex 5000"));
  CHECK(can_change(method("z-buffer"), run.scene, run.conventions, "coverage"));
  CHECK_FALSE(can_change(method("bsp"), run.scene, run.conventions, "coverage"));
  change("z-buffer", run, "vertex 5000 = 1 2 3");
  CHECK(run.scene.points[5000] == glm::dvec3(1, 2, 3));
}

TEST_CASE("changes: what cannot be is one line, and nothing is changed") {
  Run run = run_of("pyramid");
  CHECK(has_part(refused("z-buffer", run, "thta = 3"), "there is no thta to change; there are rho, theta"));
  CHECK(has_part(refused("z-buffer", run, "theta = x"), "x is no number"));
  CHECK(has_part(refused("z-buffer", run, "theta = nan"), "nan is no number"));
  CHECK(has_part(refused("z-buffer", run, "rho = -1"), "it must be greater than 0"));
  CHECK(has_part(refused("z-buffer", run, "near = 1000"), "far"));
  CHECK(has_part(refused("z-buffer", run, "size = 40"), "width x height"));
  CHECK(has_part(refused("z-buffer", run, "size = 40x0"), "width x height"));
  CHECK(has_part(refused("z-buffer", run, "size = 4000000x1"), "no size of a raster"));
  CHECK(has_part(refused("z-buffer", run, "vertex 99 = 1 2 3"), "there is no vertex 99; there are 0 to"));
  CHECK(has_part(refused("z-buffer", run, "vertex -1 = 1 2 3"), "there is no vertex -1"));
  CHECK(has_part(refused("z-buffer", run, "vertex 0 = 1 2"), "three numbers"));
  CHECK(has_part(refused("z-buffer", run, "polygons = A"), "not all polygons"));
  CHECK(has_part(refused("z-buffer", run, "polygons = A A"), "A stands in it twice"));
  CHECK(has_part(refused("z-buffer", run, "colour A = red"), "red is no colour"));
  CHECK(has_part(refused("z-buffer", run, "colour Q = #000000"), "there is no polygon Q"));
  CHECK(has_part(refused("z-buffer", run, "coverage = all"), "give one of top-left, inclusive"));
  CHECK(has_part(refused("z-buffer", run, "cull = maybe"), "on or off"));
  CHECK(has_part(refused("bsp", run, "root = oak"), "root"));
  CHECK(has_part(refused("bsp", run, "coverage = inclusive"), "there is no coverage to change"));
  CHECK(has_part(refused("z-buffer", run, "theta"), "is not NAME = VALUE"));
  CHECK(has_part(refused("z-buffer", run, "= 3"), "is not NAME = VALUE"));
  Run surface = run_of("y = sin(x)");
  CHECK(has_part(refused("floating-horizon", surface, "vertex 0 = 1 2 3"), "follow from its formula"));
}
