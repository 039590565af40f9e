#include "sim/classroom/anchor.hpp"

#include "tests/unit/sim/classroom/small_run.hpp"

namespace zstep::classroom {
namespace {

struct Small {
  Trace trace = small_run();
  Replay replay{trace};

  Spot spot(std::string_view text, Spot previous = {}) {
    const Anchor anchor = parse_anchor(text, "t.md:9");
    check_anchor(anchor, trace.header().page, "t.md:9");
    return resolve_anchor(anchor, previous, replay, "t.md:9");
  }
  std::int64_t at(std::string_view text, Spot previous = {}) { return spot(text, previous).position; }
  std::string error(std::string_view text, Spot previous = {}) {
    return complaint([&] { spot(text, previous); });
  }
};

TEST_CASE("a stop stands after its step, or before it") {
  Small small;
  CHECK(small.at("at: compare") == 4);
  CHECK(small.at("before: compare") == 3);
  CHECK(small.spot("before: compare").event == 4);
  CHECK(small.at("at: z_buffer.compare where not nearer, first") == 13);
  CHECK(small.at("at: compare where not nearer and z > stored") == 19);
  CHECK(small.at("at: start") == 0);
  CHECK(small.at("at: end", {4, 4}) == 19);
  CHECK(small.at("at: here", {4, 4}) == 4);
}

TEST_CASE("which one: next is from the stop before, first, last and nth from the beginning") {
  Small small;
  CHECK(small.at("at: compare", {4, 4}) == 8);
  CHECK(small.at("at: compare, next", {5, 0}) == 8);
  CHECK(small.at("at: compare, last") == 19);
  CHECK(small.at("at: compare, nth 3") == 13);
  CHECK(small.at("at: compare where nearer, nth 3") == 15);
  CHECK(small.at("before: compare, last") == 18);
}

TEST_CASE("before and then at mean the same step, before and again before mean two") {
  Small small;
  const Spot predicted = small.spot("before: compare");
  CHECK(small.spot("at: compare", predicted).event == predicted.event);
  CHECK(small.spot("before: compare", predicted).event == 8);
}

TEST_CASE("what never happens is told, with how often it nearly did") {
  Small small;
  CHECK(small.error("at: retire_edge") ==
        "t.md:9: `retire_edge` never happens in this run; choose another step, or a scene in which it does");
  CHECK(contains(small.error("at: compare where x == 3"), "`compare` happens 5 times, but its condition never holds"));
  CHECK(contains(small.error("at: compare", {19, 19}),
                 "happens as described 5 times, but not after the stop before this one"));
  CHECK(contains(small.error("at: compare where nearer, nth 4"), "happens as described 3 times, but not 4 times"));
  CHECK(
      contains(small.error("at: compare, first", {9, 9}), "comes before that of the stop before it (step 4, after 9)"));
  CHECK(contains(small.error("at: start", {9, 9}), "`start` comes after another stop"));
}

TEST_CASE("anchors that cannot be read") {
  Small small;
  CHECK(
      contains(small.error("at: comparr"), "no step named `comparr` (did you mean `compare`?); its steps are clear, "));
  CHECK(contains(small.error("at: warnock.split"), "no step named `warnock.split`"));
  CHECK(contains(small.error("compare"), "is no anchor"));
  CHECK(contains(small.error("at:"), "names no step"));
  CHECK(contains(small.error("at: 12041"), "names no step"));
  CHECK(contains(small.error("at: compare nearer"), "`nearer` is left over"));
  CHECK(contains(small.error("at: compare, thrid"), "does not say which one"));
  CHECK(contains(small.error("at: compare, nth"), "does not say which one"));
  CHECK(contains(small.error("at: compare, nth 0"), "does not say which one"));
  CHECK(contains(small.error("at: compare where z"), "is no truth"));
  CHECK(contains(small.error("at: end, last"), "stands alone"));
  CHECK(contains(small.error("before: start"), "stands alone"));
}

}  // namespace
}  // namespace zstep::classroom
