#include "traces/text.hpp"

#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace zstep;

TEST_CASE("text from outside shows itself and does nothing else") {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", ""},
      {"A, \u00fc \u2212 \u4e2d \U0001f600 \\x1b", "A, \u00fc \u2212 \u4e2d \U0001f600 \\x1b"},
      {"\x1b[31mred\x07", "\\x1b[31mred\\x07"},
      {"one\ntwo\r\n\tthree", "one\\ntwo\\r\\n\\tthree"},
      {std::string("a\0b", 3), "a\\x00b"},
      {"\x7f\u0085\u009b31m", "\\x7f\\u0085\\u009b31m"},
      {"\u202eevil\u2066\u200f\ufeff\u2028", "\\u202eevil\\u2066\\u200f\\ufeff\\u2028"},
      {"\xff\xc3", "\\xff\\xc3"},
      {"\xc0\x8a\xe0\x80\x8a", "\\xc0\\x8a\\xe0\\x80\\x8a"},  // an overlong line end
      {"\xed\xa0\x80", "\\xed\\xa0\\x80"},                    // half of a surrogate pair
      {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},           // beyond the last character
  };
  for (const auto& each : cases) {
    CAPTURE(each.first);
    CHECK(printable(each.first) == each.second);
  }
  CHECK(printable_lines("a\n\tb\x1b\r\n") == "a\n\tb\\x1b\\r\n");
  CHECK(printable_json("[\n\"\u00fc\x7f\u0085\u202e\"\n]") == "[\n\"\u00fc\\u007f\\u0085\\u202e\"\n]");
}

TEST_CASE("of words that are near, one that differs in hyphens is nearer than one that it begins with") {
  const std::vector<std::string_view> coverages{"top_left", "inclusive", "round", "ceil_floor", "round_half_open"};
  CHECK(near_word("round-half-open", coverages) == "round_half_open");
  CHECK(near_word("round-half", coverages) == "round");
  CHECK(near_word("roun", coverages) == "round");
  CHECK(near_word("top", coverages) == "top_left");
}
