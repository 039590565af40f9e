// Numbers as they are written.
#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <string>

#include <fmt/format.h>

#include "traces/math/portable_math.hpp"

using zstep::read_number;

TEST_CASE("a number is read as far as it goes, and nothing that is none") {
  struct Case {
    const char* text;
    std::size_t length;
    double value;
  };
  for (const Case& one : {Case{"12", 2, 12}, {"-3.5e-2;", 7, -0.035},
                          {".5", 2, 0.5},    {"7.", 2, 7},
                          {"1e5x", 3, 1e5},  {"2e", 1, 2},
                          {"2e+", 1, 2},     {"-0", 2, 0},
                          {"3,5", 1, 3},     {"1 2", 1, 1},
                          {"0x10", 1, 0},    {"", 0, 9},
                          {"-", 0, 9},       {".", 0, 9},
                          {"e5", 0, 9},      {"+1", 0, 9},
                          {" 1", 0, 9},      {"inf", 0, 9},
                          {"nan", 0, 9},     {"1e999", 0, 9},
                          {"-1e999", 0, 9}}) {
    double value = 9;
    CAPTURE(one.text);
    CHECK(read_number(one.text, value) == one.length);
    CHECK(value == one.value);
  }
}

TEST_CASE("what is written to be read back comes back to the bit") {
  std::mt19937_64 random(3);
  for (int k = 0; k < 20000; ++k) {
    const double number = std::bit_cast<double>(static_cast<std::uint64_t>(random()));
    if (!(number - number == 0)) continue;
    const std::string text = fmt::format("{}", number);
    double value = 0;
    REQUIRE(read_number(text, value) == text.size());
    REQUIRE(std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(number));
  }
}
