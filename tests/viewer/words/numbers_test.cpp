#include "sim/words/numbers.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace zstep;

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

TEST_CASE("numbers are short, true and with a real minus sign") {
  CHECK(number(3) == "3");
  CHECK(number(4.25) == "4.25");
  CHECK(number(-1.5) == "\u22121.5");
  CHECK(number(1.0 / 3) == "0.3333");
  CHECK(number(-0.0) == "0");
  CHECK(number(-1e-13, 3) == "0.000");
  CHECK(number(5, 2) == "5.00");
  CHECK(number(1.25e-7) == "1.25e\u221207");
}

TEST_CASE("a small factor keeps four digits that count, so that its product with a column can be reckoned") {
  CHECK(factor(0.25) == "0.25");
  CHECK(factor(-1) == "\u22121");
  CHECK(factor(1.0 / 3) == "0.3333");
  CHECK(factor(0.0323456) == "0.03235");
  CHECK(factor(-0.00045512) == "\u22120.0004551");
  CHECK(factor(0.0625) == "0.0625");
  CHECK(factor(0.0001) == "0.0001");
  CHECK(factor(0.00001234) == "1.23e\u221205");
  CHECK(factor(0) == "0");
}

TEST_CASE("numbers are found in sentences and formulas, digits of names are not") {
  const auto found = [](const std::string& text) {
    std::string all;
    for (const auto& [from, bytes] : numbers_in(text)) all += (all.empty() ? "" : " ") + text.substr(from, bytes);
    return all;
  };
  CHECK(found("x = x_0 + 0.5\u00b7(4 \u2212 2) = 1.5") == "0.5 4 2 1.5");
  CHECK(found("\u22123.25 < \u2212\u221e, (\u22121)/2, 5\u22123, z*\u22122") ==
        "\u22123.25 \u2212\u221e \u22121 2 5 3 2");
  CHECK(found("1.25e\u221207 and 2e+12 of e4, p12.5 at (9,\u00a07).") == "1.25e\u221207 2e+12 9 7");
  CHECK(found("12.") == "12");
  CHECK(found("") == "");
}

TEST_CASE("a number is known by what is shown of it") {
  CHECK(shown_as(0.33333333, "0.3333"));
  CHECK_FALSE(shown_as(0.3334, "0.3333"));
  CHECK(shown_as(-2.5, "\u22122.5"));
  CHECK_FALSE(shown_as(2.5, "\u22122.5"));
  CHECK(shown_as(1.2512e-7, "1.25e\u221207"));
  CHECK(shown_as(infinity, "\u221e"));
  CHECK_FALSE(shown_as(-infinity, "\u221e"));
  CHECK(shown_as(7, "7"));
  CHECK_FALSE(shown_as(std::numeric_limits<double>::quiet_NaN(), "7"));
  for (const double value : {3.0, -0.125, 1.0 / 3, 1234.5678, 2.5e-9, -7e12}) CHECK(shown_as(value, number(value)));
}

TEST_CASE("in a table what is not 0 does not look like 0") {
  CHECK(cell_number(0, 2) == "0.00");
  CHECK(cell_number(0.0004, 2) == "4e\u22124");
  CHECK(cell_number(-0.0049, 2) == "\u22125e\u22123");
  CHECK(cell_number(0.005, 2) == "0.01");
  CHECK(cell_number(3e-17, 4) == "3e\u221217");
  CHECK(cell_number(-1.5, 2) == "\u22121.50");
  CHECK(cell_number(std::numeric_limits<double>::infinity(), 2) == "\u221e");
  CHECK(decimals_needed(std::vector<double>{0.004321, 1.2345}) == 3);  // not two: 0.00 would be shown
  CHECK(decimals_needed(std::vector<double>{1e-17, 1.23456789}) == 2);
}

TEST_CASE("infinity is never written as a large number") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(number(inf) == "\u221e");
  CHECK(number(inf, 3) == "\u221e");
  CHECK(number(-inf) == "\u2212\u221e");
  CHECK(exact(inf) == "\u221e");
  CHECK(number(std::nan("")) == "undefined");
}

TEST_CASE("a column gets the decimals that its values need") {
  CHECK(decimals_needed(std::vector<double>{1, 2, 5}) == 0);
  CHECK(decimals_needed(std::vector<double>{1, 2.5}) == 1);
  CHECK(decimals_needed(std::vector<double>{1, std::numeric_limits<double>::infinity()}) == 0);
  CHECK(decimals_needed(std::vector<double>{1.0 / 3, 2.0 / 3}) == 2);
  CHECK(decimals_needed(std::vector<double>{1.0 / 3, 1.0 / 3 + 0.001}) == 3);
  CHECK(decimals_needed(std::vector<double>{0.12345678}, 1) == 1);
  CHECK(decimals_needed(std::vector<double>{}) == 0);
}

TEST_CASE("two numbers that differ look different, however little they differ") {
  const auto [a, b] = tell_apart(1.0, std::nextafter(1.0, 2.0));
  CHECK(a != b);
  const auto [c, d] = tell_apart(0.25, 0.25);
  CHECK(c == d);
  CHECK(c == "0.25");
  const auto [e, f] = tell_apart(0.123456, 0.123457);
  CHECK(e == "0.123456");
  CHECK(f == "0.123457");
}

TEST_CASE("the exact value reads back to the same bits") {
  for (const double value : {0.1, -1.0 / 3, 1e300, 4.25, 5e-324}) {
    const std::string minus = "\u2212";
    std::string text, shown = exact(value);
    for (std::size_t at = 0; at < shown.size();) {
      const bool is_minus = shown.compare(at, minus.size(), minus) == 0;
      text.push_back(is_minus ? '-' : shown[at]);
      at += is_minus ? minus.size() : 1;
    }
    CHECK(std::strtod(text.c_str(), nullptr) == value);
    CHECK(std::strtod(text.c_str() + text.find('(') + 1, nullptr) == value);
  }
}

TEST_CASE("thousands are set apart") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(12041) == "12\u00a0041");
  CHECK(grouped(1234567) == "1\u00a0234\u00a0567");
  CHECK(grouped(-1000) == "\u22121\u00a0000");
}
