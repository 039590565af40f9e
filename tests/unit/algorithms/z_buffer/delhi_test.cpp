// The worked example of 004 (Kalra, IIT Delhi, lecture 28): two polygons on an 8x8 raster, both depth buffers to the
// digit.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

const std::vector<glm::dvec3> first{{0, 7, 5}, {6, 7, 5}, {0, 1, 5}};
const std::vector<glm::dvec3> second{{0, 6, 7}, {5, 1, 7}, {0, 1, 2}};

Picture draw(const std::vector<std::vector<glm::dvec3>>& polygons, Conventions::Interpolation interpolation,
             CollectRecorder& record) {
  Conventions conventions;
  conventions.coverage = Conventions::Coverage::inclusive;
  conventions.interpolation = interpolation;
  return z_buffer::run(test::screen_scene(8, 8, polygons), conventions, record);
}

constexpr double oo = no_depth;

}  // namespace

TEST_SUITE("z_buffer/delhi") {
  TEST_CASE("the depth buffer after the first and after the second polygon") {
    for (const auto interpolation : {Conventions::Interpolation::direct, Conventions::Interpolation::increments}) {
      CollectRecorder record;
      // Rows from y = 0; the lecture draws y upwards.
      CHECK(draw({first}, interpolation, record).depth == std::vector<double>{oo, oo, oo, oo, oo, oo, oo, oo,  //
                                                                              5,  oo, oo, oo, oo, oo, oo, oo,  //
                                                                              5,  5,  oo, oo, oo, oo, oo, oo,  //
                                                                              5,  5,  5,  oo, oo, oo, oo, oo,  //
                                                                              5,  5,  5,  5,  oo, oo, oo, oo,  //
                                                                              5,  5,  5,  5,  5,  oo, oo, oo,  //
                                                                              5,  5,  5,  5,  5,  5,  oo, oo,  //
                                                                              5,  5,  5,  5,  5,  5,  5,  oo});
      CHECK(draw({first, second}, interpolation, record).depth ==
            std::vector<double>{oo, oo, oo, oo, oo, oo, oo, oo,  //
                                2,  3,  4,  5,  6,  7,  oo, oo,  //
                                3,  4,  5,  6,  7,  oo, oo, oo,  //
                                4,  5,  5,  7,  oo, oo, oo, oo,  //
                                5,  5,  5,  5,  oo, oo, oo, oo,  //
                                5,  5,  5,  5,  5,  oo, oo, oo,  //
                                5,  5,  5,  5,  5,  5,  oo, oo,  //
                                5,  5,  5,  5,  5,  5,  5,  oo});
    }
  }

  TEST_CASE("two ties, and both keep the polygon drawn first") {
    CollectRecorder record;
    const Picture picture = draw({first, second}, Conventions::Interpolation::direct, record);
    std::vector<std::pair<std::int32_t, std::int32_t>> ties;
    std::vector<double> depth(64, no_depth);
    for (const CollectedEvent& collected : record.events) {
      if (const auto* compare = get_if<DepthCompare>(&collected.event)) {
        const double stored = depth[picture.at(compare->x, compare->y)];
        CHECK(compare->nearer == (compare->z < stored));
        if (compare->z == stored) ties.push_back({compare->x, compare->y});
      }
      if (const auto* write = get_if<DepthWrite>(&collected.event)) depth[picture.at(write->x, write->y)] = write->z;
    }
    CHECK(ties == std::vector<std::pair<std::int32_t, std::int32_t>>{{1, 3}, {0, 4}});
    CHECK(picture.polygon[picture.at(1, 3)] == 0);
    CHECK(picture.polygon[picture.at(0, 4)] == 0);
    CHECK(picture.polygon[picture.at(0, 3)] == 1);
    CHECK(depth == picture.depth);
  }

  TEST_CASE("z = x + y + 1 on the second polygon") {
    CollectRecorder record;
    const Picture picture = draw({second}, Conventions::Interpolation::direct, record);
    int drawn = 0;
    for (std::int32_t y = 0; y < 8; ++y) {
      for (std::int32_t x = 0; x < 8; ++x) {
        if (picture.polygon[picture.at(x, y)] == no_polygon) continue;
        CHECK(picture.depth[picture.at(x, y)] == x + y + 1);
        ++drawn;
      }
    }
    CHECK(drawn == 6 + 5 + 4 + 3 + 2 + 1);
  }
}
