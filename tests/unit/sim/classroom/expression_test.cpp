#include "sim/classroom/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/unit/sim/classroom/small_run.hpp"
#include "tests/where.hpp"

namespace zstep::classroom {
namespace {

struct Small {
  Trace trace = small_run();
  Replay replay{trace};

  Quantity at(std::int64_t position, std::string_view text) {
    const Expression expression = parse_expression(text, "t.md:7");
    const RecordedEvent event = trace.event(position);
    std::uint8_t kind = no_kind;
    for (const StepInfo& step : trace.header().page) {
      if (step.id == event.step) kind = step.kind;
    }
    check(expression, kind, trace.header().page, "t.md:7");
    return evaluate(expression, Moment(replay, &event, position, "t.md:7"));
  }
  double number(std::int64_t position, std::string_view text) { return at(position, text).number; }
  std::string error(std::int64_t position, std::string_view text) {
    return complaint([&] { at(position, text); });
  }
};

TEST_CASE("arithmetic binds as on paper") {
  Small small;
  CHECK(small.number(1, "1 + 2*3 - 4/8") == 6.5);
  CHECK(small.number(1, "(1 + 2)*3") == 9);
  CHECK(small.number(1, "-2 - -3") == 1);
  CHECK(small.number(1, "2 − 3 · 2") == -4);
  CHECK(small.number(1, "√9/2") == 1.5);
  CHECK(small.number(1, "4.125") == 4.125);
  CHECK(small.number(1, "0.1") == 0.1);
  CHECK(small.number(1, "1 - 2 - 3") == -4);
  CHECK(small.number(1, "∞") == std::numeric_limits<double>::infinity());
  CHECK(small.number(1, "max(2, ceil(2.25))") == 3);
  CHECK(small.number(1, "cos(60)") == doctest::Approx(0.5));
  CHECK(small.number(1, "⌈2.25⌉ - ⌊2.75⌋") == 1);
  CHECK(small.error(1, "⌊2.75 == 2").find("`⌊` is not closed at the end") != std::string::npos);
}

TEST_CASE("a program's numbers are read to their last digit") {
  CHECK(parse_formula("0.1234567890123456789e-10", "f").number == 0.1234567890123456789e-10);
  CHECK(parse_formula("12345678901234567000", "f").number == 12345678901234567000.0);
  CHECK(parse_formula("a - 1e-9*b", "f").parts[1].parts[0].number == 1e-9);
}

TEST_CASE("comparisons, and, or, not: `and` binds closer than `or`, `not` closest") {
  Small small;
  CHECK(small.number(1, "1 < 2 and 2 < 1 or 3 >= 3") == 1);
  CHECK(small.number(1, "3 >= 3 or 1 < 2 and 2 < 1") == 1);
  CHECK(small.number(1, "not 1 < 2 or 1 == 1") == 1);
  CHECK(small.number(1, "not (1 < 2 or 1 == 1)") == 0);
  CHECK(small.number(1, "2 ≠ 3 and 2 ≤ 2 and 2 != 3 and 2 <= 2 and 2 > 1") == 1);
  CHECK(small.number(1, "0.1 + 0.2 == 0.3") == 1);
  CHECK(small.number(1, "infinity == infinity") == 1);
  CHECK(small.number(1, "5 == infinity or -infinity == infinity") == 0);
}

TEST_CASE("names are the step's fields first, then what the run knows") {
  Small small;
  CHECK(small.number(4, "x == 0 and y == 0 and z == 5 and nearer") == 1);
  CHECK(small.number(4, "stored") == std::numeric_limits<double>::infinity());
  CHECK(small.number(13, "stored") == 5);
  CHECK(small.at(13, "stored_polygon").type == Quantity::Type::polygon);
  CHECK(small.number(13, "stored_polygon == \"A\" and polygon == \"B\"") == 1);
  CHECK(small.number(16, "z") == 7);
  CHECK(small.number(16, "nearer") == 1);
  CHECK(small.number(16, "depth(2, 0)") == 7);
  CHECK(small.number(15, "depth(2, 0)") == std::numeric_limits<double>::infinity());
  CHECK(small.number(16, "frame(2, 0) == -1") == 1);
  CHECK(small.number(17, "frame(2, 0) == \"B\"") == 1);
  CHECK(small.number(17, "width*height") == 4);
  CHECK(small.number(17, "x_s(2)") == 2);
  CHECK(small.number(17, "corner(0)") == 2);
}

TEST_CASE("counts go over the whole run, from wherever they are asked") {
  Small small;
  CHECK(small.number(3, "count(compare)") == 5);
  CHECK(small.number(3, "count(compare where not nearer)") == 2);
  CHECK(small.number(3, "count(z_buffer.compare where nearer and polygon == \"B\")") == 1);
  CHECK(small.number(3, "count(compare where z < stored and stored < infinity)") == 0);
  CHECK(small.number(3, "count(retire_edge)") == 0);
}

TEST_CASE("slips are told with the line and the mend") {
  Small small;
  CHECK(small.error(1, "1 +") ==
        "t.md:7: a number or a name is missing at the end in `1 +`; write `x == 3`, `not nearer`, `z < stored` …");
  CHECK(contains(small.error(4, "(z < 4"), "`(` is not closed"));
  CHECK(contains(small.error(4, "z = 4"), "`= 4` is left over"));
  CHECK(contains(small.error(4, "neerer"), "did you mean `nearer`?"));
  CHECK(contains(small.error(4, "neerer"), "this step has x, y, z, nearer"));
  CHECK(contains(small.error(4, "dept(1, 0) == 3"), "did you mean `depth`?"));
  CHECK(contains(small.error(4, "depth(1)"), "given 1 arguments; write depth(x, y)"));
  CHECK(contains(small.error(4, "depth(1, 0, 0)"), "given 3 arguments; write depth(x, y)"));
  CHECK(contains(small.error(4, "depth(4, 0)"), "there is no column 4; they run from 0 to 3"));
  CHECK(contains(small.error(4, "depth(0.5, 0)"), "there is no column 0.5"));
  CHECK(contains(small.error(4, "x_s(3)"), "there is no vertex 3"));
  CHECK(contains(small.error(4, "T_v(0, 1)"), "they run from 1 to 4"));
  CHECK(contains(small.error(4, "count(cmpare)"), "did you mean `compare`?"));
  CHECK(contains(small.error(4, "count(compare where 3)"), "need a truth"));
  CHECK(contains(small.error(4, "polygon == \"Z\""), "the scene has no polygon named \"Z\"; its polygons are A, B"));
  CHECK(contains(small.error(2, "stored"), "there is no pixel at work at this step"));
  CHECK(contains(small.error(4, "x_left"), "there is no span at this step"));
  CHECK(contains(small.error(4, "nearer + 1"), "a number is needed"));
  CHECK(contains(small.error(4, "z and nearer"), "need a truth"));
  CHECK(contains(small.error(4, "nearer == 3"), "unlike things"));
  CHECK(contains(small.error(4, "\"A"), "a quote is not closed"));
  CHECK(contains(small.error(4, std::string(2000, '(')), "64 deep"));
  CHECK(contains(small.error(4, std::string(2000, '-')), "64 deep"));
  CHECK(contains(small.error(4, "12345678901234567890"), "cannot be read exactly"));
}

TEST_CASE("numbers are the same to nine digits, and to nine places below 1") {
  for (const double size : {1.0, -4.0, 3e7, 2e-5}) {
    const double off = 1e-9 * std::max(1.0, std::abs(size));
    CHECK(same_number(size, size + 0.9 * off));
    CHECK_FALSE(same_number(size, size + 1.2 * off));
    CHECK_FALSE(same_number(size - 1.2 * off, size));
  }
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(same_number(infinity, infinity));
  CHECK_FALSE(same_number(infinity, -infinity));
  CHECK_FALSE(same_number(infinity, 1e300));
  CHECK_FALSE(same_number(std::nan(""), std::nan("")));
}

TEST_CASE("a word of an enumeration is known by the field it is compared with") {
  const Page page = z_buffer::page();
  const auto error = [&](std::string_view text, std::uint8_t kind) {
    return complaint([&] { check(parse_expression(text, "t.md:1"), kind, page, "t.md:1"); });
  };
  CHECK(error("facing == back", kind_of<FacingTest>).empty());
  CHECK(error("plane == near and inside", kind_of<ClipVertex>).empty());
  CHECK(error("reason != back_facing", kind_of<PolygonReject>).empty());
  CHECK(contains(error("facing == bakc", kind_of<FacingTest>),
                 "`facing` is never `bakc`; it is one of front, back, edge_on"));
  CHECK(contains(error("facing == 1", kind_of<FacingTest>), "`facing` is never `that`"));
}

TEST_CASE("an expression has an end") {
  const auto error = [](const std::string& text) { return complaint([&] { parse_expression(text, "t.md:1"); }); };
  const auto many = [](const std::string& first, const std::string& more, int times) {
    std::string text = first;
    for (int i = 0; i < times; ++i) text += more;
    return text;
  };
  CHECK(error(many("1", "+1", 499)).empty());
  for (const char* more : {"+1", "*x", " and x", " or \"a\"", "-z(1)"}) {
    CAPTURE(more);
    const std::string said = error(many("x", more, 100000));
    CHECK(contains(said, "t.md:1: there are more than 1000 numbers, names and signs"));
    CHECK(said.size() < 400);
  }
  CHECK(contains(error(many("f(1", ",1", 100000)), "t.md:1: there are more than 1000"));
}

TEST_CASE("docs/writing-a-lesson.md knows every name") {
  std::ifstream file(test::in_checkout("docs/writing-a-lesson.md"));
  std::stringstream docs;
  docs << file.rdbuf();
  const auto listed = [&](std::string_view name) {
    for (const char after : {'`', '(', ' '}) {
      if (contains(docs.str(), std::string(name) + after)) return true;
    }
    return false;
  };
  for (const KnownName& known : known_names()) CHECK_MESSAGE(listed(known.name), known.name);
  for (const KnownFunction& known : known_functions()) CHECK_MESSAGE(listed(known.name), known.name);
}

}  // namespace
}  // namespace zstep::classroom
