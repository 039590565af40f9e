// Half-space: one triangle computed by hand, which pixels belong to whom, and what its options leave as it is.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/half_space/half_space.hpp"
#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/error.hpp"

using namespace zstep;

namespace {

using Options = std::vector<std::pair<const char*, const char*>>;

Conventions with_options(const Options& options) {
  Conventions conventions;
  for (const auto& [name, value] : options) conventions.options[name] = value;
  return conventions;
}

const std::vector<Options>& all_options() {
  static const std::vector<Options> all{{},
                                        {{"stepping", "increments"}},
                                        {{"tiles", "8"}},
                                        {{"hierarchical-z", "on"}},
                                        {{"tiles", "8"}, {"hierarchical-z", "on"}, {"stepping", "increments"}}};
  return all;
}

std::string text_of(const Options& options) {
  std::string text;
  for (const auto& [name, value] : options) text += std::string(name) + "=" + value + " ";
  return text;
}

CollectRecorder events_of(const Scene& scene, const Options& options = {}) {
  CollectRecorder record;
  half_space::run(scene, with_options(options), record);
  return record;
}

Picture picture_of(const Scene& scene, const Options& options = {}) {
  NullRecorder nothing;
  return half_space::run(scene, with_options(options), nothing);
}

/// How often each pixel of the raster is compared.
std::vector<int> compares(const Scene& scene, const Options& options = {}) {
  std::vector<int> count(static_cast<std::size_t>(scene.raster.width * scene.raster.height), 0);
  for (const DepthCompare& e : events_of(scene, options).all<DepthCompare>())
    ++count[static_cast<std::size_t>(e.y * scene.raster.width + e.x)];
  return count;
}

Scene one_triangle() { return test::screen_scene(9, 8, {{{1, 1, 2}, {7, 2, 4}, {3, 6, 8}}}); }

/// Triangles round a point, their outer ends on the border of a square that holds the whole raster.
Scene round_a_point(glm::dvec3 middle, double off) {
  const std::vector<glm::dvec3> ring{{-1, -1, 1}, {3.3 + off, -1, 2}, {9, -1, 3},         {9, 2.7 - off, 4}, {9, 9, 5},
                                     {5.1, 9, 6}, {-1, 9, 7},         {-1, 6.6 + off, 8}, {-1, 1.9 - off, 9}};
  Scene scene = test::screen_scene(8, 8, {});
  scene.points = ring;
  scene.points.push_back(middle);
  const auto n = static_cast<std::int32_t>(ring.size());
  for (std::int32_t i = 0; i < n; ++i) {
    // One way round and the other.
    if (i % 2 == 0) test::add_polygon(scene, {n, i, (i + 1) % n});
    else test::add_polygon(scene, {(i + 1) % n, i, n});
  }
  return scene;
}

/// A grid of points moved about at random, on multiples of `snap`, its cells cut into triangles.
Scene random_grid(test::Numbers& random, double snap) {
  Scene scene = test::screen_scene(20, 20, {});
  constexpr int cells = 5;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      double x = -2 + 4.6 * column, y = -2 + 4.6 * row;
      if (row > 0 && row < cells) y += random.between(-1.3, 1.3);
      if (column > 0 && column < cells) x += random.between(-1.3, 1.3);
      scene.points.push_back({std::round(x / snap) * snap, std::round(y / snap) * snap, random.between(0, 1)});
    }
  for (std::int32_t row = 0; row < cells; ++row)
    for (std::int32_t column = 0; column < cells; ++column) {
      const std::int32_t a = row * (cells + 1) + column, b = a + 1, c = a + cells + 1, d = c + 1;
      if (random.engine() % 2 == 0) test::add_polygon(scene, {a, b, d}), test::add_polygon(scene, {a, d, c});
      else test::add_polygon(scene, {b, a, c}), test::add_polygon(scene, {c, b, d});
    }
  return scene;
}

}  // namespace

TEST_SUITE("half_space") {
  TEST_CASE("one triangle by hand: area, box, edge functions, weights and depth") {
    const CollectRecorder events = events_of(one_triangle());
    const auto setups = events.all<TriangleSetup>();
    REQUIRE(setups.size() == 1);
    CHECK(setups[0].twice_area == 28);  // 6*5 - 2*1
    CHECK(setups[0].first_column == 1);
    CHECK(setups[0].end_column == 8);
    CHECK(setups[0].first_row == 1);
    CHECK(setups[0].end_row == 7);

    const auto edges = events.all<EdgeFunction>();
    REQUIRE(edges.size() == 3);
    const struct {
      std::int32_t from, to;
      double a, b, c;
      bool owns;
    } expected[] = {{1, 2, -4, -4, 36, false}, {2, 0, 5, -2, -3, true}, {0, 1, -1, 6, -5, false}};
    for (std::size_t i = 0; i < 3; ++i) {
      CAPTURE(i);
      CHECK(edges[i].edge_function == static_cast<std::int32_t>(i));
      CHECK(edges[i].vertex_0 == expected[i].from);
      CHECK(edges[i].vertex_1 == expected[i].to);
      CHECK(edges[i].edge_a == expected[i].a);
      CHECK(edges[i].edge_b == expected[i].b);
      CHECK(edges[i].edge_c == expected[i].c);
      CHECK(edges[i].owns == expected[i].owns);
    }

    const auto tests = events.all<InsideTest>();
    CHECK(tests.size() == 7 * 6);
    for (const InsideTest& test : tests) {
      CHECK(test.e_0 == -4 * test.x - 4 * test.y + 36);
      CHECK(test.e_1 == 5 * test.x - 2 * test.y - 3);
      CHECK(test.e_2 == -test.x + 6 * test.y - 5);
      CHECK(test.e_0 + test.e_1 + test.e_2 == 28);
      if (test.x == 1 && test.y == 1) CHECK_FALSE(test.inside);  // on e1, which it owns, and e2, which it does not
      if (test.x == 3 && test.y == 6) CHECK_FALSE(test.inside);
      if (test.x == 2 && test.y == 2) CHECK(test.inside);
    }
    const auto weights = events.all<BarycentricWeights>();
    const auto depths = events.all<DepthInterpolate>();
    REQUIRE(weights.size() == depths.size());
    bool found = false;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i].x != 3 || weights[i].y != 3) continue;
      found = true;
      CHECK(weights[i].w_0 == 12.0 / 28);
      CHECK(weights[i].w_1 == 6.0 / 28);
      CHECK(weights[i].w_2 == 10.0 / 28);
      CHECK(depths[i].z == doctest::Approx(32.0 / 7).epsilon(1e-15));
    }
    CHECK(found);
  }

  TEST_CASE("a triangle given the other way round is turned, and covers the same pixels") {
    const Scene scene = one_triangle(), turned = test::screen_scene(9, 8, {{{1, 1, 2}, {3, 6, 8}, {7, 2, 4}}});
    CHECK(events_of(turned).all<TriangleSetup>()[0].twice_area == 28);
    CHECK(picture_of(turned).polygon == picture_of(scene).polygon);
  }

  TEST_CASE("a triangle without area is set up, and no pixel of it is tested") {
    const CollectRecorder events = events_of(test::screen_scene(8, 8, {{{1, 1, 0}, {3, 3, 0}, {6, 6, 0}}}));
    CHECK(events.all<TriangleSetup>().size() == 1);
    CHECK(events.all<EdgeFunction>().empty());
    CHECK(events.all<InsideTest>().empty());
  }

  TEST_CASE("watertight: of triangles round a vertex on a pixel's centre exactly one has each pixel") {
    for (const glm::dvec3 middle :
         {glm::dvec3(4, 4, 0), glm::dvec3(3, 5, 0), glm::dvec3(0, 7, 0), glm::dvec3(4.3, 4, 0)})
      for (const double off : {0.0, 0.1, 1.0 / 3})
        for (const Options& options : {all_options()[0], all_options()[2]}) {
          CAPTURE(middle.x);
          CAPTURE(off);
          CAPTURE(text_of(options));
          CHECK(compares(round_a_point(middle, off), options) == std::vector<int>(64, 1));
        }
  }

  TEST_CASE("watertight: where triangles share edges each pixel is compared once, also when E is stepped") {
    test::Numbers random(88);
    for (int round = 0; round < 60; ++round)
      for (const double snap : {0.25, 0.1, 1e-9}) {
        const Scene scene = random_grid(random, snap);
        for (const Options& options : {all_options()[0], all_options()[1], all_options()[2]}) {
          // Stepped, E is exactly 0 at a vertex only where it is without rounding.
          if (snap == 0.1 && !options.empty() && std::string(options[0].first) == "stepping") continue;
          CAPTURE(round);
          CAPTURE(snap);
          CAPTURE(text_of(options));
          CHECK(compares(scene, options) == std::vector<int>(400, 1));
        }
      }
  }

  TEST_CASE("concave outlines and outlines that cross themselves cover what the Z-buffer covers") {
    const std::vector<std::vector<glm::dvec3>> outlines{
        {{1, 1, 3}, {13, 1, 3}, {13, 13, 3}, {9, 13, 3}, {9, 5, 3}, {5, 5, 3}, {5, 13, 3}, {1, 13, 3}},  // a U
        {{7, 0.5, 1}, {11, 13, 1}, {0.5, 5, 1}, {13.5, 5, 1}, {3, 13, 1}},                               // a star
        {{1, 1, 2}, {13, 11, 2}, {13, 1, 2}, {1, 11, 2}},                                                // a bow tie
        {{1, 2, 1}, {8, 2, 1}, {8, 9, 1}, {12, 9, 1}, {12, 5, 1}, {1, 5, 1}},                            // two boxes
        {{1, 1, 1},
         {13, 1, 1},
         {13, 13, 1},
         {1, 13, 1},
         {1, 1, 1},
         {4, 4, 1},
         {4, 9, 1},
         {9, 9, 1},
         {4, 4, 1}}};  // a hole
    NullRecorder nothing;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      const Scene scene = test::screen_scene(15, 15, {outlines[i]});
      const Picture expected = z_buffer::run(scene, {}, nothing);
      for (const Options& options : all_options()) {
        CAPTURE(i);
        CAPTURE(text_of(options));
        CHECK(picture_of(scene, options).polygon == expected.polygon);
        for (const int count : compares(scene, options)) CHECK(count <= 1);
      }
    }
  }

  TEST_CASE("tiles and farthest depths leave the picture as it is, to the bit, and save tests") {
    // A wall, behind it two triangles, and one that passes through it.
    const Scene scene = test::screen_scene(40, 32,
                                           {{{0, 0, 2}, {36, 0, 2}, {36, 30, 3}, {0, 30, 3}},
                                            {{1, 1, 8}, {30, 3, 7}, {5, 28, 9}},
                                            {{38, 2, 5}, {39, 30, 5}, {20, 29, 6}},
                                            {{2, 20, 1}, {38, 4, 6}, {30, 31, 4}}});
    const Picture plain = picture_of(scene);
    for (const Options& options : all_options()) {
      CAPTURE(text_of(options));
      CHECK(picture_of(scene, options) == plain);
    }
    const CollectRecorder by_pixel = events_of(scene), by_tile = events_of(scene, {{"tiles", "8"}}),
                          by_depth = events_of(scene, {{"hierarchical-z", "on"}});
    int covers[3] = {0, 0, 0};
    for (const TileTest& tile : by_tile.all<TileTest>()) ++covers[static_cast<int>(tile.cover)];
    for (const int count : covers) CHECK(count > 0);
    CHECK(by_tile.all<InsideTest>().size() < by_pixel.all<InsideTest>().size());
    CHECK(by_tile.all<DepthCompare>().size() == by_pixel.all<DepthCompare>().size());
    int rejected = 0;
    for (const TileDepthTest& tile : by_depth.all<TileDepthTest>()) rejected += !tile.nearer;
    CHECK(rejected > 3);
    CHECK(by_depth.all<DepthCompare>().size() < by_pixel.all<DepthCompare>().size());
  }

  TEST_CASE("in float32 each weight is a float32 number, and the picture that of float64 but for rounding") {
    const Scene scene = test::screen_scene(9, 8, {{{1.1, 1.3, 2}, {7.7, 2.2, 4}, {3.4, 6.6, 8}}});
    Conventions conventions;
    conventions.number_format = NumberFormat::float32;
    CollectRecorder record;
    const Picture narrow = half_space::run(scene, conventions, record), wide = picture_of(scene);
    CHECK(narrow.polygon == wide.polygon);
    REQUIRE(!record.all<BarycentricWeights>().empty());
    for (const BarycentricWeights& e : record.all<BarycentricWeights>())
      for (const double w : {e.w_0, e.w_1, e.w_2}) CHECK(w == static_cast<double>(static_cast<float>(w)));
    CHECK(narrow.depth != wide.depth);
  }

  TEST_CASE("what it cannot do is refused by its name") {
    const Method& method = zstep::method("half-space");
    const Scene scene = one_triangle();
    const auto refused = [&](auto&& change) {
      Conventions conventions;
      change(conventions);
      return !can_draw(method, scene, conventions);
    };
    using Coverage = Conventions::Coverage;
    for (const Coverage coverage : {Coverage::inclusive, Coverage::round, Coverage::ceil_floor})
      CHECK(refused([&](Conventions& c) { c.coverage = coverage; }));
    CHECK(refused([](Conventions& c) { c.number_format = NumberFormat::fixed16; }));
    CHECK(refused([](Conventions& c) { c.interpolation = Conventions::Interpolation::increments; }));
    CHECK(refused([](Conventions& c) { c.options["tiles"] = "16"; }));
    CHECK_FALSE(refused([](Conventions& c) { c.number_format = NumberFormat::float32; }));
    CHECK_FALSE(refused([](Conventions& c) { c.options["tiles"] = "8"; }));
    Conventions other;
    other.coverage = Coverage::inclusive;
    CHECK(conventions_for(method, other).coverage == Coverage::top_left);
    other.coverage = Coverage::top_left, other.number_format = NumberFormat::float32;
    CHECK(conventions_for(method, other).number_format == NumberFormat::float32);
  }
}
