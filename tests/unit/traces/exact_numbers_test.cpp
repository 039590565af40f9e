// What the oracle rests on: quotients that are rounded once, outlines of fractions, and what is noted of decisions.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/golden/golden.hpp"
#include "tests/laws/decisions/deciding.hpp"
#include "traces/oracle/exact_depth.hpp"
#include "traces/oracle/exact_geometry.hpp"

using namespace zstep;
using namespace zstep::oracle;

namespace {

Point point(int x, int y, int z = 0) { return {x, y, z}; }

}  // namespace

TEST_CASE("exact: what is left of a division decides where its digits end half way") {
  // 2^52 + 1/2 lies half way between two doubles and goes to the even one; the least more goes up, the least less down.
  const Whole one = Whole(1) << 60, even = (Whole(1) << 52) * one + one / 2;
  CHECK(quotient(even, one) == 0x1p52);
  CHECK(quotient(even + 1, one) == 0x1p52 + 1);
  CHECK(quotient(even - 1, one) == 0x1p52);
  CHECK(quotient(-even - 1, one) == -0x1p52 - 1);
  CHECK(quotient(even + 1, -one) == -0x1p52 - 1);
}

TEST_CASE("exact: a point on the edge that two outlines share is covered by one of them") {
  const std::array left{point(0, 0), point(2, 0), point(2, 2), point(0, 2)};
  const std::array right{point(2, 0), point(4, 0), point(4, 2), point(2, 2)};
  CHECK_FALSE(covers(left, 2, 1));
  CHECK(covers(right, 2, 1));
  const std::array over{point(0, 2), point(2, 2), point(2, 4), point(0, 4)};
  CHECK(covers(left, 1, 2) != covers(over, 1, 2));
  // Also on an edge that is not upright, where the crossing is a third.
  const std::array below{point(0, 0), point(3, 0), point(0, 9)}, above{point(3, 0), point(3, 9), point(0, 9)};
  const Rational x(8, 3), y(1);
  CHECK(covers(below, x, y) != covers(above, x, y));
}

TEST_CASE("exact: the common part has the corners that lie on an edge of the other outline") {
  const std::array whole{point(0, 0), point(2, 0), point(2, 2), point(0, 2)};
  const std::array half{point(0, 0), point(1, 0), point(1, 2), point(0, 2)};
  CHECK(area_of(common_part(whole, whole)) == 8);  // twice the area
  CHECK(area_of(common_part(whole, half)) == 4);
  CHECK(area_of(common_part(half, whole)) == 4);
  const std::array beside{point(2, 0), point(3, 0), point(3, 2), point(2, 2)};
  CHECK(common_part(whole, beside).empty());  // they touch
}

TEST_CASE("exact: of five corners and more it is not said that they are convex, as a star turns one way all along") {
  CHECK(is_convex(std::array{point(0, 0), point(2, 0), point(0, 2)}));
  CHECK(is_convex(std::array{point(0, 0), point(2, 0), point(2, 2), point(0, 2)}));
  CHECK_FALSE(is_convex(std::array{point(0, 0), point(4, 0), point(1, 1), point(0, 4)}));
  CHECK_FALSE(is_convex(std::array{point(0, 9), point(6, -8), point(-9, 3), point(9, 3), point(-6, -8)}));
}

TEST_CASE("exact: depths are compared rightly whichever way their fractions are signed") {
  const auto edge = [](double x, double z) { return Edge{{x, 0, z}, {x, 8, z}}; };
  const auto near = ExactDepth::between(edge(0, 1), edge(8, 2), 4),
             far = ExactDepth::between(edge(0, 3), edge(8, 4), 4);
  // The same with left and right exchanged: numerator and denominator are negative.
  const auto near_back = ExactDepth::between(edge(8, 2), edge(0, 1), 4),
             far_back = ExactDepth::between(edge(8, 4), edge(0, 3), 4);
  for (const auto& one : {near, near_back})
    for (const auto& other : {far, far_back}) {
      CHECK(one->compare(*other, 4) == -1);
      CHECK(other->compare(*one, 4) == 1);
      CHECK(one->at(4) == 1.5);
    }
  CHECK(near->compare(*near_back, 4) == 0);
}

TEST_CASE("exact: where two edges meet, the depth is the left one's, from doubles and from fractions alike") {
  const Edge left{{0, 0, 1}, {4, 8, 1}}, right{{8, 0, 3}, {4, 8, 3}};
  CHECK(ExactDepth::between(left, right, 8)->at(4) == 1);
  CHECK(ExactDepth::between(point(0, 0, 1), point(4, 8, 1), point(8, 0, 3), point(4, 8, 3), 8)->at(4) == 1);
}

TEST_CASE("decisions: the first wrong one is kept, the farthest off, and runs are added up") {
  using deciding::Outcome;
  CHECK(deciding::outcome_of(true, true) == Outcome::right);
  CHECK(deciding::outcome_of(false, true) == Outcome::open);
  CHECK(deciding::outcome_of(false) == Outcome::wrong);
  const Trace trace = open_jsonl(test::golden_files().front());
  deciding::Common common(trace);
  common.step = 3, common.note(Predicate::side, Outcome::open);
  common.step = 5, common.note(Predicate::side, Outcome::wrong, 2, 8);
  common.step = 7, common.note(Predicate::side, Outcome::wrong, 6, 8);
  common.step = 9, common.note(Predicate::side, Outcome::right);
  Decisions sum = common.decisions;
  const Decided& side = sum[Predicate::side];
  CHECK(side.decisions == 4);
  CHECK(side.left_open == 1);
  CHECK(side.wrong == 2);
  CHECK(side.first_wrong == 5);
  CHECK(side.worst == 0.75);
  sum.add(common.decisions);
  CHECK(side.decisions == 8);
  CHECK(side.left_open == 2);
  CHECK(side.wrong == 4);
  CHECK(sum.wrong() == 4);
}
