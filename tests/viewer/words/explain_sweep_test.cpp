#include <map>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/words/explain.hpp"
#include "tests/where.hpp"
#include "traces/file/trace.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

Trace swept(const std::string& scene_name, const std::map<std::string, std::string>& options) {
  const SceneFile file = load_scene(test::in_checkout(scene_name));
  const Scene scene = look_at_scene(file.scene, {});
  Conventions conventions = file.conventions;
  conventions.options = options;
  const Method& m = method("scan-line");
  TraceRecorder recorder(header_for(m, conventions), scene);
  m.record(scene, conventions, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "swept");
}

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

}  // namespace

TEST_CASE("every event of the scan-line method has a sentence, and its formula gives the recorded number") {
  const std::string abc = "lessons/scenes/abc-def.toml", small = "tests/golden/scan-line.toml";
  for (const Trace& trace : {swept(abc, {{"coherence", "on"}}), swept(small, {{"antialias", "on"}}),
                             swept(small, {{"resolve", "line-buffer"}})}) {
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Explanation told = explain(trace, replay.state(), *replay.current());
      CAPTURE(told.sentence);
      REQUIRE_FALSE(told.sentence.empty());
      REQUIRE(told.sentence.back() == '.');
      REQUIRE_MESSAGE(!told.doubt, told.doubt.value_or(""));
      CHECK(told.sentence.find("background leaves") == std::string::npos);
    }
  }
}

TEST_CASE("edges and vertices of polygons that are named by their corners go by letters") {
  const Trace trace = swept("lessons/scenes/abc-def.toml", {});
  CHECK(vertex_label(trace.scene(), 5) == "F");
  CHECK(first_of<EdgeEnter>(trace, [](const EdgeEnter& e) { return e.edge == 5; }).sentence.find("FD") !=
        std::string::npos);
  CHECK(first_of<FlagFlip>(trace, [](const FlagFlip& e) { return e.edge == 1; }).sentence ==
        "The sweep crosses edge CB: the flag of ABC turns to out.");
  const Trace small = swept("tests/golden/scan-line.toml", {});
  CHECK(vertex_label(small.scene(), 5) == "5");
}

TEST_CASE("the plane's depth and the implied edge are told with their numbers") {
  const Trace trace = swept("lessons/scenes/abc-def.toml", {});
  const Explanation depth =
      first_of<PlaneDepth>(trace, [](const PlaneDepth& e) { return e.piece == 1 && e.y_at == 9; });
  REQUIRE(depth.formulas.size() == 1);
  CHECK(depth.formulas[0].find("z of DEF = \u2212(A\u00b7x + B\u00b7y + D)/C = ") == 0);
  CHECK(depth.formulas[0].ends_with("= 1.25"));
  const Explanation implied = first_of<ImpliedEdge>(trace, [](const ImpliedEdge&) { return true; });
  CHECK(implied.sentence.find("x = 10.5") != std::string::npos);
  REQUIRE(implied.formulas.size() == 2);  // the depths of both, which are the same there
  CHECK(implied.formulas[0].find("z of KLM = ") == 0);
  CHECK(implied.formulas[1].find("z of RST = ") == 0);
}

TEST_CASE("a depth that its plane does not give is doubted") {
  const Trace trace = swept("lessons/scenes/abc-def.toml", {});
  const auto position = trace.next(0, [](const RecordedEvent& e) { return holds<PlaneDepth>(e.event); });
  REQUIRE(position);
  Replay replay(trace);
  replay.go_to(*position);
  RecordedEvent wrong = *replay.current();
  get<PlaneDepth>(wrong.event).z += 0.5;
  CHECK(explain(trace, replay.state(), wrong).doubt.has_value());
}
