// simd::quotient against the processor's own division: every bit.
#include <doctest/doctest.h>

#include "algorithms/fast/simd.hpp"

#if ZSTEP_HAS_LANES

#include <bit>
#include <cmath>
#include <random>

namespace {

using namespace zstep::simd;

struct Division {
  Doubles e, b;
  Doubles q{};
};
ZSTEP_INLINE void divide(Division& d) { quotient(d.e, d.b, 1 / d.b, d.q); }
ZSTEP_FOR_THIS_PROCESSOR(divide, Division)

/// How many of four quotients are not the processor's.
int wrong(Division d) {
  divide_on_this_processor(d);
  int count = 0;
  for (int lane = 0; lane < four; ++lane)
    count += std::bit_cast<std::uint64_t>(double{d.q[lane]}) != std::bit_cast<std::uint64_t>(d.e[lane] / d.b[lane]);
  return count;
}

}  // namespace

TEST_SUITE("fast/quotient") {
  TEST_CASE("a quotient by the reciprocal is the processor's to the last bit") {
    std::mt19937_64 random(90);
    // Of any size that a raster's edge functions and areas have, and of mantissas with few bits, too.
    const auto number = [&] {
      const std::uint64_t bits = random();
      const int cut = static_cast<int>(random() % 53);
      const double mantissa = 1 + static_cast<double>((bits >> 12) >> cut << cut) * 0x1p-52;
      return std::ldexp(mantissa, static_cast<int>(random() % 800) - 400);
    };
    int off = 0;
    for (int i = 0; i < 200'000; ++i) {
      Division d;
      for (int lane = 0; lane < four; ++lane) {
        d.b[lane] = number();
        d.e[lane] = random() % 2 == 0 ? number() : -number();
        // Near the middle between two neighbours, where one digit more would be needed to see which is nearer.
        if (i % 2 == 0) {
          const double q = number(), half = (std::nextafter(q, INFINITY) - q) / 2;
          d.e[lane] = std::fma(d.b[lane], q, d.b[lane] * half);
        }
      }
      off += wrong(d);
    }
    CHECK(off == 0);
    CHECK(wrong({Doubles{0, 1, 1, -3}, Doubles{3, 1, 3, 3}}) == 0);
  }
}

#endif
