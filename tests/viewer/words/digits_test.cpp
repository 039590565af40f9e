// As many digits as tell something: more than usual only where two numbers would look alike without them, or where a
// whole number hangs on them; and what a fixed-point number cannot hold is said to be rounded.
#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "sim/words/derived.hpp"
#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/words/printed.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

std::string lesson_scene(const char* name) { return in_checkout(std::string("lessons/scenes/") + name); }

template <class Use>
void for_each_formula(const Trace& trace, Use&& use) {
  Replay replay(trace);
  while (replay.position() < trace.size()) {
    replay.step_forward();
    const std::int64_t step = replay.position();
    CAPTURE(step);
    const Explanation told = explain(trace, replay.state(), *replay.current());
    for (const std::string& line : told.formulas) {
      CAPTURE(line);
      use(replay.current()->event, line);
    }
  }
}

std::string rounded_to_usual(const std::string& text) { return number(number_of(text).value_or(0)); }

/// Written with more decimals than are usual, and no factor: those keep four digits that count.
bool is_long(const std::string& text) {
  const std::size_t point = text.find('.'), power = text.find('e');
  const double value = std::abs(number_of(text).value_or(0));
  return point != std::string::npos && power == std::string::npos && value >= 0.1 &&
         text.size() - point - 1 > static_cast<std::size_t>(usual_decimals);
}

/// Why each long number of a line is long; the first that has no reason, or nothing.
std::string without_reason(const std::string& line) {
  const auto numbers = numbers_in(line);
  const auto text_of = [&](std::size_t k) { return line.substr(numbers[k].first, numbers[k].second); };
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const std::string text = text_of(k);
    if (!is_long(text)) continue;
    const std::string before = line.substr(0, numbers[k].first);
    if (before.ends_with("\u230a") || before.ends_with("\u2308")) continue;
    bool told_apart = false;
    for (std::size_t other = 0; other < numbers.size(); ++other)
      told_apart = told_apart || (text_of(other) != text && rounded_to_usual(text_of(other)) == rounded_to_usual(text));
    if (!told_apart) return text;
  }
  return "";
}

}  // namespace

TEST_CASE("law: a number of a formula has the usual decimals, but where more of them tell something") {
  const auto check = [](const Trace& trace) {
    for_each_formula(trace, [](const Event&, const std::string& line) { REQUIRE(without_reason(line) == ""); });
  };
  check(record_run(lesson_scene("pyramid.toml")));
  for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    check(trace);
  });
}

TEST_CASE("what lies just beside a whole number looks so where it is made one, and only there") {
  const words::Shown x("x_L", 5.000000000000001);
  CHECK(ceil(x).numbers() == "\u23085.000000000000001\u2309");
  CHECK(floor(x).numbers() == "\u230a5.000000000000001\u230b");
  CHECK(ceil(words::Shown("x_L", 5)).numbers() == "\u23085\u2309");
  CHECK((x + words::Shown(25)).numbers() == "5 + 25");
}

TEST_CASE("law: in fixed-point numbers, too, a formula gives what is printed behind it, and what is rounded is told") {
  SceneFile file = load_scene(lesson_scene("ramp.toml"));
  file.conventions.number_format = NumberFormat::fixed16;
  file.conventions.interpolation = Conventions::Interpolation::increments;
  for (const auto rounding : {Conventions::Rounding::nearest, Conventions::Rounding::down}) {
    file.conventions.rounding = rounding;
    const bool nearest = rounding == Conventions::Rounding::nearest;
    const Method& z_buffer = method("z-buffer");
    TraceRecorder record(header_for(z_buffer, file.conventions), file.scene);
    z_buffer.record(file.scene, file.conventions, record);
    record.finish();
    int told = 0;
    for_each_formula(Trace::from_bytes(record.take_bytes(), "ramp"), [&](const Event&, const std::string& line) {
      const std::vector<std::string> sides = parts(line, " = ");
      if (sides.size() < 2) return;
      const std::vector<std::string> end = parts(sides.back(), nearest ? ", rounded to " : ", cut off to ");
      const auto formula = read(sides[sides.size() - 2]), result = read(end.front());
      if (end.size() == 2) {
        const auto is = number_of(end[1]), was = number_of(end[0]);
        REQUIRE((is && was));
        REQUIRE(*is == (nearest ? std::round(*was) : std::floor(*was)));
        ++told;
      }
      if (!formula || !formula->computes || !result) return;
      const bool meets = formula->value.low <= result->value.high && result->value.low <= formula->value.high;
      REQUIRE(meets);
    });
    CHECK(told > 0);
  }
}
