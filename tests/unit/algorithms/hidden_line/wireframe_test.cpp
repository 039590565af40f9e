// Wireframes: all edges, cut at the raster, a pixel a column or row.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/hidden_line/line_runs.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;
using namespace zstep::hidden_line;
using namespace zstep::test;

TEST_SUITE("wireframe") {
  TEST_CASE("all edges, or none of which all faces face away") {
    const Scene cube = seen("cube");
    const Run all = wires(cube), front = wires(cube, "front");
    CHECK(all.pieces_of(true) == 12);
    CHECK(front.pieces_of(true) == 9);
    CHECK(front.pieces_of(false) == 3);
    // For one convex solid that is hidden-line removal already.
    CHECK(front.picture == hide(cube).picture);
    // For two it is not.
    const Scene behind = seen("pyramid-behind");
    CHECK(wires(behind, "front").picture != hide(behind).picture);
  }

  TEST_CASE("one pixel a column or row, the nearest to the line") {
    const Run run = wires(test::screen_scene(16, 16, {{{1, 1, 0}, {9, 5, 0}, {1, 9, 0}}}));
    std::vector<std::pair<int, int>> first;
    for (const ColorWrite& pixel : run.record.all<ColorWrite>()) first.emplace_back(pixel.x, pixel.y);
    const std::vector<std::pair<int, int>> along{{1, 1}, {2, 2}, {3, 2}, {4, 3}, {5, 3},
                                                 {6, 4}, {7, 4}, {8, 5}, {9, 5}};
    first.resize(along.size());
    std::sort(first.begin(), first.end());
    CHECK(first == along);
  }

  TEST_CASE("lines are cut at the raster's border") {
    const Run run = wires(test::screen_scene(8, 8, {{{-5, 3, 0}, {20, 3, 0}, {20, 30, 0}, {-5, 30, 0}}}));
    CHECK(run.inked() == 8);
  }
}
