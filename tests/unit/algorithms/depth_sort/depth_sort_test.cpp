// Depth sort: each of its tests, the exchange and the split.
#include <doctest/doctest.h>

#include "algorithms/scene/load.hpp"
#include "tests/unit/algorithms/depth_sort/sorted.hpp"

using namespace zstep;
using namespace zstep::test;
namespace step = zstep::depth_sort::step;

namespace {

// The last of the five tests that was made, 1 to 5.
int deciding_test(const Sorted& sorted) {
  for (int test = 5; test >= 1; --test) {
    if (sorted.count(static_cast<std::uint8_t>(step::id::test_1 + test - 1)) > 0) return test;
  }
  return 0;
}

}  // namespace

TEST_SUITE("depth_sort") {
  TEST_CASE("z extents apart: none of the five tests is made") {
    const Sorted sorted = sort_pair(square(2, 2, 6, 8), square(4, 4, 6, 3));
    CHECK(sorted.order() == Order{0, 1});
    CHECK(deciding_test(sorted) == 0);
    const ExtentTest z = sorted.only(step::z_extents);
    CHECK(z.axis == Axis::z);
    CHECK(z.low == 8);
    CHECK(z.other_high == 3);
    CHECK_FALSE(z.overlap);
    CHECK(sorted.wrong == 0);
  }

  TEST_CASE("tests 1 and 2: x extents, y extents") {
    const Sorted first = sort_pair(slope(1, 5, 1, 5, 2, 9), slope(8, 12, 1, 5, 3, 7));
    CHECK(deciding_test(first) == 1);
    const ExtentTest x = first.only(step::test_1);
    CHECK(x.low == 1);
    CHECK(x.high == 5);
    CHECK(x.other_low == 8);
    CHECK(x.other_high == 12);
    CHECK_FALSE(x.overlap);
    CHECK(first.order() == Order{0, 1});

    const Sorted second = sort_pair(slope(1, 9, 1, 5, 2, 9), slope(3, 12, 8, 12, 3, 7));
    CHECK(deciding_test(second) == 2);
    CHECK(second.only(step::test_1).overlap);
    CHECK_FALSE(second.only(step::test_2).overlap);

    CHECK(deciding_test(sort_pair(slope(1, 5, 1, 5, 2, 9), slope(5, 9, 1, 5, 3, 7))) == 1);  // a touch is no overlap
  }

  TEST_CASE("test 3: P wholly behind the plane of Q") {
    const Sorted sorted = sort_pair(slope(1, 9, 1, 9, 5, 13), slope(3, 11, 3, 11, 4, 12));  // planes 3 apart in z
    CHECK(deciding_test(sorted) == 3);
    const SideTest side = sorted.only(step::test_3);
    CHECK(side.piece == 0);
    CHECK(side.plane_of == 1);
    CHECK(side.side == Side::behind);
    CHECK(side.least == doctest::Approx(3 / std::sqrt(2)));
    CHECK(side.greatest == doctest::Approx(3 / std::sqrt(2)));
    CHECK(sorted.order() == Order{0, 1});
    CHECK(sorted.wrong == 0);
  }

  TEST_CASE("test 4: Q wholly before the plane of P, though P crosses that of Q") {
    const Sorted sorted = sort_pair(slope(0, 14, 1, 9, 0, 14), slope(8, 12, 2, 8, 7, 5));
    CHECK(deciding_test(sorted) == 4);
    CHECK(sorted.only(step::test_3).side == Side::crossing);
    CHECK(sorted.only(step::test_4).side == Side::front);
    CHECK(sorted.wrong == 0);
  }

  TEST_CASE("test 5: extents overlap, planes cross, projections are apart") {
    const Sorted sorted = sort_pair({{0, 0, 0}, {10, 0, 10}, {0, 10, 0}}, {{12, 12, 5}, {12, 3, 0.5}, {3, 12, 9.5}});
    CHECK(deciding_test(sorted) == 5);
    CHECK_FALSE(sorted.only(step::test_5).overlap);
    CHECK(std::isnan(sorted.only(step::test_5).x_at));
    CHECK(sorted.order() == Order{0, 1});
  }

  TEST_CASE("test 3 with P and Q exchanged: a long polygon slants past a small one") {
    const Sorted sorted = sort(slanting_past());
    CHECK(sorted.only(step::test_3_swapped).side == Side::behind);
    CHECK(sorted.count(step::test_4_swapped.id) == 0);
    CHECK(sorted.only(step::move).piece == 1);
    CHECK(sorted.only(step::mark).piece == 1);
    CHECK(sorted.order() == Order{1, 0});
    CHECK(sorted.wrong == 0);
    const OverlapTest overlap = sorted.record.all<OverlapTest>().front();
    CHECK(overlap.x_at > 1.5);
    CHECK(overlap.x_at < 4.5);
  }

  TEST_CASE("test 4 with P and Q exchanged") {
    const Sorted sorted = sort_pair(slope(10, 14, 2, 8, 9, 12.5), slope(0, 11, 1, 9, 0, 11));
    CHECK(sorted.only(step::test_3_swapped).side == Side::crossing);
    CHECK(sorted.only(step::test_4_swapped).side == Side::front);
    CHECK(sorted.order() == Order{1, 0});
    CHECK(sorted.wrong == 0);
  }

  TEST_CASE("a moved polygon is still held against those that lie wholly behind it in z") {
    // 1 has to come before 0, which slants past it, and 2 before 1, though 2 is not within reach of 1's z extent.
    const Sorted sorted =
        sort(screen_scene(24, 16, {slope(0, 20, 1, 14, 0, 20), square(2, 4, 4, 8), slope(3, 5, 3, 9, 12, 18)}));
    CHECK(sorted.order() == Order{2, 1, 0});
    CHECK(sorted.wrong == 0);
  }

  TEST_CASE("two polygons that intersect: one split, and each half in its place") {
    const Sorted sorted = sort_pair(slope(1, 13, 1, 9, 2, 10), slope(1, 13, 3, 11, 9, 1));
    CHECK(sorted.only(step::split).piece == 0);
    CHECK(sorted.only(step::split).side == Side::crossing);
    CHECK(sorted.order() == Order{0, 1, 0});
    CHECK(sorted.count(step::remove.id) == 1);
    CHECK(sorted.count(step::insert_part.id) == 2);
    CHECK(sorted.wrong == 0);
    CHECK(sort(look_at_scene(load_scene("intersecting").scene, {})).wrong == 0);
  }

  TEST_CASE("three triangles in a ring: a split, no hang") {
    const Sorted sorted = sort(look_at_scene(load_scene("cyclic").scene, {}));
    CHECK(sorted.count(step::split.id) >= 1);
    CHECK(sorted.order().size() == 3 + static_cast<std::size_t>(sorted.count(step::split.id)));
    CHECK(sorted.wrong == 0);
  }
}
