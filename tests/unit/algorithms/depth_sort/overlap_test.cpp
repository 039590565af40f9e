// Test 5: a point inside both projections, or none.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "algorithms/depth_sort/pair_tests.hpp"
#include "tests/unit/algorithms/scenes.hpp"

using namespace zstep;
using zstep::depth_sort::common_point;
using Ring = std::vector<glm::dvec3>;

namespace {

// Even-odd, by the crossings of a ray to the left; far from any edge only.
bool inside(const Ring& ring, glm::dvec2 point) {
  bool odd = false;
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
    const glm::dvec2 a(ring[last]), b(ring[i]);
    if ((a.y <= point.y) == (b.y <= point.y)) continue;
    if (a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y) < point.x) odd = !odd;
  }
  return odd;
}

bool overlap(const Ring& p, const Ring& q) {
  const auto one = common_point(p, q), other = common_point(q, p);
  CHECK(one.has_value() == other.has_value());
  for (const auto& point : {one, other}) {
    if (!point) continue;
    CHECK(inside(p, *point));
    CHECK(inside(q, *point));
  }
  return one.has_value();
}

const Ring square{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};

Ring moved(Ring ring, double x, double y) {
  for (glm::dvec3& corner : ring) corner += glm::dvec3(x, y, 0);
  return ring;
}

}  // namespace

TEST_SUITE("depth_sort/overlap") {
  TEST_CASE("squares: over each other, one in the other, the same, beside each other") {
    CHECK(overlap(square, moved(square, 3, 3)));
    CHECK(overlap(square, {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}}));
    CHECK(overlap(square, square));
    CHECK(overlap(square, Ring(square.rbegin(), square.rend())));
    CHECK_FALSE(overlap(square, moved(square, 5, 0)));
    CHECK_FALSE(overlap(square, moved(square, 0, -7)));
  }

  TEST_CASE("what touches along an edge or at a corner does not overlap, nor does what overlaps by less than 1e-6 px") {
    CHECK_FALSE(overlap(square, moved(square, 4, 0)));
    CHECK_FALSE(overlap(square, moved(square, 0, 4)));
    CHECK_FALSE(overlap(square, moved(square, 4, 1)));
    CHECK_FALSE(overlap(square, moved(square, 4, 4)));
    CHECK_FALSE(overlap({{0, 0, 0}, {5, 3, 0}, {0, 9, 0}}, {{0, 0, 0}, {5, 3, 0}, {7, -2, 0}}));
    CHECK_FALSE(overlap(square, moved(square, 4 - 1e-7, 0)));
    CHECK_FALSE(overlap(square, moved(square, 0, 4 - 1e-7)));
    CHECK(overlap(square, moved(square, 4 - 1e-4, 0)));
    CHECK(overlap(square, moved(square, 0, 4 - 1e-4)));
  }

  TEST_CASE("the extents overlap, the triangles do not") {
    CHECK_FALSE(overlap({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{12, 12, 0}, {12, 3, 0}, {3, 12, 0}}));
  }

  TEST_CASE("no corner of either lies in the other: a cross, and a star of two triangles") {
    CHECK(overlap({{-5, -1, 0}, {5, -1, 0}, {5, 1, 0}, {-5, 1, 0}}, {{-1, -5, 0}, {1, -5, 0}, {1, 5, 0}, {-1, 5, 0}}));
    CHECK(overlap({{-3, -2, 0}, {3, -2, 0}, {0, 4, 0}}, {{-3, 2, 0}, {3, 2, 0}, {0, -4, 0}}));
    CHECK(overlap({{0, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 4, 0}, {4, 0, 0}, {4, 4, 0}}));  // corners upon corners
  }

  TEST_CASE("concave: in the notch of a U is outside it, a bow tie's middle belongs to it by halves") {
    const Ring u{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {6, 9, 0}, {6, 3, 0}, {3, 3, 0}, {3, 9, 0}, {0, 9, 0}};
    CHECK_FALSE(overlap(u, {{4, 4, 0}, {5, 4, 0}, {5, 8, 0}}));
    CHECK_FALSE(overlap(u, {{3, 3, 0}, {6, 3, 0}, {6, 9, 0}, {3, 9, 0}}));  // fills the notch
    CHECK(overlap(u, {{4, 4, 0}, {5, 4, 0}, {4.5, 2, 0}}));
    const Ring bow_tie{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}};
    CHECK(overlap(bow_tie, {{0.5, 1, 0}, {0.5, 3, 0}, {1, 2, 0}}));
    CHECK_FALSE(overlap(bow_tie, {{1, 0, 0}, {3, 0, 0}, {2, 1.5, 0}}));
    const Ring ring_with_hole{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0},   // out …
                              {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}};  // … and round the hole
    CHECK_FALSE(overlap(ring_with_hole, {{3, 3, 0}, {6, 3, 0}, {6, 6, 0}}));
    CHECK(overlap(ring_with_hole, {{2.5, 4, 0}, {6, 4, 0}, {6, 5, 0}}));
  }

  TEST_CASE("no area, no overlap") {
    CHECK_FALSE(overlap({}, square));
    CHECK_FALSE(overlap({{1, 1, 0}, {3, 2, 0}}, square));
    CHECK_FALSE(overlap({{1, 1, 0}, {2, 2, 0}, {3, 3, 0}}, square));
  }

  TEST_CASE("random stars: as a fine raster of points says, where it says yes") {
    test::Numbers random(5);
    int overlapping = 0;
    for (int round = 0; round < 300; ++round) {
      const Ring p = test::random_star(random, random.in_box(4), 5, 3 + round % 9);
      const Ring q = test::random_star(random, random.in_box(4), 5, 3 + round % 7);
      int common = 0;
      for (int i = 0; i < 60 * 60; ++i) {
        const glm::dvec2 point((i % 60) * 0.3 - 9, (i / 60) * 0.3 - 9);
        if (inside(p, point) && inside(q, point)) ++common;
      }
      const bool found = overlap(p, q);  // every point that it finds is checked
      if (common > 0) CHECK(found);
      overlapping += found;
    }
    CHECK(overlapping > 100);
    CHECK(overlapping < 290);
  }
}
