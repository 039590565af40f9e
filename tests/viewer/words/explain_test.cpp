#include "sim/words/explain.hpp"

#include <set>
#include <string>

#include <doctest/doctest.h>

#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// The explanation of the first event of this kind that satisfies the condition.
template <class E, class Condition>
Explanation first_of(const Trace& trace, Condition&& condition) {
  const auto position = trace.next(0, [&](const RecordedEvent& recorded) {
    const E* event = get_if<E>(&recorded.event);
    return event && condition(*event);
  });
  REQUIRE(position.has_value());
  Replay replay(trace);
  replay.go_to(*position);
  return explain(trace, replay.state(), *replay.current());
}

bool any_formula(const Explanation& told, const std::string& part) {
  for (const std::string& formula : told.formulas)
    if (formula.find(part) != std::string::npos) return true;
  return false;
}

void every_event_is_told(const Trace& trace) {
  Replay replay(trace);
  std::set<std::size_t> kinds;
  while (replay.position() < trace.size()) {
    replay.step_forward();
    const Explanation told = explain(trace, replay.state(), *replay.current());
    const auto position = replay.position();
    CAPTURE(position);
    REQUIRE_FALSE(told.sentence.empty());
    REQUIRE(told.sentence.back() == '.');
    // The run is honest, so each formula must give the number that was recorded.
    REQUIRE_MESSAGE(!told.doubt, told.doubt.value_or(""));
    kinds.insert(replay.current()->event.index());
  }
  CHECK(kinds.size() > 10);
}

}  // namespace

TEST_CASE("glass that is nearer does not take the pixel: it is seen through") {
  const Trace trace = test::record_run_by("transparency", test::in_checkout("lessons/scenes/panes.toml"));
  const Explanation glass =
      first_of<DepthCompare>(trace, [](const DepthCompare& compare) { return compare.nearer && compare.z == 5.25; });
  CHECK(glass.sentence.find("becomes G") == std::string::npos);
  CHECK(glass.sentence.find("of opacity 0.5") != std::string::npos);
  CHECK(any_formula(glass, "5.25 < 8"));
}

TEST_CASE("every event of real runs has a sentence, and its formula gives the recorded number") {
  for (const char* scene : {"delhi", "foley", "pyramid", "pyramid-behind"})
    for (const auto interpolation : {Conventions::Interpolation::direct, Conventions::Interpolation::increments}) {
      CAPTURE(scene);
      every_event_is_told(test::record_run(scene, {}, interpolation));
    }
}

TEST_CASE("every event of a clipped run is told: the eye is inside the mesh") {
  ViewOptions view = test::of_size(24, 24);
  view.rho = 1.2;
  view.near = 0.3;
  view.far = 9;
  every_event_is_told(test::record_run("pyramid", view));
}

TEST_CASE("x–y interpolation is shown with its numbers: the left edge of Foley's polygon") {
  const Trace trace = test::record_run("foley");
  const Explanation told = first_of<EdgeStep>(trace, [](const EdgeStep&) { return true; });
  CHECK(any_formula(told, "x = x_0 + (x_1 \u2212 x_0)(y \u2212 y_0)/(y_1 \u2212 y_0) = "));
  CHECK(told.values.size() == 2);
}

TEST_CASE("increments are shown as increments") {
  const Trace trace = test::record_run("foley", {}, Conventions::Interpolation::increments);
  CHECK(any_formula(first_of<EdgeStep>(trace, [](const EdgeStep&) { return true; }), "x = x + 1/m = "));
}

TEST_CASE("the tie of the 8x8 example says that the first polygon stays") {
  const Trace trace = test::record_run("delhi");
  const Explanation tie = first_of<DepthCompare>(trace, [](const DepthCompare& e) { return !e.nearer && e.z == 5; });
  CHECK(tie.sentence.find("tie") != std::string::npos);
  CHECK(any_formula(tie, "5 < 5"));
  CHECK(any_formula(tie, "is false"));
  const Explanation first = first_of<DepthCompare>(trace, [](const DepthCompare&) { return true; });
  CHECK(first.sentence.find("\u221e") != std::string::npos);
}

TEST_CASE("a recorded number that its formula does not give is doubted") {
  const Trace trace = test::record_run("delhi");
  const auto position = trace.next(0, [](const RecordedEvent& e) {
    const auto* z = get_if<DepthInterpolate>(&e.event);
    return z && z->x == 1;
  });
  REQUIRE(position);
  Replay replay(trace);
  replay.go_to(*position);
  RecordedEvent wrong = *replay.current();
  get<DepthInterpolate>(wrong.event).z += 0.25;
  const Explanation told = explain(trace, replay.state(), wrong);
  REQUIRE(told.doubt);
  CHECK(told.doubt->find("5.25") != std::string::npos);
  CHECK(told.doubt->find("gives 5") != std::string::npos);
}

TEST_CASE("a compare that its numbers contradict is told as such") {
  const Trace trace = test::record_run("delhi");
  const auto told_wrong = [&](auto&& fits) {
    const auto position = trace.next(0, [&](const RecordedEvent& e) {
      const auto* compare = get_if<DepthCompare>(&e.event);
      return compare && fits(*compare);
    });
    REQUIRE(position);
    Replay replay(trace);
    replay.go_to(*position);
    RecordedEvent wrong = *replay.current();
    get<DepthCompare>(wrong.event).nearer = !get<DepthCompare>(wrong.event).nearer;
    return explain(trace, replay.state(), wrong);
  };
  const Explanation empty = told_wrong([](const DepthCompare& e) { return e.nearer; });
  CHECK(empty.sentence.find("The trace says not nearer") == 0);
  CHECK(empty.sentence.find("< \u221e is true") != std::string::npos);
  CHECK(empty.sentence.find("hidden") == std::string::npos);
  CHECK(any_formula(empty, "is true"));
  CHECK(empty.doubt);
  const Explanation tie = told_wrong([](const DepthCompare& e) { return !e.nearer && e.z == 5; });
  CHECK(tie.sentence.find("The trace says nearer") == 0);
  CHECK(tie.sentence.find("5 < 5 is false") != std::string::npos);
  CHECK(any_formula(tie, "is false"));
}

TEST_CASE("names: a polygon without one is told by its index, depths by the convention") {
  Scene scene;
  scene.polygons.push_back({"A", {}, 0});
  scene.polygons.push_back({"", {}, 0});
  CHECK(polygon_label(scene, 0) == "A");
  CHECK(polygon_label(scene, 1) == "P1");
  CHECK(polygon_label(scene, no_polygon) == "background");
  Conventions conventions;
  CHECK(depth_symbol(scene, conventions) == "z*");
  conventions.depth = Conventions::Depth::view;
  CHECK(depth_symbol(scene, conventions) == "z_v");
  scene.camera.kind = Camera::Kind::screen;
  CHECK(depth_symbol(scene, conventions) == "z");
}
