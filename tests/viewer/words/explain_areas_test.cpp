// What is said of Warnock's areas.
#include <string>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

Trace warnock_run(const std::string& scene_name, bool boxes) {
  SceneFile file = load_scene(scene_name);
  const Scene scene = look_at_scene(file.scene, {});
  if (boxes) file.conventions.options["boxes"] = "on";
  const Method& warnock = method("warnock");
  TraceRecorder record(header_for(warnock, file.conventions), scene);
  warnock.record(scene, file.conventions, record);
  record.finish();
  return Trace::from_bytes(record.take_bytes(), scene_name);
}

const std::string quarters = test::in_checkout("lessons/scenes/quarters.toml");

/// The explanation of the first event of the step with this name of which the condition holds.
template <class E, class Condition>
Explanation told_at(const Trace& trace, const std::string& step, Condition&& condition) {
  std::uint8_t id = 0;
  for (const StepInfo& info : trace.header().page)
    if (info.name == step) id = info.id;
  const auto position = trace.next(0, [&](const RecordedEvent& e) {
    const E* event = get_if<E>(&e.event);
    return e.step == id && event && condition(*event);
  });
  REQUIRE(position.has_value());
  Replay replay(trace);
  replay.go_to(*position);
  return explain(trace, replay.state(), *replay.current());
}

const auto any = [](const auto&) { return true; };

}  // namespace

TEST_CASE("areas are told by their columns and rows, and by the squares of their pixels") {
  const Trace trace = warnock_run(quarters, false);
  const Explanation whole = told_at<AreaBegin>(trace, "area", any);
  CHECK(whole.sentence == "The first area is the whole picture: columns 0 to 15, rows 0 to 15.");
  const Explanation pixel = told_at<AreaBegin>(trace, "area", [](const AreaBegin& e) { return e.area == 13; });
  CHECK(pixel.sentence == "Area 13 is a quarter of area 9: column 13, row 7.");
  CHECK(pixel.formulas.at(0).find("12.5 \u2264 x \u2264 13.5, 6.5 \u2264 y \u2264 7.5") != std::string::npos);
}

TEST_CASE("each bin has its sentence, and one for what the box knows and one for what was known") {
  const Trace trace = warnock_run(quarters, false), boxed = warnock_run(quarters, true);
  CHECK(told_at<AreaBin>(trace, "disjoint", any).sentence ==
        "No edge of A meets the area, and A is not around it: disjoint.");
  CHECK(told_at<AreaBin>(trace, "intersecting", any).sentence ==
        "An edge of B meets the area, and B goes on outside it: intersecting.");
  CHECK(told_at<AreaBin>(trace, "surrounding", any).sentence ==
        "No edge of B meets the area, and the area lies inside B: surrounding.");
  CHECK(told_at<AreaBin>(trace, "contained", any).sentence == "All edges of A lie in the area: contained.");
  CHECK(told_at<AreaBin>(trace, "surrounding", any).formulas.at(1) == "corners of the area inside B: 4");
  const Explanation box = told_at<AreaBin>(boxed, "disjoint", any);
  CHECK(box.sentence == "The box of A misses the area: A is disjoint, and its edges need no test.");
  CHECK(box.formulas.at(0) == "its box: x 12 to 15.2, y 1.2 to 7.4");
  const Explanation known =
      told_at<AreaBin>(warnock_run(test::in_checkout("tests/golden/clipping.toml"), false), "still_surrounding", any);
  CHECK(known.sentence.find("surrounds the area around this one") != std::string::npos);
}

TEST_CASE("each case is told with its number and who is in which bin") {
  const Trace trace = warnock_run(quarters, false);
  const auto sentence = [&](const char* step) { return told_at<AreaDecide>(trace, step, any).sentence; };
  CHECK(sentence("background").substr(0, 7) == "Case 1:");
  CHECK(sentence("one_polygon").substr(0, 15) == "Case 2: B alone");
  CHECK(sentence("surrounded").substr(0, 19) == "Case 3: B surrounds");
  CHECK(sentence("front_surrounder").substr(0, 19) == "Case 4: B surrounds");
  CHECK(sentence("subdivide") ==
        "None of the cases holds for area 0: it is quartered, and each quarter is settled by itself.");
  CHECK(sentence("pixel").find("A is the nearest at its centre") != std::string::npos);
  const Explanation none = told_at<AreaDecide>(trace, "pixel", [](const AreaDecide& e) { return e.piece == -1; });
  CHECK(none.sentence.find("No polygon covers its centre") != std::string::npos);
  const Explanation four = told_at<AreaDecide>(trace, "front_surrounder", any);
  CHECK(four.formulas.at(0) == "surrounding: B");
  CHECK(four.formulas.at(1) == "intersecting: none; contained: C");
}
