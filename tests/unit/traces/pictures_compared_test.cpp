// Depths of two pictures, pixel by pixel: what is drawn, what is equal, how far apart the rest is.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "traces/diff/buffers.hpp"

using namespace zstep;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double no_number = std::nan("");

diff::BufferDifference compared(const std::vector<double>& a, const std::vector<double>& b, double absolute = 0) {
  Precision precision;
  precision.absolute = absolute, precision.relative = 0;
  return diff::compare_depths(a, b, precision);
}

}  // namespace

TEST_CASE("pictures: what one run alone has drawn is counted for that one") {
  const diff::BufferDifference found = compared({1, 2, infinity, infinity, 5}, {1, infinity, 3, 4, 5});
  CHECK(found.depths == 3);
  CHECK(found.only_a == 1);
  CHECK(found.only_b == 2);
  CHECK(found.farthest == 0);
  CHECK(found.first == 1);
}

TEST_CASE("pictures: what stands at more than half of the pixels without a polygon is the file's background") {
  const diff::BufferDifference most = compared({1, infinity, infinity, infinity}, {1, 9, 9, 4});
  CHECK(most.empty_b == 9);
  CHECK(most.only_b == 1);
  const diff::BufferDifference half = compared({1, infinity, infinity, infinity, infinity}, {1, 9, 9, 4, 5});
  CHECK(half.empty_b == no_depth);
  CHECK(half.only_b == 4);
}

TEST_CASE("pictures: NaN is equal to NaN where both have it, and to no number") {
  CHECK(compared({no_number, 2}, {no_number, 2}).depths == 0);
  const diff::BufferDifference found = compared({no_number, 2, 3}, {1, no_number, 3});
  CHECK(found.depths == 2);
  CHECK(found.not_finite == 2);
}

TEST_CASE("pictures: depths are within rounding up to the amount, and the farthest of the others is kept") {
  const diff::BufferDifference found = compared({1, 2, 3, 4}, {1.009, 7, 3.011, 6}, 0.01);
  CHECK(found.depths_rounded == 1);
  CHECK(found.depths == 3);
  CHECK(found.farthest == 5);
  CHECK(found.first == 1);
  CHECK(found.apart[1] == 1);
  CHECK(found.apart[3] == doctest::Approx(0.4));
  CHECK(compared({2, 4, 3}, {4, 5, 3.5}).farthest == 2);
}
