// Mistakes that put every pixel elsewhere are known by moving all of them back.
#include "traces/mistakes/name.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <functional>
#include <utility>

#include "tests/golden/run_edits.hpp"

using namespace zstep;
using mistakes::Mistake;

namespace {

using At = std::pair<int, int>;

/// Compares of six pixels of a raster of 5x4, each where `moved` puts it, in the order in which they then come.
Trace run_of(const std::function<At(At)>& moved) {
  test::RunLines lines{
      R"({"ztrace":1,"writer":"my program","algorithm":"z-buffer","conventions":{"depth":"view","nearer":"smaller"},)"
      R"("steps":[{"id":1,"name":"polygon","event":"polygon_begin"},{"id":2,"name":"compare","event":"depth_compare"}],)"
      R"("scene":{"raster":{"width":5,"height":4},"camera":{"kind":"screen"},"points":[[0,0,5],[4,0,5],[0,3,5]],)"
      R"("polygons":[{"name":"A"}],"facets":[{"polygon":0,"points":[0,1,2]}]}})",
      R"({"step":"polygon","polygon":0,"facet":0})"};
  double z = 1;
  for (const At& at : {At{0, 0}, At{1, 0}, At{3, 0}, At{0, 1}, At{2, 1}, At{1, 2}}) {
    const auto [x, y] = moved(at);
    lines.push_back(fmt::format(R"({{"step":"compare","x":{},"y":{},"z":{},"nearer":true}})", x, y, z += 0.25));
  }
  return test::trace_of_lines(lines);
}

std::optional<Mistake> turned(const std::function<At(At)>& moved) {
  return mistakes::turned_of(run_of([](At at) { return at; }), run_of(moved), Precision{});
}

}  // namespace

TEST_CASE("mistakes: a picture that is upside down is known by its last row, one whose x and y are exchanged by both") {
  CHECK(turned([](At at) { return At{at.first, 3 - at.second}; }) == Mistake::y_upside_down);
  CHECK(turned([](At at) { return At{at.second, at.first}; }) == Mistake::x_y_exchanged);
  CHECK_FALSE(turned([](At at) { return At{at.first, 2 - at.second}; }));  // turned about another row
  CHECK_FALSE(turned([](At at) { return At{4 - at.first, at.second}; }));
}
