#include "sim/classroom/fill.hpp"

#include "tests/unit/sim/classroom/small_run.hpp"

namespace zstep::classroom {
namespace {

struct Small {
  Trace trace = small_run();
  Replay replay{trace};

  std::string at(std::int64_t position, std::string_view text) {
    const RecordedEvent event = trace.event(position);
    check_fill(text, {"t.md", 20}, static_cast<std::uint8_t>(event.event.index()), trace.header().page);
    return fill(text, {"t.md", 20}, replay, &event, position);
  }
  std::string error(std::int64_t position, std::string_view text) {
    return complaint([&] { at(position, text); });
  }
};

TEST_CASE("braces are filled with what the trace has") {
  Small small;
  CHECK(small.at(13, "At ({x}, {y}) {z} meets {stored}: {nearer}.") == "At (1, 0) 5 meets 5: false.");
  CHECK(small.at(4, "{stored}, {-stored}") == "∞, −∞");
  CHECK(small.at(13, "{polygon} behind {stored_polygon}, {frame(3, 0)}") == "B behind A, background");
  CHECK(small.at(13, "{z/3} {z/3:2} {-z:1} {z:0} {z/1000000}") == "1.6667 1.67 −5.0 5 0");
  CHECK(small.at(13, "no braces; {{doubled}} ones") == "no braces; {doubled} ones");
}

TEST_CASE("what the author writes after = or ~ is shown as written, and must hold") {
  Small small;
  CHECK(small.at(13, "{z = 5} {z = 5.0} {z/3 = 5/3} {z ~ 5.00} {z/3 ~ 1.667} {z/3 ≈ 1.7}") ==
        "5 5.0 5/3 5.00 1.667 1.7");
  CHECK(small.at(4, "{stored = ∞} {stored = infinity} {-z = -5}") == "∞ ∞ −5");
  CHECK(small.at(13, "{polygon = B} {nearer = false} {√(z + 4)/2 = 3/2}") == "B false 3/2");
  CHECK(small.error(13, "fine\n{z = 6}") ==
        "t.md:21: `{z = 6}` does not hold: it is 5 here; write what the run gives, or attach the stop elsewhere");
  CHECK(contains(small.error(13, "{z/3 ~ 1.66}"), "it is 1.666666667 here"));
  CHECK(contains(small.error(13, "{polygon = A}"), "it is B here"));
  CHECK(contains(small.error(13, "{nearer = true}"), "it is false here"));
  CHECK(contains(small.error(13, "{z = stored}"), "no number that a reader can be shown"));
}

TEST_CASE("what stands alone in braces is known by its name") {
  CHECK(names_in("{z ~ 0.7} < {stored}, {x + 1}, {\"8x8\"}, {polygon = A}", {"t.md", 20}) ==
        std::vector<std::string>{"z", "stored", "polygon"});
  CHECK(names_in("no braces", {"t.md", 20}).empty());
}

TEST_CASE("braces that cannot be read") {
  Small small;
  CHECK(contains(small.error(13, "a {z"), "t.md:20: a `{` is not closed on its line"));
  CHECK(contains(small.error(13, "a {z\n}"), "is not closed on its line"));
  CHECK(contains(small.error(13, "one\ntwo\na z}"), "t.md:22: a `}` without its `{`"));
  CHECK(contains(small.error(13, "{}"), "a number or a name is missing"));
  CHECK(contains(small.error(13, "{z:}"), "cannot be read"));
  CHECK(contains(small.error(13, "{z:x}"), "no number of decimals"));
  CHECK(contains(small.error(13, "{z ! 3}"), "cannot be read"));
  CHECK(contains(small.error(13, "{zz}"), "nothing is called `zz`"));
  CHECK(contains(small.error(13, "{z ~ 1/3}"), "is no decimal"));
}

TEST_CASE("a digit stands in checked braces, in code, in a name, or in quotes") {
  Small small;
  CHECK(small.at(13, "{\"8x8\"} and { \"3-4-5\" } and {\"−2*x\"}, pixel {\"(0, 2)\"}") ==
        "8x8 and 3-4-5 and −2*x, pixel (0, 2)");
  const std::string marked =
      "T_1 of V01, z2 and θ2 in `z - 3`, [the page](page7.md)\n\n1. one\n2. two\n\n```\nfor x = 1 to 9\n```";
  CHECK(small.at(13, marked) == marked);
  CHECK(small.error(13, "Edge {x} and\nso edge 10, not {z = 5}.") ==
        "t.md:21: `10` stands outside braces, where nothing checks it; write {… = 10} with what it is a number of, or "
        "{\"10\"} for a word or a name");
  CHECK(contains(small.error(13, "squares, 8x8."),
                 "`8x8` stands outside braces, where nothing checks it; write {… = 8} "));
  CHECK(contains(small.error(13, "a 3-4-5."), "{\"3-4-5\"} for a word or a name"));
  for (const char* literal : {"−5", "×2", "√3", "(1", "**2**", "*2*", "a 2", "x^2", "∞2", "z=2", "{z = 5}2", "`z`2",
                              "\"2\"", "- 2", "> 2", "[2](page.md)", "T_{x}2"})
    CHECK_MESSAGE(contains(small.error(13, literal), "stands outside braces"), literal);
  // A number in braces says no more than one outside, as long as nothing checks it.
  CHECK(
      small.error(13, "{33}") ==
      "t.md:20: `{33}` is a number that nothing checks; write {… = 33} with what it is a number of, or {\"33\"} for a "
      "word or a name");
  for (const char* literal : {"{-1/3}", "{√3:2}", "{(1)}"})
    CHECK_MESSAGE(contains(small.error(13, literal), "nothing checks"), literal);
  CHECK(small.at(13, "{1 + 2 = 3} {2*z = 10}") == "3 10");
}

TEST_CASE("just before a pixel is interpolated, the stored depth is the coming pixel's") {
  Small small;
  const RecordedEvent coming = small.trace.event(18);
  CHECK(fill("{x} {stored} {stored_polygon}", {"t.md", 1}, small.replay, &coming, 17) == "0 5 A");
}

}  // namespace
}  // namespace zstep::classroom
