// The bounds by which every judgement is made: how far rounding may move a number.
#include "traces/formulas/rounding.hpp"

#include <cmath>

#include <doctest/doctest.h>

using namespace zstep;
using formulas::Rounded;

namespace {

TEST_CASE("rounding: each operation passes on what its operands may be off by") {
  const Rounded a(6, 2), b(-3, 0.5);
  const auto is = [](const Rounded& number, double value, double spread) {
    CHECK(number.value == doctest::Approx(value));
    CHECK(number.spread == doctest::Approx(spread));
  };
  is(a + b, 3, 2.5);
  is(a - b, 9, 2.5);
  is(-b, 3, 0.5);
  is(a * b, -18, 2 * 3 + 0.5 * 6);
  is(a / b, -2, (2 + 0.5 * 2) / 3);
  is(formulas::sqrt(Rounded(16, 2)), 4, 2 / 8.0);
  is(formulas::abs(b), 3, 0.5);
  is(formulas::ceil(Rounded(2.5, 1)), 3, 0);
  // A small difference of large numbers has few digits left.
  CHECK(formulas::gives(Rounded(1e6) - Rounded(1e6 - 1), 1.0019, 1e-9));
  CHECK(!formulas::gives(Rounded(1e6) - Rounded(1e6 - 1), 1.0021, 1e-9));
}

TEST_CASE("rounding: a whole number may be another one where what it was made of is as near to it as rounding") {
  const Rounded x(2.75, 4), y(5, 1);
  CHECK(formulas::ceil(x).turns == 0.25 / 4);
  CHECK(formulas::floor(x).turns == 0.25 / 4);
  CHECK(formulas::round(x).turns == 0.25 / 4);
  CHECK(formulas::round(Rounded(3, 4)).turns == 0.5 / 4);
  CHECK(formulas::ceil(Rounded(3, 4)).turns == 0);
  CHECK(formulas::ceil(Rounded(3, 0)).turns == 0);
  CHECK((formulas::ceil(x) - Rounded(1)).turns == 0.25 / 4);
  CHECK((Rounded(1) + formulas::ceil(x)).turns == 0.25 / 4);
  CHECK(std::isinf(y.turns));
  CHECK(std::isinf((x * y).turns));
}

TEST_CASE("rounding: a number passes just inside its bound, and not just outside") {
  for (const double value : {1.0, -250.0, 3e-8}) {
    CAPTURE(value);
    for (const double rounding : {formulas::rounding_of_float64, formulas::rounding_of_float32}) {
      CHECK(formulas::gives(Rounded(value), value * (1 + 0.99 * rounding), rounding));
      CHECK(!formulas::gives(Rounded(value), value * (1 + 1.01 * rounding), rounding));
    }
  }
  CHECK(formulas::gives(Rounded(no_depth), no_depth, 1e-9));
  CHECK(!formulas::gives(Rounded(no_depth), 1e300, 1e-9));
  CHECK(!formulas::gives(Rounded(1), std::nan(""), 1));
}

TEST_CASE("rounding: an ulp is the distance to the next number of the format") {
  CHECK(formulas::last_digit(1, NumberFormat::float64, 0) == std::ldexp(1.0, -52));
  CHECK(formulas::last_digit(-1, NumberFormat::float32, 0) == std::ldexp(1.0, -23));
  CHECK(formulas::last_digit(1, NumberFormat::fixed16, 0.25) == 0.25);
}

}  // namespace
