// Every portable function gives the double that MPFR rounds to, in two million calls: all magnitudes, angles next to
// quarter turns, powers that are exact or lie exactly between two doubles, and subnormal results. Where the true value
// is closest to the middle between two doubles, it gives one of the two.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include <mpfr.h>

#include "traces/math/portable_math.hpp"

using namespace zstep;

namespace {

struct Number {
  mpfr_t value;
  Number() { mpfr_init2(value, 53); }
  ~Number() { mpfr_clear(value); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
};

class Reference {
 public:
  Reference() {
    mpfr_set_emin(-1073);  // a double's
    mpfr_set_emax(1024);
  }
  template <class Function>
  double of(Function function, double x) {
    mpfr_set_d(a_.value, x, MPFR_RNDN);
    return rounded(function(result_.value, a_.value, MPFR_RNDN));
  }
  template <class Function>
  double of(Function function, double x, double y) {
    mpfr_set_d(a_.value, x, MPFR_RNDN);
    mpfr_set_d(b_.value, y, MPFR_RNDN);
    return rounded(function(result_.value, a_.value, b_.value, MPFR_RNDN));
  }
  /// How far a result is from the true value, in units of its last digit.
  template <class Function>
  double digits_off(Function function, double x, double result) {
    mpfr_t exact;
    mpfr_init2(exact, 200);
    mpfr_set_d(a_.value, x, MPFR_RNDN);
    function(exact, a_.value, MPFR_RNDN);
    mpfr_sub_d(exact, exact, result, MPFR_RNDN);
    const double off = std::abs(mpfr_get_d(exact, MPFR_RNDN));
    mpfr_clear(exact);
    return off / std::ldexp(1.0, std::ilogb(result) - 52);
  }

 private:
  double rounded(int which_way) {
    mpfr_subnormalize(result_.value, which_way, MPFR_RNDN);
    return mpfr_get_d(result_.value, MPFR_RNDN);
  }
  Number a_, b_, result_;
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  int whole(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  double sign() { return (random_() & 1) != 0 ? -1 : 1; }
  /// Of a magnitude 2^low … 2^high. One in four has a short mantissa: there exact and nearly exact results are.
  double sized(int low, int high) {
    const double mantissa = whole(0, 3) == 0 ? 1 + whole(0, 255) / 256.0 : between(1, 2);
    return std::ldexp(mantissa, whole(low, high));
  }

 private:
  std::mt19937_64 random_;
};

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a == 0 && b == 0);
}

using Ours = double (*)(double);
using Theirs = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

struct Case {
  const char* name;
  Ours ours;
  Theirs theirs;
  int smallest, largest;  ///< powers of two
  double low, high;       ///< where most calls of a lesson's formula lie
  bool both_signs;
};

const Case cases[] = {
    {"sin", portable::sin, mpfr_sin, -30, 1023, -10, 10, true},
    {"cos", portable::cos, mpfr_cos, -30, 1023, -10, 10, true},
    {"tan", portable::tan, mpfr_tan, -30, 1023, -10, 10, true},
    {"asin", portable::asin, mpfr_asin, -30, -1, -1, 1, true},
    {"acos", portable::acos, mpfr_acos, -60, -1, -1, 1, true},
    {"atan", portable::atan, mpfr_atan, -30, 62, -4, 4, true},
    {"exp", portable::exp, mpfr_exp, -60, 9, -746, 711, true},
    {"log", portable::log, mpfr_log, -1074, 1023, 0.5, 2, false},
    {"log10", portable::log10, mpfr_log10, -1074, 1023, 0.5, 2, false},
    {"sinh", portable::sinh, mpfr_sinh, -30, 9, -4, 4, true},
    {"cosh", portable::cosh, mpfr_cosh, -30, 9, -4, 4, true},
    {"tanh", portable::tanh, mpfr_tanh, -30, 5, -4, 4, true},
};

constexpr int calls = 75'000;

}  // namespace

TEST_CASE("functions of one number give what MPFR rounds to") {
  Reference reference;
  for (const Case& one : cases) {
    int wrong = 0;
    std::string first;
    const auto hold = [&](double x) {
      const double ours = one.ours(x), theirs = reference.of(one.theirs, x);
      if (same(ours, theirs)) return;
      if (wrong++ == 0) {
        char text[160];
        std::snprintf(text, sizeof text, "%s(%a) is %a, not %a", one.name, x, theirs, ours);
        first = text;
      }
    };
    Draw draw(1);
    for (int i = 0; i < calls; ++i) {
      hold(draw.sized(one.smallest, one.largest) * (one.both_signs ? draw.sign() : 1));
      hold(draw.between(one.low, one.high));
    }
    CHECK_MESSAGE(wrong == 0, wrong, " of ", 2 * calls, " calls: ", first);
  }
}

TEST_CASE("the hardest arguments that are known") {
  Reference reference;
  const auto hold = [&](Ours ours, Theirs theirs, double x) {
    CAPTURE(x);
    CHECK(reference.digits_off(theirs, x, ours(x)) <= 0.5 + 0x1p-36);
  };
  // V. Lefèvre and J.-M. Muller, "Worst cases for correct rounding of the elementary functions in double precision",
  // 2001
  for (const double x : {0x1.9e9cbbfd6080bp-31, -0x1.ed318efb627eap-27, 0x1.83d4bcdebb3f4p+2, -0x1.e8bdbfcd9144ep+3})
    hold(portable::exp, mpfr_exp, x);
  for (const double x : {0x1.62a88613629b6p+678, 0x1.d6336a88077aap+91, 0x1.ab50b409c8aeep+8, 0x1.fd15aae6f6eb2p-1})
    hold(portable::log, mpfr_log, x);
  for (const double x : {0x1.e0000000001c2p-20, 0x1.598bae9e632f6p-7, 0x1.fe767739d0f6dp-2})
    hold(portable::sin, mpfr_sin, x);
  for (const double x : {0x1.06b505550e6b2p-9, 0x1.34ec2f9fc9c00p+1, 0x1.8000000000009p-23})
    hold(portable::cos, mpfr_cos, x);
  for (const double x : {0x1.dffffffffff1fp-22, 0x1.50486b2f87014p-5}) hold(portable::tan, mpfr_tan, x);
  hold(portable::atan, mpfr_atan, 0x1.e000000000546p-20);
  hold(portable::asin, mpfr_asin, 0x1.dffffffffff1fp-22);

  // Next to quarter turns; the double nearest to one of all is 6381956970095103 · 2^797.
  for (const auto& [ours, theirs] :
       {std::pair<Ours, Theirs>{portable::sin, mpfr_sin}, {portable::cos, mpfr_cos}, {portable::tan, mpfr_tan}}) {
    hold(ours, theirs, std::ldexp(6381956970095103.0, 797));
    Draw draw(2);
    for (int i = 1; i < 20'000; ++i) {
      double x = i * 1.57079632679489661923 * (i < 10'000 ? 1 : draw.whole(1, 1 << 30));
      x += draw.whole(-1, 1) * (std::nextafter(x, 1e300) - x);
      if (const double right = reference.of(theirs, x); !same(ours(x), right)) CHECK_MESSAGE(ours(x) == right, x);
    }
  }
}

TEST_CASE("powers and angles of two numbers give what MPFR rounds to") {
  Reference reference;
  Draw draw(3);
  int wrong_powers = 0, wrong_angles = 0, in_the_middle = 0;
  for (int i = 0; i < 4 * calls; ++i) {
    double base = 0, exponent = 0;
    switch (i % 4) {
      case 0:  // as in formulas
        base = draw.between(0, 10), exponent = draw.between(-4, 4);
        break;
      case 1:  // exact, or exactly between two doubles
        base = draw.whole(1, 1 << 27), exponent = draw.whole(-68, 72) / 4.0;
        if (exponent == 2 && std::fma(base, base, -base * base) != 0) ++in_the_middle;
        break;
      case 2:
        base = draw.between(0.9, 1.1), exponent = draw.between(-7000, 7000);
        break;
      default:
        base = draw.sized(-1074, 1023), exponent = draw.sized(-60, 10) * draw.sign();
    }
    if (!same(portable::pow(base, exponent), reference.of(mpfr_pow, base, exponent))) ++wrong_powers;
    const int reach = i % 2 == 0 ? 30 : 1022;
    const double y = draw.sized(-reach, reach) * draw.sign(), x = draw.sized(-reach, reach) * draw.sign();
    if (!same(portable::atan2(y, x), reference.of(mpfr_atan2, y, x))) ++wrong_angles;
  }
  CHECK(wrong_powers == 0);
  CHECK(wrong_angles == 0);
  CHECK(in_the_middle > 50);
}
