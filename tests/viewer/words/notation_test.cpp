#include "sim/words/notation.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "sim/words/owners.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/words/printed.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::test;
using words::Notation, words::read_notation;

namespace {

/// Shows what is what.
std::string shape(const Notation& part) {
  std::string text;
  switch (part.kind) {
    case Notation::Kind::text:
      return part.text;
    case Notation::Kind::number:
      return "#" + part.text;
    case Notation::Kind::symbol:
      return part.text + (part.below.empty() ? "" : "_{" + part.below + "}");
    case Notation::Kind::row:
      for (const Notation& inner : part.parts) text += shape(inner);
      return text;
    case Notation::Kind::fraction:
      return "{" + shape(part.parts.at(0)) + " over " + shape(part.parts.at(1)) + "}";
  }
  return text;
}

std::string shapes(const std::string& line) {
  std::string text;
  for (const Notation& side : read_notation(line)) text += (text.empty() ? "" : " = ") + shape(side);
  return text;
}

}  // namespace

TEST_CASE("notation: fractions, letters with what stands below them, numbers") {
  CHECK(shapes("z* = z*_L + (z*_R \u2212 z*_L)(x \u2212 x_L)/(x_R \u2212 x_L) = 0.5") ==
        "z* = z*_{L} + {(z*_{R} \u2212 z*_{L})(x \u2212 x_{L}) over x_{R} \u2212 x_{L}} = #0.5");
  CHECK(shapes("x = 12 + (\u22120.5)(4 \u2212 2)/(6 \u2212 (\u22122))") ==
        "x = #12 + {#(\u22120.5)(#4 \u2212 #2) over #6 \u2212 #(\u22122)}");
  CHECK(shapes("1/m") == "{#1 over m}");
  CHECK(shapes("\u2212(A\u00b7x + B\u00b7y + D)/C") == "\u2212{A\u00b7x + B\u00b7y + D over C}");
  CHECK(shapes("a/z/(1/z)") == "{{a over z} over {#1 over z}}");
  CHECK(shapes("k\u00b7dz/dx + dz*/dy") == "k\u00b7{dz over dx} + {dz* over dy}");
  CHECK(shapes("1/z_v_L") == "{#1 over z_{v_L}}");
  CHECK(shapes("a/b/c") == "{{a over b} over c}");
  CHECK(shapes("a\u00b7b/c\u00b7d") == "{a\u00b7b over c}\u00b7d");
  CHECK(shapes("\u2308x_L \u2212 1/2\u2309") == "\u2308x_{L} \u2212 {#1 over #2}\u2309");
  CHECK(shapes("zbuffer[x,y]: 0.7 < \u221e is true") == "zbuffer[x,y]: #0.7 < #\u221e is true");
  CHECK(shapes("frame[3,2] = colour of A") == "frame[3,2] = colour of A");
  CHECK(shapes("z of DEF") == "z of DEF");
  CHECK(shapes("V0\u00b7(V1 \u00d7 V2)") == "V0\u00b7(V1 \u00d7 V2)");
}

TEST_CASE("notation: what is no formula stays what it is") {
  for (const std::string line :
       {"", " = ", "(", ")(", "a / b", "/", "x_", "x_/2_", "[", "z[", "((((a)", "\u2212", "\u230ax)"}) {
    CAPTURE(line);
    std::string again;
    for (const Notation& side : read_notation(line)) again += (again.empty() ? "" : " = ") + on_one_line(side);
    if (line == " = ") again = " = ";  // two sides without anything
    if (line == "x_/2_") again = line;
    CHECK(again == line);
  }
  // A word's apostrophe and what stands behind it belong to it; a letter's is a prime.
  CHECK(on_one_line(read_notation("the light's z").front().parts[2]) == "light's");
  CHECK(on_one_line(read_notation("x'").front().parts[0]) == "x'");
  std::string open(100'000, '('), nested = open + "a" + std::string(100'000, ')');
  CHECK(read_notation(open).size() == 1);
  CHECK(read_notation(nested).size() == 1);
  CHECK(shapes("z of walls/north (the old one)") == "z of walls/north (the old one)");
  std::string divided = "1";
  for (int i = 0; i < 100'000; ++i) divided += "/1";
  CHECK(on_one_line(read_notation(divided).front()).size() >= divided.size());
}

TEST_CASE("notation: symbols and numbers of one formula are alike, others are not") {
  const auto sides = read_notation("z_L + k\u00b7(x \u2212 x_L) = 0.5 + (\u22122)\u00b7(3 \u2212 1.5) = 0.5 + 2");
  REQUIRE(sides.size() == 3);
  CHECK(alike(sides[0], sides[1]));
  CHECK_FALSE(alike(sides[1], sides[2]));
}

namespace {

/// What is whose, in the order of the line: "z_L:0 0.5:0".
void owned_in(const Notation& part, std::string& text) {
  if (part.polygon != no_polygon)
    text += (text.empty() ? "" : " ") + on_one_line(part) + ":" + std::to_string(part.polygon);
  else
    for (const Notation& inner : part.parts) owned_in(inner, text);
}
std::string owned_in(const std::string& line, const std::vector<words::Owned>& owned) {
  auto sides = read_notation(line);
  words::mark_owned(sides, owned);
  std::string text;
  for (const Notation& side : sides) owned_in(side, text);
  return text;
}

}  // namespace

TEST_CASE("notation: numbers belong to the polygon of their symbol") {
  CHECK(owned_in("z = z_L + (x \u2212 x_L) = 0.5 + (3 \u2212 2) = 1.5",
                 {{"z", 1}, {"z_L", 1}, {"x_L", 2}, {"x", -1}}) == "z:1 z_L:1 x_L:2 0.5:1 2:2 1.5:1");
  CHECK(owned_in("x_L = 3, x_R = 5", {{"x_L", 4}, {"x_R", 4}}) == "x_L:4 3:4 x_R:4 5:4");
  CHECK(owned_in("z < zbuffer[x,y]:  4 < 5  is true", {{"z", 0}, {"zbuffer[x,y]", 1}}) == "z:0 zbuffer[x,y]:1 4:0 5:1");
  CHECK(owned_in("z + dz/dx = 1 + 2", {{"z", 0}, {"dz/dx", 0}}) == "z:0 dz/dx:0 1:0 2:0");
  CHECK(owned_in("a = 3", {{"b", 1}}).empty());
  std::vector<words::Owned> both;
  for (const int polygon : {1, 2, 1}) words::add_owned(both, {"z", polygon});
  CHECK(both == std::vector<words::Owned>{{"z", no_polygon}});
}

TEST_CASE("law: a compare's numbers belong to the polygon at work and to the one that is stored, and no key is empty") {
  int compares = 0, planes = 0;
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Explanation said = explain(trace, replay.state(), *replay.current());
      const MethodState& machine = replay.state().machine;
      for (const words::Owned& one : said.owned) {
        CAPTURE(one.symbol);
        CHECK(one.polygon >= no_polygon);
        CHECK(one.polygon < static_cast<std::int32_t>(trace.scene().polygons.size()));
      }
      std::string marked;
      for (const std::string& line : said.formulas) marked += owned_in(line, said.owned);
      if (!words::owners_in(said.owned).empty()) CHECK_FALSE(marked.empty());
      const Event& event = replay.current()->event;
      if (get_if<DepthCompare>(&event) && machine.fragment && polygon_at_work(machine) != no_polygon) {
        const std::string stored = std::to_string(machine.fragment->stored_polygon);
        CHECK(marked.find(":" + std::to_string(polygon_at_work(machine))) != std::string::npos);
        if (machine.fragment->stored_polygon != no_polygon) CHECK(marked.find(":" + stored) != std::string::npos);
        ++compares;
      }
      if (const auto* depth = get_if<PlaneDepth>(&event)) {
        const std::int32_t polygon = machine.pieces[static_cast<std::size_t>(depth->piece)].polygon;
        CHECK(words::owners_in(said.owned) == std::vector<std::int32_t>{polygon});
        ++planes;
      }
    }
  });
  CHECK(compares > 100);
  CHECK(planes > 10);
}

TEST_CASE("law: what is set in type gives what is printed, and in symbols and numbers it is the same formula") {
  std::map<std::string, int> fractions;
  int numbers = 0;
  std::set<std::string> differ;  // names of what has other numbers than symbols
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      for (const std::string& line : explain(trace, replay.state(), *replay.current()).formulas) {
        CAPTURE(line);
        const auto sides = read_notation(line);
        const auto printed = parts(line, " = ");
        REQUIRE(sides.size() == printed.size());
        for (std::size_t at = 0; at < sides.size(); ++at) {
          const std::string set = on_one_line(sides[at]);
          fractions[name] += shape(sides[at]).find(" over ") != std::string::npos;
          const auto meant = read(printed[at]);
          if (!meant || !meant->computes) continue;
          const auto again = read(set);
          REQUIRE_MESSAGE(again, set);
          CHECK(again->value.low == doctest::Approx(meant->value.low));
          CHECK(again->value.high == doctest::Approx(meant->value.high));
          ++numbers;
          if (at > 1 && !alike(sides[at - 1], sides[at])) differ.insert(printed[0]);
        }
      }
    }
  });
  CHECK(numbers > 10'000);
  std::string names;
  for (const std::string& name : differ) names += name + ";";
  // Of a ray the sums above and below the line are told as they are, of a fan the products that are added up, of a
  // weight the edge function's value, of a tile the depths at its corners, of a share how many compares say lit, of the
  // middle of a mask how far it lies from the centre.
  CHECK(names == "nearest z;share;sum over the fan;t;w_0;w_1;w_2;z;");
  for (const char* name : {"scan-line", "ray-tracing", "transparency"}) CHECK_MESSAGE(fractions[name] > 0, name);
}
