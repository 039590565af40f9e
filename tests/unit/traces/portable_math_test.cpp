// What each platform must agree on to the bit. That the bits are the right ones is held against MPFR, in tests/mpfr.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "traces/math/portable_math.hpp"

using namespace zstep;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

}  // namespace

TEST_CASE("portable functions have the same bits everywhere") {
  std::mt19937_64 random(19);
  std::uint64_t all = 0;
  const auto add = [&](double value) {
    all = std::rotl(all, 5) * 0x9e3779b97f4a7c15 + std::bit_cast<std::uint64_t>(value);
  };
  for (int i = 0; i < 4000; ++i) {
    const double part = static_cast<double>(random() >> 11) * 0x1p-53 + 0x1p-54;  // 0 … 1
    const double x = std::ldexp(part, static_cast<int>(random() % 12)), y = part * 9 - 4;
    for (const double angle : {x, -y, x * 0x1p200})
      add(portable::sin(angle)), add(portable::cos(angle)), add(portable::tan(angle));
    add(portable::asin(part)), add(portable::acos(-part)), add(portable::atan(y)), add(portable::atan2(y, x - 4));
    add(portable::exp(y)), add(portable::log(x)), add(portable::log10(x)), add(portable::pow(x, y)),
        add(portable::pow(y, i % 9));
    add(portable::sinh(y)), add(portable::cosh(y)), add(portable::tanh(y));
  }
  CHECK(all == 6879204053913068534);
}

TEST_CASE("what is exact is given exactly, and what is not a number is none") {
  const double sizes[] = {0, 0.5, 1, 2, 3, 1e308, 5e-324, infinite};
  for (const double size_1 : sizes)
    for (const double a : {size_1, -size_1}) {
      CAPTURE(a);
      for (const double size_2 : sizes)
        for (const double b : {size_2, -size_2}) {
          CAPTURE(b);
          const bool whole = std::floor(b) == b;
          if (a == 0 || std::isinf(a) || std::isinf(b) || b == 0 || a == 1 || (a < 0 && !whole))
            CHECK(same_bits(portable::pow(a, b), std::pow(a, b)));
          if (a == 0 || b == 0 || std::isinf(a) || std::isinf(b))
            CHECK(same_bits(portable::atan2(a, b), std::atan2(a, b)));
        }
      if (a == 0 || std::isinf(a)) {
        CHECK(same_bits(portable::sin(a), std::sin(a)));
        CHECK(same_bits(portable::cos(a), std::cos(a)));
        CHECK(same_bits(portable::tan(a), std::tan(a)));
        CHECK(same_bits(portable::atan(a), std::atan(a)));
        CHECK(same_bits(portable::asin(a), std::asin(a)));
        CHECK(same_bits(portable::acos(a), std::acos(a)));
        CHECK(same_bits(portable::exp(a), std::exp(a)));
        CHECK(same_bits(portable::log(a), std::log(a)));
        CHECK(same_bits(portable::log10(a), std::log10(a)));
        CHECK(same_bits(portable::sinh(a), std::sinh(a)));
        CHECK(same_bits(portable::cosh(a), std::cosh(a)));
        CHECK(same_bits(portable::tanh(a), std::tanh(a)));
      }
    }
  for (const auto of : {portable::sin, portable::cos, portable::tan, portable::asin, portable::acos, portable::atan,
                        portable::exp, portable::log, portable::log10, portable::sinh, portable::cosh, portable::tanh})
    CHECK(std::isnan(of(std::nan(""))));
  CHECK(std::isnan(portable::log(-1)));
  CHECK(std::isnan(portable::asin(1.5)));
  CHECK(portable::asin(1) == 0x1.921fb54442d18p+0);
  CHECK(portable::acos(-1) == 0x1.921fb54442d18p+1);
  CHECK(portable::acos(1) == 0);
  CHECK(portable::exp(1) == 0x1.5bf0a8b145769p+1);
  CHECK(portable::log10(1000) == 3);
  CHECK(portable::pow(10, -5) == 1e-5);
  CHECK(portable::pow(9, 1.5) == 27);
  CHECK(portable::pow(-2, 3) == -8);
  CHECK(portable::pow(2, -1074) == 5e-324);
  CHECK(portable::exp(710) == infinite);
  CHECK(portable::exp(-746) == 0);
}
