// The sentences of the floating horizon, on the run of its lesson.
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "tests/unit/sim/answers/altered_runs.hpp"
#include "tests/where.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

Trace horizon_run(const Scene& scene, Conventions conventions, const std::map<std::string, std::string>& options) {
  conventions.options = options;
  const Method& m = method("floating-horizon");
  TraceRecorder record(header_for(m, conventions), scene);
  m.record(scene, conventions, record);
  record.finish();
  return Trace::from_bytes(record.take_bytes(), "horizons");
}

Trace horizon_run(const std::map<std::string, std::string>& options = {}) {
  SceneFile file = load_scene(test::in_checkout("lessons/scenes/ridge-valley.toml"));
  return horizon_run(look_at_scene(std::move(file.scene), {}), file.conventions, options);
}

/// The explanation of the first event of a kind of which the condition holds.
template <class E, class Condition>
Explanation told(const Trace& trace, Condition&& condition) {
  const auto position = trace.next(0, [&](const RecordedEvent& recorded) {
    const E* event = get_if<E>(&recorded.event);
    return event && condition(*event);
  });
  REQUIRE(position.has_value());
  Replay replay(trace);
  replay.go_to(*position);
  return explain(trace, replay.state(), *replay.current());
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
bool formula(const Explanation& explanation, const std::string& part) {
  for (const std::string& line : explanation.formulas)
    if (has(line, part)) return true;
  return false;
}

}  // namespace

TEST_CASE("floating horizon: every event is told, and no formula disagrees with what was recorded") {
  for (const auto& options :
       {std::map<std::string, std::string>{}, {{"horizons", "one"}}, {{"across", "on"}, {"sides", "off"}}}) {
    const Trace trace = horizon_run(options);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Explanation explanation = explain(trace, replay.state(), *replay.current());
      CAPTURE(replay.position());
      CAPTURE(explanation.sentence);
      REQUIRE_FALSE(explanation.sentence.empty());
      REQUIRE(explanation.sentence.back() == '.');
      REQUIRE_MESSAGE(!explanation.doubt, explanation.doubt.value_or(""));
    }
  }
}

TEST_CASE("floating horizon: the tests of the lesson, in words and numbers") {
  const Trace trace = horizon_run();
  const auto at = [&](std::int32_t x, Horizon where) {
    return told<HorizonTest>(trace, [&](const HorizonTest& test) { return test.x == x && test.verdict == where; });
  };
  CHECK(at(2, Horizon::above).sentence == "No curve has passed column 2 yet: row 10.175 is visible.");
  CHECK(at(7, Horizon::hidden).sentence ==
        "On column 7 the curve, row 4.8, lies between the horizons, rows 4.2097 and 11.05: hidden.");
  CHECK(formula(at(7, Horizon::hidden), "y \u2264 upper[x]:  4.8 \u2264 4.2097  is false"));
  CHECK(formula(at(7, Horizon::hidden), "y \u2265 lower[x]:  4.8 \u2265 11.05  is false"));
  CHECK(has(at(18, Horizon::below).sentence, "is below the lower horizon"));
  CHECK(formula(at(18, Horizon::below), "is true"));
  const Explanation one = told<HorizonTest>(horizon_run({{"horizons", "one"}}), [](const HorizonTest& test) {
    return test.x == 18 && test.verdict == Horizon::hidden;
  });
  CHECK(has(one.sentence, "is not above the horizon"));
}

TEST_CASE("floating horizon: a curve on the lower horizon alone is visible, and called on it") {
  // Level curves, seen level: the second one below the first, the third at the same height as the second.
  ViewOptions level;
  level.theta = -90, level.phi = 90, level.rho = 20, level.window = 5;
  level.orthographic = true;
  level.width = 12, level.height = 9;
  SceneFile file = load_scene("y = 0");
  Scene scene = look_at_scene(std::move(file.scene), level);
  const auto columns = static_cast<std::size_t>(scene.surface->columns);
  for (std::size_t i = columns; i < scene.points.size(); ++i) scene.points[i].z = -1;
  const Trace trace = horizon_run(scene, file.conventions, {});
  int lower = 0;
  Replay replay(trace);
  for (std::int64_t position = 1; position <= trace.size(); ++position) {
    const auto* test = get_if<HorizonTest>(&trace.event(position).event);
    if (!test || test->verdict != Horizon::below) continue;
    replay.go_to(position);
    const Explanation explanation = explain(trace, replay.state(), *replay.current());
    CAPTURE(explanation.sentence);
    CHECK_FALSE(explanation.doubt);
    if (lower++ < scene.raster.width) continue;  // the second curve, which makes this horizon
    REQUIRE(has(explanation.sentence, "is on the lower horizon"));
    REQUIRE(has(explanation.sentence, "visible"));
    CHECK(formula(explanation, "lower[x]"));
    if (lower > 3 * scene.raster.width) break;
  }
  CHECK(lower > 2 * scene.raster.width);
}

TEST_CASE("floating horizon: a crossing is told with the distances on both sides of it") {
  const Trace trace = horizon_run();
  const Explanation in = told<HorizonCross>(trace, [](const HorizonCross&) { return true; });
  CHECK(in.sentence == "Between columns 6 and 7 the curve goes behind the upper horizon at (6.32, 4.681).");
  CHECK(formula(in, "d_0 = y \u2212 upper[6] = 4.625 \u2212 4.9028 = \u22120.2778"));
  CHECK(formula(in, "d_1 = y \u2212 upper[7] = 4.8 \u2212 4.2097 = 0.5903"));
  CHECK(formula(in, "= 6.32"));
  const Explanation out = told<HorizonCross>(trace, [](const HorizonCross& cross) { return cross.x_at > 10; });
  CHECK(has(out.sentence, "comes out at the upper horizon"));
}

TEST_CASE("floating horizon: what moves a horizon, and from where") {
  const Trace trace = horizon_run();
  const auto move = [&](std::int32_t x, bool upper, double below) {
    return told<HorizonMove>(trace,
                             [&](const HorizonMove& m) {
                               return m.x == x && m.upper == upper && m.y_curve < below && m.y_curve > -1e9;
                             })
        .sentence;
  };
  CHECK(has(told<HorizonMove>(trace, [](const HorizonMove&) { return true; }).sentence,
            "Nothing is drawn yet on column 0"));
  CHECK(move(2, true, 100) == "The upper horizon of column 2 begins at row 10.175.");
  CHECK(has(move(9, true, 10), "The upper horizon of column 9 rises from row 11.4 to row 3.7264."));
  CHECK(has(move(22, true, 100), "out to the side edge."));
  const Explanation side =
      told<CurveSegment>(trace, [](const CurveSegment& s) { return s.vertex_1 - s.vertex_0 == 8; });
  CHECK(has(side.sentence, "The surface goes on between its curves, here from sample 0 at"));
}

namespace {

/// Where a test's column got its horizon from; nothing where that is still the beginning's.
std::optional<std::int64_t> moved_before(const Trace& run, std::int64_t test, bool upper) {
  const std::int32_t x = get<HorizonTest>(run.event(test).event).x;
  return run.previous<HorizonMove>(test, [&](const HorizonMove& e) { return e.x == x && e.upper == upper; });
}

/// The run with a horizon that a test found moved to `entry`, and the verdict that follows.
std::optional<Trace> with_horizon(const Trace& right, std::int64_t test, bool upper, double entry) {
  const auto moved = moved_before(right, test, upper), other = moved_before(right, test, !upper);
  if (!moved || !other) return std::nullopt;
  const double beside = get<HorizonMove>(right.event(*other).event).y_curve;
  if (!std::isfinite(beside)) return std::nullopt;  // nothing was drawn there yet
  return test::changed(right, [&](std::int64_t step, Event& event) {
    if (step == *moved) get_if<HorizonMove>(&event)->y_curve = entry;
    if (step != test) return true;
    auto* e = get_if<HorizonTest>(&event);
    const double above = upper ? entry : beside, below = upper ? beside : entry;
    e->verdict = e->y_curve <= above ? Horizon::above : e->y_curve >= below ? Horizon::below : Horizon::hidden;
    return true;
  });
}

/// The numbers behind the word "row" or "rows", in their order.
std::vector<double> rows_in(const std::string& sentence) {
  std::vector<double> rows;
  for (const auto& [at, size] : numbers_in(sentence)) {
    const std::string before = sentence.substr(0, at), number = sentence.substr(at, size);
    if (!before.ends_with("row ") && !before.ends_with("rows ") && !(rows.size() == 2 && before.ends_with(" and ")))
      continue;
    const std::string minus = "\u2212";
    rows.push_back(number.starts_with(minus) ? -std::stod(number.substr(minus.size())) : std::stod(number));
  }
  return rows;
}

}  // namespace

TEST_CASE("law: however near a curve comes to a horizon, the sentence has rows of which it is true") {
  const Trace right = horizon_run();
  int sentences = 0, between = 0;
  const auto any = [](const auto&) { return true; };
  for (auto step = right.next<HorizonTest>(0, any); step; step = right.next<HorizonTest>(*step, any)) {
    const double y = get<HorizonTest>(right.event(*step).event).y_curve;
    for (const bool upper : {true, false})
      for (int digits = 2; digits <= 12; digits += 2)
        for (const double sign : {-1.0, 0.0, 1.0}) {
          const double entry = y + sign * std::pow(10.0, -digits);
          const auto wrong = with_horizon(right, *step, upper, entry);
          if (!wrong) continue;
          Replay replay(*wrong);
          replay.go_to(*step);
          const std::string sentence = explain(*wrong, replay.state(), *replay.current()).sentence;
          CAPTURE(sentence);
          CAPTURE(entry);
          const std::vector<double> rows = rows_in(sentence);
          REQUIRE(rows.size() >= 2);
          ++sentences;
          if (has(sentence, "above the upper")) CHECK(rows[0] < rows[1]);
          else if (has(sentence, "below the lower")) CHECK(rows[0] > rows[1]);
          else if (has(sentence, "is on the")) CHECK(rows[0] == rows[1]);
          else if (has(sentence, "between")) {
            REQUIRE(rows.size() == 3);
            ++between;
            CHECK(rows[1] < rows[0]);
            CHECK(rows[0] < rows[2]);
          }
        }
  }
  CHECK(sentences > 200);
  CHECK(between > 20);
}
