// What is read aloud: all that is printed, and no sign that a screen reader passes over.
#include "sim/words/spoken.hpp"

#include <doctest/doctest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "tests/golden/golden.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using words::spoken, words::spoken_formula;

namespace {

/// What is no letter, digit or mark of a sentence.
std::string unspeakable(const std::string& text) {
  for (const char c : text) {
    const bool speaks = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                        std::string_view(" .,:;?!()'\"-").find(c) != std::string_view::npos;
    if (!speaks) return {c};
  }
  return {};
}

/// The digits of a text, in order: no number may be lost.
std::string digits_of(std::string_view text) {
  std::string digits;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] >= '0' && text[at] <= '9') digits += text[at];
    // 2e-5 is read as 2 times 10 to the minus 5.
    else if (text[at] == 'e' && !digits.empty() && at > 0 && std::isdigit(text[at - 1]) != 0) digits += "10";
  }
  return digits;
}

}  // namespace

TEST_CASE("spoken: signs are words") {
  CHECK(spoken("z* \u2265 \u22120.5") == "z star at least minus 0.5");
  CHECK(spoken("5 < 5 is false: equal is not nearer, so A stays.") ==
        "5 less than 5 is false: equal is not nearer, so A stays.");
  CHECK(spoken("Edge 4 (41\u20136) begins at (4.81, 3.55).") == "Edge 4 (41 to 6) begins at (4.81, 3.55).");
  CHECK(spoken("step 12\u00a0041") == "step 12041");
  CHECK(spoken("1.2e\u221207") == "1.2 times 10 to the power minus 07");
  CHECK(spoken("of 75 % of the area") == "of 75 percent of the area");
  CHECK(spoken("the polygon's \u221e") == "the polygon's infinity");
  CHECK(spoken("\u2192 enters") == "enters");
  CHECK(spoken("z \u2190 z + dz") == "z becomes z plus dz");
  CHECK(spoken("\u2500\u2500 visible") == "visible");
  CHECK(spoken("\u25cf active") == "active");
  CHECK(spoken("").empty());
}

TEST_CASE("spoken: a formula in words") {
  CHECK(spoken_formula("z = 3/4") == "z equals 3 over 4");
  CHECK(spoken_formula("z = (a + b)/4 = 0.75") == "z equals, a plus b, over 4 equals 0.75");
  CHECK(spoken_formula("z* = z*_L + (z*_R \u2212 z*_L)(x \u2212 x_L)/(x_R \u2212 x_L) = 0.5") ==
        "z star equals z star sub L plus, z star sub R minus z star sub L, times, x minus x sub L, over, "
        "x sub R minus x sub L, equals 0.5");
  CHECK(spoken_formula("x = 12 + (\u22120.5)(4 \u2212 2)") == "x equals 12 plus minus 0.5 times, 4 minus 2");
  CHECK(spoken_formula("k\u00b7dz/dx") == "k times dz over dx");
  CHECK(spoken_formula("zbuffer[x,y]: 0.7 < \u221e is true") == "zbuffer at x,y: 0.7 less than infinity is true");
  CHECK(spoken_formula("\u2308x_L \u2212 1/2\u2309") == "the ceiling of x sub L minus 1 over 2");
}

TEST_CASE("spoken: an apostrophe is no prime, a stroke between words is no fraction, a field's name is words") {
  CHECK(spoken_formula("x' = 3, y' = 4, z_light = 0.5") ==
        "x prime equals 3, y prime equals 4, z sub light equals 0.5");
  CHECK(spoken("the vertices' outcodes") == "the vertices' outcodes");
  CHECK(spoken_formula("the vertices' outcodes, or-ed") == "the vertices' outcodes, or-ed");
  CHECK(spoken("flip its polygon's in/out flag") == "flip its polygon's in or out flag");
  CHECK(spoken("a/z and dz/dx") == "a over z and dz over dx");
  CHECK(spoken("write_pixel comes after x_L") == "write pixel comes after x sub L");
}

TEST_CASE("spoken: every letter of the Greek alphabet and every sign of the lessons has a name") {
  CHECK(spoken("\u03b1 + \u03b2 = \u03b3") == "alpha plus beta equals gamma");
  CHECK(spoken("\u0394z, sin \u03b8, \u03c1") == "delta z, sin theta, rho");
  CHECK(spoken("T\u2084 T\u2081, \u00bd\u00b7n\u00b2") == "T sub 4 T sub 1, one half times n squared");
  for (unsigned code = 0x391; code <= 0x3c9; ++code) {
    if (code == 0x3a2 || (code > 0x3a9 && code < 0x3b1)) continue;  // no letters
    const std::string letter{static_cast<char>(0xc0u | code >> 6), static_cast<char>(0x80u | (code & 0x3fu))};
    CAPTURE(code);
    CHECK(spoken(letter).size() > 1);
    CHECK(unspeakable(spoken_formula("2\u00b7" + letter)).empty());
  }
  int signs = 0;
  for (const auto& file : std::filesystem::directory_iterator(test::in_checkout("lessons"))) {
    if (file.path().extension() != ".md") continue;
    std::ifstream text(file.path());
    for (std::string line; std::getline(text, line);) {
      std::string beyond;  // the signs alone, whatever the words beside them are
      for (const char c : line)
        if ((static_cast<unsigned char>(c) & 0x80u) != 0) beyond += c;
      const std::string said = spoken(beyond);
      CAPTURE(file.path().string());
      CAPTURE(line);
      CHECK(unspeakable(said).empty());
      signs += !beyond.empty();
    }
  }
  CHECK(signs > 100);
}

TEST_CASE("spoken: every sentence and formula of the golden traces, with every number, and nothing but words") {
  std::set<std::string> signs;
  int sentences = 0, formulas = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    Replay replay(trace);
    for (std::int64_t at = 1; at <= trace.size(); ++at) {
      replay.go_to(at);
      const Explanation told = explain(trace, replay.state(), trace.event(at));
      const std::string sentence = spoken(told.sentence);
      ++sentences;
      if (const std::string sign = unspeakable(sentence); !sign.empty() && signs.insert(sign).second)
        CHECK_MESSAGE(false, name, " ", at, ": ", told.sentence, " is read as ", sentence);
      REQUIRE(digits_of(sentence) == digits_of(told.sentence));
      for (const std::string& line : told.formulas) {
        const std::string formula = spoken_formula(line);
        ++formulas;
        if (const std::string sign = unspeakable(formula); !sign.empty() && signs.insert(sign).second)
          CHECK_MESSAGE(false, name, " ", at, ": ", line, " is read as ", formula);
        REQUIRE(digits_of(formula).size() >= digits_of(line).size());
      }
    }
  });
  CHECK(signs.empty());
  CHECK(sentences > 10'000);
  CHECK(formulas > 1'000);
}
