// Why a polygon is not what is seen, against brute force: pixels of small traces of every method, and every polygon.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tests/golden/golden.hpp"
#include "tests/laws/degenerate_checks.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "tests/unit/sim/answers/why_not_checks.hpp"

using namespace zstep;
using answers::Verdict, answers::Why, answers::why_not;

TEST_SUITE("why not") {
  TEST_CASE(
      "of pixels of every golden trace and every polygon: as brute force has it, by the step it names, and each kind "
      "occurs") {
    std::set<Why> kinds;
    test::for_each_golden([&](const std::string& name, const Trace& trace) {
      CAPTURE(name);
      kinds.merge(test::check_why_not(trace, 6, 5));
    });
    for (std::size_t k = 0; k < answers::why_count; ++k) {
      CAPTURE(k);
      const Why kind = static_cast<Why>(k);
      const bool of_none = kind == Why::not_recorded || kind == Why::contradicted ||
                           kind == Why::wiped;  // no method of ours clears twice
      if (!of_none) CHECK(kinds.contains(static_cast<Why>(k)));
    }
  }

  TEST_CASE(
      "of stars that cross each other, the near plane and the window, some of glass, by every method with every "
      "option") {
    Scene scene;
    test::Numbers random(5);
    for (int k = 0; k < 9; ++k) {
      const glm::dvec3 centre = random.in_box(1.6);
      test::add_polygon(scene, test::random_star(random, centre, 2.2, 5 + k % 3));
      if (k % 4 == 1) scene.polygons.back().material = Material{0.5};
    }
    test::add_polygon(scene, {{0, 0, 9}, {1, 0, 9}, {0, 1, 9}});  // behind the eye
    test::add_polygon(scene, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});  // no area
    scene.raster = {13, 9, false};
    scene.camera.window = 0.5;
    test::look(scene, Camera::Kind::perspective, 4, 30, 50, 2.6, 5.5);
    scene.light = Light{{3, -5, 4}, {0, 0, 0}, 1, 1, 20};
    for (const Method& m : methods()) {
      if (m.needs == Needs::surface) continue;
      CAPTURE(m.id);
      std::vector<Conventions> all(2);
      all[1].cull = false;
      for (const Option& option : m.options) {
        std::string words(option.words);
        for (std::size_t bar = 0; !words.empty(); words = bar == std::string::npos ? "" : words.substr(bar + 1)) {
          bar = words.find('|');
          Conventions conventions;
          conventions.cull = all.size() % 3 != 0;
          conventions.options[std::string(option.name)] = words.substr(0, bar);
          all.push_back(conventions);
        }
      }
      for (const Conventions& conventions : all) {
        CAPTURE(conventions.cull);
        std::string given;
        for (const auto& option : conventions.options) given += option.first + "=" + option.second + " ";
        CAPTURE(given);
        const Trace trace = test::recorded_by(std::string(m.id), scene, conventions);
        test::check_why_not(trace, 3, 3);
      }
    }
  }

  TEST_CASE("of degenerate input, by every method: no exception, and ties are ties") {
    for (const Method& m : methods()) {
      if (m.needs == Needs::surface) continue;
      CAPTURE(m.id);
      for (const test::Degenerate& input : test::degenerate_inputs()) {
        CAPTURE(input.name);
        Scene scene = test::degenerate_scene(input.polygons, test::perspective);
        scene.light = test::at_the_eye;
        test::check_why_not(test::recorded_by(std::string(m.id), scene, test::conventions_for(m)), 4, 4);
      }
    }
  }

  TEST_CASE("by areas, of a polygon of two facets: the piece over the pixel is asked, not its neighbour") {
    // Two facets of one polygon meet along a diagonal, which passes between centres; a triangle hides some of both.
    Scene scene =
        test::screen_scene(8, 8, {{{-1, -1, 5}, {8.3, -1, 5}, {-1, 8.3, 5}}, {{2, 1, 1}, {7, 2, 2}, {3, 7, 1}}});
    const auto first = static_cast<std::int32_t>(scene.points.size()),
               corner = static_cast<std::int32_t>(scene.corners.size());
    for (const glm::dvec3 point : {glm::dvec3(8.3, -1, 5), glm::dvec3(8.3, 8.3, 6), glm::dvec3(-1, 8.3, 5)})
      scene.points.push_back(point);
    for (std::int32_t k = 0; k < 3; ++k) scene.corners.push_back(first + k);
    scene.facets.insert(scene.facets.begin() + 1, Facet{0, corner, 3});
    const Trace trace = test::recorded_by("warnock", scene);
    test::check_why_not(trace, 8, 8);
    std::set<std::int32_t> facets;
    for (std::int32_t y = 0; y < 8; ++y)
      for (std::int32_t x = 0; x < 8; ++x)
        if (const Verdict verdict = why_not(trace, 0, {x, y});
            verdict.kind == Why::lost || verdict.kind == Why::surrounded) {
          CHECK(verdict.sentence.find(x + y < 7.3 ? "this is facet 0" : "this is facet 1") != std::string::npos);
          facets.insert(verdict.facet);
        }
    CHECK(facets.size() == 2);
  }
}
