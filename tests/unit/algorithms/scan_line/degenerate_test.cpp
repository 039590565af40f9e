// Input that is no picture of anything has a stated outcome, and never a crash.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "algorithms/scan_line/scan_line.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using test::screen_scene;

namespace {

using Polygons = std::vector<std::vector<glm::dvec3>>;
using Rejects = std::vector<Reject>;

const std::vector<std::map<std::string, std::string>> all_options{{},
                                                                  {{"resolve", "line-buffer"}},
                                                                  {{"coherence", "on"}},
                                                                  {{"antialias", "on"}},
                                                                  {{"antialias", "on"}, {"coherence", "on"}}};

struct Outcome {
  Rejects rejects;
  Picture picture;
  std::int64_t pixels = 0;
};

Outcome draw(const Scene& scene, const std::map<std::string, std::string>& options = {}) {
  CollectRecorder record;
  Conventions conventions;
  conventions.cull = false;
  conventions.options = options;
  Outcome outcome;
  outcome.picture = scan_line::run(scene, conventions, record);
  for (const PolygonReject& reject : record.all<PolygonReject>()) outcome.rejects.push_back(reject.reason);
  const std::vector<std::int32_t>& polygon = outcome.picture.polygon;
  outcome.pixels = static_cast<std::int64_t>(polygon.size()) - std::count(polygon.begin(), polygon.end(), no_polygon);
  return outcome;
}

void as_z_buffer(const Scene& scene) {
  NullRecorder nothing;
  Conventions conventions;
  conventions.cull = false;
  const Picture buffer = z_buffer::run(scene, conventions, nothing);
  for (const auto& options : all_options) CHECK(draw(scene, options).picture.polygon == buffer.polygon);
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();
const std::vector<glm::dvec3> square{{1, 1, 3}, {6, 1, 3}, {6, 6, 3}, {1, 6, 3}};

}  // namespace

TEST_SUITE("scan_line/degenerate") {
  TEST_CASE("none, one, and a raster without pixels") {
    for (const auto& options : all_options) {
      CHECK(draw(screen_scene(8, 8, {}), options).pixels == 0);
      CHECK(draw(screen_scene(8, 8, {square}), options).pixels == 25);
      CHECK(draw(screen_scene(0, 0, {square}), options).pixels == 0);
    }
  }

  TEST_CASE("duplicate: the one drawn first") { as_z_buffer(screen_scene(8, 8, {square, square, square})); }

  TEST_CASE("coplanar and overlapping: the one drawn first") {
    as_z_buffer(screen_scene(12, 9, {square, {{3, 3, 3}, {9, 3, 3}, {9, 8, 3}, {3, 8, 3}}}));
  }

  TEST_CASE("concave and self-intersecting: even-odd") {
    as_z_buffer(screen_scene(12, 12,
                             {{{1, 1, 2}, {10, 1, 2}, {10, 10, 2}, {5, 4, 2}, {1, 10, 2}},
                              {{0, 0, 5}, {11, 11, 5}, {11, 2, 5}, {0, 11, 5}}}));
    as_z_buffer(screen_scene(12, 12, {{{1, 1, 4}, {8, 8, 4}, {1, 8, 4}, {5, 1, 4}}}));
  }

  TEST_CASE("three that overlap in a circle") {
    Scene scene = screen_scene(24, 24,
                               {{{2, 2, 1}, {20, 4, 9}, {2, 6, 1}},
                                {{20, 2, 1}, {18, 20, 9}, {16, 2, 1}},
                                {{20, 20, 1}, {3, 3, 9}, {16, 21, 1}}});
    as_z_buffer(scene);
  }

  TEST_CASE("intersecting: the implied edge is where the Z-buffer has it") {
    as_z_buffer(
        screen_scene(20, 16, {{{1, 1, 0.1}, {18, 2, 7.7}, {9, 15, 3.3}}, {{2, 3, 6.1}, {19, 1, 0.2}, {10, 14, 4.4}}}));
  }

  TEST_CASE("zero area, edge-on, repeated corners, no number: dropped for a reason") {
    CHECK(draw(screen_scene(8, 8, {{{0, 0, 0}, {5, 5, 0}}})).rejects == Rejects{Reject::degenerate});
    CHECK(draw(screen_scene(8, 8, {{{3, 0, 0}, {3, 4, 0}, {3, 8, 0}}})).pixels == 0);
    CHECK(draw(screen_scene(8, 8, {{{3, 0, 0}, {3, 8, 0}, {3, 4, 5}}})).rejects == Rejects{Reject::edge_on});
    CHECK(draw(screen_scene(8, 8, {{{1, 1, 3}, {1, 1, 3}, {6, 1, 3}, {6, 6, 3}, {6, 6, 3}, {1, 6, 3}}})).pixels == 25);
    for (const double bad : {not_a_number, infinite, -infinite, 1e300}) {
      for (const auto& options : all_options) {
        const Outcome outcome = draw(screen_scene(8, 8, {{{0, 0, 0}, {5, 0, 0}, {bad, 5, 0}}, square}), options);
        CHECK(outcome.rejects == Rejects{Reject::degenerate});
        CHECK(outcome.pixels == 25);
      }
    }
    for (const auto& options : all_options) {
      CHECK(draw(screen_scene(8, 8, {{{0, 0, -1.7e308}, {8, 0, 1.7e308}, {8, 8, 1.7e308}}}), options).pixels >= 0);
      for (const double tiny : {1e-320, 1e-300, 1e-16}) {
        CHECK(draw(screen_scene(8, 8, {{{3 - tiny, 0, 0}, {3 + tiny, 0, 0}, {3, 8, 1}}, square}), options).pixels >=
              25);
      }
    }
  }

  TEST_CASE("not planar: the facets of one polygon") {
    Scene scene = screen_scene(10, 10, {});
    scene.points = {{1, 1, 0}, {8, 1, 4}, {8, 8, 0}, {1, 8, 4}};
    scene.polygons.push_back({"A", {}, 0});
    scene.corners = {0, 1, 2, 0, 2, 3};
    scene.facets = {{0, 0, 3}, {0, 3, 3}};
    as_z_buffer(scene);
    CHECK(draw(scene).pixels == 49);
  }

  TEST_CASE("larger than the raster, or beside it") {
    for (const auto& options : all_options) {
      CHECK(
          draw(screen_scene(8, 8, {{{-100, -100, 0}, {100, -100, 0}, {100, 100, 9}, {-100, 100, 9}}, square}), options)
              .pixels == 64);
      CHECK(draw(screen_scene(8, 8, {{{-1e8, -1e8, 0}, {1e8, -1e8, 0}, {1e8, 1e8, 0}, {-1e8, 1e8, 0}}}), options)
                .pixels == 64);
      CHECK(draw(screen_scene(8, 8, {{{20, 0, 0}, {30, 0, 0}, {25, 9, 0}}, {{-20, 0, 0}, {-30, 0, 0}, {-25, 9, 0}}}),
                 options)
                .pixels == 0);
      CHECK(draw(screen_scene(8, 8, {{{0, 20, 0}, {5, 30, 0}, {9, 25, 0}}, {{0, -20, 0}, {5, -30, 0}, {9, -25, 0}}}),
                 options)
                .pixels == 0);
    }
  }
}
