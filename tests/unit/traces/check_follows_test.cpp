// zstep check: numbers that follow from what is not at hand in the step itself. One of them is changed, and named.
#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/check.hpp"

using namespace zstep;

namespace {

/// In each golden trace, changes the field of the first steps of which `may(event)` is true, one at a time. How often
/// `check` finds it wrong in that step, and how often it was changed.
template <class E, class May, class Change>
std::pair<int, int> found(const std::string& field, May&& may, Change&& change) {
  constexpr int most_a_trace = 12;
  int named = 0, changed = 0;
  test::for_each_golden([&](const std::string& golden, const Trace& right) {
    int made = 0;
    for (std::int64_t at = 0; made < most_a_trace;) {
      const auto step = right.next<E>(at, [&](const E& e) { return may(e); });
      if (!step) break;
      at = *step;
      ++made, ++changed;
      const Trace wrong = test::changed(right, [&](std::int64_t number, Event& event) {
        if (number == *step) change(*get_if<E>(&event));
        return true;
      });
      const CheckReport report = check(wrong);
      const bool names = std::any_of(report.causes.begin(), report.causes.end(), [&](const Cause& cause) {
        return cause.first.step == *step && cause.first.field == field;
      });
      named += names;
      if (!names) MESSAGE(golden, ": ", field, " of step ", *step, " goes unnoticed");
    }
  });
  return {named, changed};
}

constexpr auto any = [](const auto&) { return true; };
/// From 0 to 1, and still so after it is changed.
double moved(double t) { return t < 0.5 ? t + 0.01 : t - 0.01; }

TEST_CASE("check: the direction of a mirrored or transmitted ray follows from the ray before it and the face") {
  for (const RayRole role : {RayRole::reflected, RayRole::transmitted}) {
    const auto [named, changed] = found<RayBegin>(
        "dir_x", [&](const RayBegin& e) { return e.role == role; }, [](RayBegin& e) { e.dir_x += 0.001; });
    CHECK(changed > 0);
    CHECK(named == changed);
  }
}

TEST_CASE("check: where an edge is cut, and where a line is crossed and hidden, follows from planes and outlines") {
  const auto cut = found<SplitVertex>("t", any, [](SplitVertex& e) { e.t = moved(e.t); });
  CHECK(cut.second > 10);
  CHECK(cut.first == cut.second);
  const auto crossed = found<LineCross>("t", any, [](LineCross& e) { e.t = moved(e.t); });
  CHECK(crossed.second > 10);
  CHECK(crossed.first == crossed.second);
  const auto begins = found<LineHide>("t_0", any, [](LineHide& e) { e.t_0 = moved(e.t_0); });
  CHECK(begins.second > 10);
  CHECK(begins.first == begins.second);
  const auto ends = found<LineHide>("t_1", any, [](LineHide& e) { e.t_1 = moved(e.t_1); });
  CHECK(ends.first == ends.second);
}

TEST_CASE("check: a part of a line ends where something begins or ends to hide it") {
  const auto cut = [](const LinePiece& e) { return e.t_1 < 1; };
  const auto [named, changed] = found<LinePiece>("t_1", cut, [](LinePiece& e) { e.t_1 = moved(e.t_1); });
  CHECK(changed > 10);
  CHECK(named == changed);
}

TEST_CASE("check: a colour in shadow, and the light that a ray brings back, follow from what was met") {
  int named = 0, changed = 0;
  test::for_each_golden([&](const std::string& golden, const Trace& right) {
    if (golden.find("shadow") == std::string::npos || right.has(kind_of<LightShare>)) return;
    for (const int more : {-2, 60}) {
      const auto step = right.next<ColorWrite>(0, [](const ColorWrite& e) { return e.r8 > 2 && e.g8 > 2; });
      REQUIRE(step);
      ++changed;
      const Trace wrong = test::changed(right, [&](std::int64_t number, Event& event) {
        if (number == *step) get_if<ColorWrite>(&event)->r8 += more;
        return true;
      });
      const CheckReport report = check(wrong);
      named += !report.causes.empty() && report.causes[0].first.step == *step;
    }
  });
  CHECK(changed > 0);
  CHECK(named == changed);
  const auto sent = [](const RayEnd& e) { return e.t < 1e9 && e.red > 0 && e.red < 1 && e.green > 0; };
  const auto back = found<RayEnd>("red", sent, [](RayEnd& e) { e.red += 0.001; });
  CHECK(back.second > 10);
  CHECK(back.first == back.second);
}

TEST_CASE("check: how dark a shadow is may be another program's own, but not another in each channel") {
  test::for_each_golden([&](const std::string& golden, const Trace& right) {
    if (golden.find("shadow") == std::string::npos || right.has(kind_of<LightShare>)) return;
    const auto darkened = [&](double red, double others) {
      return test::changed(right, [&](std::int64_t, Event& event) {
        auto* write = get_if<ColorWrite>(&event);
        if (!write) return true;
        const auto dark = [](std::int32_t shade, double factor) {
          return static_cast<std::int32_t>(std::lround(shade / 0.4 * factor));
        };
        write->r8 = dark(write->r8, red), write->g8 = dark(write->g8, others), write->b8 = dark(write->b8, others);
        return true;
      });
    };
    CHECK(check(darkened(0.7, 0.7)).causes.empty());
    CHECK_FALSE(check(darkened(0.7, 0.3)).causes.empty());
  });
}

TEST_CASE("check: an attribute of points on the screen is divided by the 1/z that the program has") {
  const Scene scene = load_scene("delhi").scene;
  Conventions conventions;
  conventions.attribute = Conventions::Attribute::perspective;
  const auto judged = [&](const char* attribute) {
    return check(test::trace_of(test::head("z-buffer", scene, conventions) + R"({"step":"polygon","polygon":0,"facet":0}
{"step":"compare","x":2,"y":4,"z":5,"nearer":true}
{"step":"attribute","x":2,"y":4,"over_z":2.25,"one_over_z":1.25,"attribute":)" +
                                attribute + "}\n"));
  };
  CHECK(judged("1.8").causes.empty());
  REQUIRE(judged("2.25").causes.size() == 1);
  CHECK(judged("2.25").causes[0].first.field == "attribute");
  CHECK(judged("2.25").causes[0].first.expected == doctest::Approx(1.8));
}

}  // namespace
