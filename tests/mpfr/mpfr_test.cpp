// Every portable function gives the double that MPFR rounds to, in two million calls: all magnitudes, angles next to
// quarter turns, powers that are exact or lie exactly between two doubles, and subnormal results. Where the true value
// is within a 2^32nd of the last digit from the middle between two doubles, it gives one of the two.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

#include <mpfr.h>

#include "traces/math/kernels.hpp"
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

  /// How far a sum is from the true value, relative to that.
  template <class Function>
  double relative_error(Function function, double x, portable::DoubleDouble found) {
    mpfr_t exact, off;
    mpfr_inits2(300, exact, off, static_cast<mpfr_ptr>(nullptr));
    mpfr_set_d(a_.value, x, MPFR_RNDN);
    function(exact, a_.value, MPFR_RNDN);
    mpfr_sub_d(off, exact, found.high, MPFR_RNDN);
    mpfr_sub_d(off, off, found.low, MPFR_RNDN);
    if (!mpfr_zero_p(exact)) mpfr_div(off, off, exact, MPFR_RNDN);
    const double error = std::abs(mpfr_get_d(off, MPFR_RNDN));
    mpfr_clears(exact, off, static_cast<mpfr_ptr>(nullptr));
    return error;
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
  std::array<double, 4> hard;  ///< see "hard arguments"
};

const Case cases[] = {
    {"sin",
     portable::sin,
     mpfr_sin,
     -30,
     1023,
     -10,
     10,
     true,
     {0x1.7615bfeb2f55cp-4, 0x1.1da9963073d56p-6, 0x1.978c45fadf269p-8, 0x1.7835e5b2c5f4dp-7}},
    {"cos",
     portable::cos,
     mpfr_cos,
     -30,
     1023,
     -10,
     10,
     true,
     {0x1.1fb72d43a7db9p-5, 0x1.5fb99dc3e1f1cp-2, 0x1.58ea71c0dbb9ap+1, 0x1.f4124ac4aba0fp-1}},
    {"tan",
     portable::tan,
     mpfr_tan,
     -30,
     1023,
     -10,
     10,
     true,
     {0x1.a0e02559a99b2p-2, 0x1.5db55330dd8abp-5, 0x1.0abcdc5b7eb06p-6, 0x1.f9c03566d7d64p-7}},
    {"asin",
     portable::asin,
     mpfr_asin,
     -30,
     -1,
     -1,
     1,
     true,
     {0x1.aee5a619e9c07p-4, 0x1.c39c7d73e05bbp-4, 0x1.686f4d05eddc3p-7, 0x1.aa7db2b5e74ccp-5}},
    {"acos",
     portable::acos,
     mpfr_acos,
     -60,
     -1,
     -1,
     1,
     true,
     {0x1.5e0fa503aa5e8p-2, 0x1.bf430d614ffd7p-6, 0x1.1e301f7f48e2bp-6, 0x1.886ac31f5cadp-5}},
    {"atan",
     portable::atan,
     mpfr_atan,
     -30,
     62,
     -4,
     4,
     true,
     {0x1.db6dcb2fb2b4dp-5, 0x1.1b9e96a26101p-8, 0x1.db6213b788405p-6, 0x1.d6c1030707695p-2}},
    {"exp",
     portable::exp,
     mpfr_exp,
     -60,
     9,
     -746,
     711,
     true,
     {0x1.302228ea771acp-2, -0x1.372ca7f9c9237p-11, -0x1.d9fd3e0555609p+1, 0x1.f4da3e55ef51dp-3}},
    {"log",
     portable::log,
     mpfr_log,
     -1074,
     1023,
     0.5,
     2,
     false,
     {0x1.6a91e75932854p-2, 0x1.665d180fe3bccp+0, 0x1.5b756e093ea53p+0, 0x1.c5cf3c7886f46p+0}},
    {"log10",
     portable::log10,
     mpfr_log10,
     -1074,
     1023,
     0.5,
     2,
     false,
     {0x1.c53174b9039d1p-3, 0x1.094a5bca6c4a8p-1, 0x1.1bc3e6b0cb7bep-1, 0x1.e5f2d66d387dep+2}},
    {"sinh",
     portable::sinh,
     mpfr_sinh,
     -30,
     9,
     -4,
     4,
     true,
     {0x1.b7313de7c9d61p-1, 0x1.b0329a338f97bp-4, 0x1.612640648187bp-4, 0x1.5f7e8a809d85fp+0}},
    {"cosh",
     portable::cosh,
     mpfr_cosh,
     -30,
     9,
     -4,
     4,
     true,
     {0x1.c5c2a393b9b45p-5, 0x1.34a1bf30a35a2p-7, 0x1.52bbacc6fa7e2p-3, 0x1.9cfd3ef078cc6p-7}},
    {"tanh",
     portable::tanh,
     mpfr_tanh,
     -30,
     5,
     -4,
     4,
     true,
     {0x1.3b7447365dabap-3, 0x1.4da7f106f73bfp+1, 0x1.475511451d651p-4, 0x1.85feb7bc803bap-4}},
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

// Found by a search with MPFR: in stretches of 2^18 doubles a function is a parabola but for 2^-30 of a last digit, so
// the doubles whose results are next to a middle come from sorting multiples of its slope; some 10^5 stretches each.
TEST_CASE("hard arguments: true values that are next to the middle between two doubles") {
  Reference reference;
  for (const Case& one : cases)
    for (const double x : one.hard) {
      CAPTURE(one.name);
      CAPTURE(x);
      const double off = reference.digits_off(one.theirs, x, one.ours(x));
      CHECK(std::abs(off - 0.5) < 0x1p-32);  // as hard as said
      CHECK(off <= 0.5 + 0x1p-36);
    }
}

TEST_CASE("angles next to quarter turns give what MPFR rounds to") {
  Reference reference;
  const auto hold = [&](Ours ours, Theirs theirs, double x) {
    const double right = reference.of(theirs, x);
    if (!same(ours(x), right)) CHECK_MESSAGE(ours(x) == right, x);
  };
  for (const auto& [ours, theirs] :
       {std::pair<Ours, Theirs>{portable::sin, mpfr_sin}, {portable::cos, mpfr_cos}, {portable::tan, mpfr_tan}}) {
    const double nearest = std::ldexp(6381956970095103.0, 797);  // 2^-60 from a quarter turn, as is checked below
    hold(ours, theirs, nearest);
    Draw draw(2);
    for (int i = 1; i < 20'000; ++i) {
      double x = i * 1.57079632679489661923 * (i < 10'000 ? 1 : draw.whole(1, 1 << 30));
      x += draw.whole(-1, 1) * (std::nextafter(x, 1e300) - x);
      hold(ours, theirs, x);
    }
    CHECK(std::abs(portable::cos(nearest)) < 0x1p-60);
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

TEST_CASE("what is summed before the last rounding is off by no more than is said") {
  Reference reference;
  Draw draw(4);
  double of_first_tries = 0, of_kernels = 0;
  const auto hold = [&](double& worst, Theirs theirs, double x, portable::DoubleDouble found) {
    worst = std::max(worst, reference.relative_error(theirs, x, found));
  };
  for (int i = 0; i < calls; ++i) {
    const double x = i % 3 == 0 ? draw.sized(-1000, 1000) : draw.between(0.5, i % 3 == 1 ? 2 : 8);
    hold(of_first_tries, mpfr_log, x, portable::quick_logarithm(x));
    hold(of_kernels, mpfr_log, x, portable::logarithm(x));
    const double tangent = i % 3 == 0 ? draw.sized(-30, 60) : draw.between(0, 4);
    hold(of_first_tries, mpfr_atan, tangent, portable::quick_angle(tangent, 1));
    hold(of_kernels, mpfr_atan, tangent, portable::angle(tangent, 1));
    const double turn = i % 2 == 0 ? draw.between(-10, 10) : draw.sized(-30, 1000);
    hold(of_kernels, mpfr_sin, turn, portable::sine_cosine(turn).sine);
    hold(of_kernels, mpfr_cos, turn, portable::sine_cosine(turn).cosine);
    const double power = draw.between(-300, 300);
    const portable::Exponential e = portable::exponential(power);
    hold(of_kernels, mpfr_exp, power, portable::scaled(portable::value(e), e.exponent));
  }
  MESSAGE("first tries: 2^", std::log2(of_first_tries), ", the others: 2^", std::log2(of_kernels));
  CHECK(of_first_tries < portable::quick_error);
  CHECK(of_kernels < 0x1p-96);
}
