#include "sim/viewer/words/numbers.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace zstep;

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
