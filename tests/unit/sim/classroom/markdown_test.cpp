#include "sim/classroom/markdown.hpp"

#include <doctest/doctest.h>

namespace zstep {
namespace {

using Kind = TextBlock::Kind;

TEST_CASE("a paragraph is a row of runs, soft breaks are spaces") {
  const auto blocks = parse_markdown("The **depth buffer** holds\n`zbuffer[x,y]` and *no* colour.");
  REQUIRE(blocks.size() == 1);
  CHECK(blocks[0].kind == Kind::paragraph);
  const std::vector<TextRun> expected{{"The ", false, false, false},    {"depth buffer", true, false, false},
                                      {" holds ", false, false, false}, {"zbuffer[x,y]", false, false, true},
                                      {" and ", false, false, false},   {"no", false, true, false},
                                      {" colour.", false, false, false}};
  CHECK(blocks[0].runs == expected);
}

TEST_CASE("lists are flat: items know their depth and their number") {
  const auto blocks = parse_markdown("3. three\n4. four\n   - inner\n\n   more of four\n\nafter");
  REQUIRE(blocks.size() == 5);
  CHECK(blocks[0].kind == Kind::item);
  CHECK(blocks[0].number == 3);
  CHECK(blocks[0].depth == 1);
  CHECK(blocks[1].number == 4);
  CHECK(blocks[2].kind == Kind::item);
  CHECK(blocks[2].depth == 2);
  CHECK(blocks[2].number == 0);
  CHECK(blocks[3].kind == Kind::paragraph);
  CHECK(blocks[3].depth == 1);
  CHECK(blocks[4].depth == 0);
  CHECK(plain_text(blocks) == "three\nfour\ninner\nmore of four\nafter");
}

TEST_CASE("a code block keeps its lines, and marks in it are text") {
  const auto blocks = parse_markdown("```\nx_L = 3 * **2**\n  z < ∞\n```\n");
  REQUIRE(blocks.size() == 1);
  CHECK(blocks[0].kind == Kind::code);
  REQUIRE(blocks[0].runs.size() == 1);
  CHECK(blocks[0].runs[0].code);
  CHECK(blocks[0].runs[0].text == "x_L = 3 * **2**\n  z < ∞");
}

TEST_CASE("the notation of the lectures is no markup") {
  CHECK(plain_text(parse_markdown("x_L = x_0 + (x_1 − x_0)(y − y_0)/(y_1 − y_0), z < 5 and 2 * 3 * 4")) ==
        "x_L = x_0 + (x_1 − x_0)(y − y_0)/(y_1 − y_0), z < 5 and 2 * 3 * 4");
}

TEST_CASE("headings, quotes, rules, entities, HTML and links") {
  const auto blocks =
      parse_markdown("## Ties\n\n> said\n\n---\n\na &lt; b &#955; &#x3c6; <b>[text](http://x.y)\nnext\\\nline");
  REQUIRE(blocks.size() == 4);
  CHECK(blocks[0].kind == Kind::heading);
  CHECK(blocks[0].level == 2);
  CHECK(blocks[1].kind == Kind::quote);
  CHECK(blocks[2].kind == Kind::rule);
  CHECK(plain_text({blocks[3]}) == "a < b λ φ <b>text next\nline");
}

TEST_CASE("entities are their characters, where they are known and do nothing") {
  CHECK(plain_text(parse_markdown("&#233; &#x2192; &#128512; &amp; &nbsp;")) == "\u00e9 \u2192 \U0001f600 & \u00a0");
  CHECK(plain_text(parse_markdown("&rarr; &#27;[31m &#x9b; &#x202E; &#; &#xfffffff;")) ==
        "&rarr; &#27;[31m &#x9b; &#x202E; &#; &#xfffffff;");
}

TEST_CASE("nothing, and what is not Markdown, is read without complaint") {
  CHECK(parse_markdown("").empty());
  CHECK(plain_text(parse_markdown("** ` [ ] ( ")) == "** ` [ ] (");
  CHECK(parse_markdown("```\nnever closed").size() == 1);
  CHECK(parse_markdown("- ").size() == 1);
  CHECK(parse_markdown("```\n```").size() == 1);
}

}  // namespace
}  // namespace zstep
