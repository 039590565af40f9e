// How often rounding turns what the methods decide, on scenes made for it (docs/exactness.md).
#include "tests/laws/decisions/decisions.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/laws/near_degenerate.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"

using namespace zstep;
using oracle::Decided, oracle::Decisions, oracle::Predicate;

namespace {

constexpr auto predicates = static_cast<std::size_t>(Predicate::count);

Conventions conventions_of(const std::string& method, const Scene& scene) {
  Conventions conventions;
  conventions.cull = scene.camera.kind != Camera::Kind::screen && method != "hidden-line";
  if (method == "ray-casting") conventions.options["boxes"] = "hierarchy";
  return conventions;
}
Decisions decisions_in(const std::string& method, const Scene& scene) {
  return oracle::decisions_of(test::recorded_by(method, scene, conventions_of(method, scene)));
}

/// A scene that shows a wrong decision, and the method that makes it.
struct Example {
  std::string method;
  Scene scene;
  std::size_t vertices() const { return scene.corners.size(); }
};

/// With fewer polygons, and numbers of fewer digits, as long as the decision is wrong.
Example smaller(Example example, Predicate which) {
  const auto still = [&](const Scene& scene) { return decisions_in(example.method, scene)[which].wrong > 0; };
  const auto polygons_of = [](const Scene& scene) {
    std::vector<std::vector<glm::dvec3>> polygons(scene.facets.size());
    for (std::size_t i = 0; i < polygons.size(); ++i)
      for (std::int32_t k = 0; k < scene.facets[i].corner_count; ++k)
        polygons[i].push_back(scene.points[static_cast<std::size_t>(
            scene.corners[static_cast<std::size_t>(scene.facets[i].first_corner + k)])]);
    return polygons;
  };
  const auto scene_of = [&](const std::vector<std::vector<glm::dvec3>>& polygons) {
    Scene scene = test::screen_scene(example.scene.raster.width, example.scene.raster.height, polygons);
    scene.camera = example.scene.camera;
    return scene;
  };
  auto polygons = polygons_of(example.scene);
  for (std::size_t i = 0; i < polygons.size();) {
    auto fewer = polygons;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    if (!fewer.empty() && still(scene_of(fewer))) polygons = fewer;
    else ++i;
  }
  for (auto& polygon : polygons)
    for (glm::dvec3& corner : polygon)
      for (int axis = 0; axis < 3; ++axis) {
        const double before = corner[axis];
        for (const double digits : {1.0, 4.0, 64.0}) {
          corner[axis] = std::round(before * digits) / digits;
          if (still(scene_of(polygons))) break;
          corner[axis] = before;
        }
      }
  example.scene = scene_of(polygons);
  return example;
}

TEST_CASE("decisions: what rounding turns is within the bound of its rounding, on scenes made for it") {
  // ZSTEP_DECISIONS=9000 makes the table of docs/exactness.md.
  const char* asked = std::getenv("ZSTEP_DECISIONS");
  const std::uint64_t scenes = asked ? std::strtoull(asked, nullptr, 10) : 90;
  Decisions all;
  std::array<std::optional<Example>, predicates> examples;
  for (std::uint64_t number = 0; number < scenes; ++number) {
    const test::NearDegenerate made = test::near_degenerate(number);
    for (const std::string& method : made.methods) {
      CAPTURE(number);
      CAPTURE(method);
      const Decisions here = decisions_in(method, made.scene);
      all.add(here);
      for (std::size_t i = 0; i < predicates; ++i) {
        CAPTURE(oracle::text_of(static_cast<Predicate>(i)).name);
        CAPTURE(here.of[i].first_wrong);
        CHECK(here.of[i].worst <= 1);
        if (here.of[i].wrong > 0 && !made.scene.surface &&
            (!examples[i] || made.scene.corners.size() < examples[i]->vertices()))
          examples[i] = Example{method, made.scene};
      }
    }
  }
  fmt::print("{:<36} {:>10} {:>10} {:>8} {:>10} {:>6}\n", "predicate", "decisions", "left open", "wrong", "share",
             "bound");
  for (std::size_t i = 0; i < predicates; ++i) {
    const Decided& of = all.of[i];
    CAPTURE(oracle::text_of(static_cast<Predicate>(i)).name);
    CHECK(of.decisions > 0);  // each is asked
    fmt::print("{:<36} {:>10} {:>10} {:>8} {:>10} {:>6.2f}\n", oracle::text_of(static_cast<Predicate>(i)).name,
               of.decisions, of.left_open, of.wrong,
               of.wrong == 0
                   ? "0"
                   : fmt::format("{:.2g} %", 100 * static_cast<double>(of.wrong) / static_cast<double>(of.decisions)),
               of.worst);
  }
  if (!asked) return;
  for (std::size_t i = 0; i < predicates; ++i) {
    if (!examples[i]) continue;
    const auto which = static_cast<Predicate>(i);
    const Example least = smaller(*examples[i], which);
    fmt::print("\n# {}: {}, step {}\n{}", oracle::text_of(which).name, least.method,
               decisions_in(least.method, least.scene)[which].first_wrong, test::scene_file_of(least.scene));
  }
}

TEST_CASE("decisions: in the built-in scenes none is wrong") {
  for (const char* name : {"pyramid-behind", "cube", "intersecting", "dodecahedron"}) {
    ViewOptions view;
    view.width = 32, view.height = 24;
    const Scene scene = look_at_scene(load_scene(name).scene, view);
    for (const Method& m : methods()) {
      if (m.needs != Needs::polygons || m.id == "transparency" || m.id == "ray-tracing") continue;
      CAPTURE(name);
      CAPTURE(m.id);
      const Decisions decided = decisions_in(std::string(m.id), scene);
      for (std::size_t i = 0; i < predicates; ++i) {
        CAPTURE(oracle::text_of(static_cast<Predicate>(i)).name);
        CAPTURE(decided.of[i].first_wrong);
        CHECK(decided.of[i].wrong == 0);
      }
    }
  }
}

TEST_CASE("decisions: one that rounding cannot have made is beyond its bound") {
  const Scene scene = test::screen_scene(8, 8, {{{0.5, 0.5, 1}, {6.5, 0.5, 1}, {0.5, 6.5, 1}}});
  const Trace right = test::recorded_by("z-buffer", scene);
  CHECK(oracle::decisions_of(right)[Predicate::span_end].decisions == 12);
  CHECK(oracle::decisions_of(right).wrong() == 0);
  bool done = false;
  const Trace wrong = test::changed(right, [&](std::int64_t, Event& event) {
    auto* span = get_if<SpanBegin>(&event);
    if (span && !done) done = true, ++span->first;
    return true;
  });
  const Decided found = oracle::decisions_of(wrong)[Predicate::span_end];
  CHECK(found.wrong == 1);
  CHECK(found.worst > 1e6);
  CHECK(holds<SpanBegin>(wrong.event(found.first_wrong).event));
}

}  // namespace
