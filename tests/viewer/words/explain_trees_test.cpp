// The BSP tree in sentences.
#include <string>

#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/pieces.hpp"
#include "tests/where.hpp"
#include "traces/record/trace_recorder.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

Trace run_of(const std::string& name, std::map<std::string, std::string> options) {
  SceneFile file = load_scene(test::in_checkout(name));
  file.conventions.options = std::move(options);
  const Scene scene = look_at_scene(file.scene, {});
  const Method& bsp = method("bsp");
  TraceRecorder record(header_for(bsp, file.conventions), scene);
  bsp.record(scene, file.conventions, record);
  record.finish();
  return Trace::from_bytes(record.take_bytes(), name);
}

template <class E, class Condition>
Explanation told_of(const Trace& trace, Condition&& condition) {
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

TEST_CASE("words: every event of a BSP run has a sentence, and its formula gives the recorded number") {
  for (const char* order : {"back-to-front", "front-to-back"})
    for (const char* scene : {"tests/golden/bsp.toml", "lessons/scenes/six-walls.toml"}) {
      const Trace trace = run_of(scene, {{"order", order}});
      Replay replay(trace);
      while (replay.position() < trace.size()) {
        replay.step_forward();
        const Explanation told = explain(trace, replay.state(), *replay.current());
        const auto position = replay.position();
        CAPTURE(position);
        REQUIRE_FALSE(told.sentence.empty());
        REQUIRE(told.sentence.back() == '.');
        REQUIRE_MESSAGE(!told.doubt, told.doubt.value_or(""));
      }
    }
}

TEST_CASE("words: nodes, sides and cuts of the six walls") {
  const Trace trace = run_of("lessons/scenes/six-walls.toml", {{"root", "first"}});
  CHECK(told_of<NodeMake>(trace, [](const NodeMake& e) { return e.parent < 0; }).sentence ==
        "A becomes the root of the tree: its plane divides all other pieces.");
  CHECK(told_of<NodeMake>(trace, [](const NodeMake& e) { return e.parent == 1 && !e.front; }).sentence ==
        "F1 becomes the back child of B: its plane divides what lies behind the plane of B.");
  const Explanation crossing = told_of<SideTest>(trace, [](const SideTest& e) { return e.side == Side::crossing; });
  CHECK(crossing.sentence == "F lies on both sides of the plane of A: it is cut there.");
  const Explanation cut = told_of<SplitVertex>(trace, [](const SplitVertex&) { return true; });
  REQUIRE(cut.formulas.size() == 2);
  CHECK(cut.formulas[0] == "t = d_0/(d_0 \u2212 d_1) = 1/(1 \u2212 (\u22121)) = 0.5");
  CHECK(cut.formulas[1] == "V = V_0 + t\u00b7(V_1 \u2212 V_0) = (\u22123.25, 0, 0)");
  const Explanation eye = told_of<EyeSide>(trace, [](const EyeSide& e) { return e.node == 1; });
  CHECK(eye.sentence == "The eye is behind the plane of B, so what lies in front of it is drawn first.");
  REQUIRE_FALSE(eye.formulas.empty());
  CHECK(eye.formulas[0].ends_with("= \u22122"));
}

TEST_CASE("words: parts of a polygon are called by its name and a number") {
  const Trace trace = run_of("lessons/scenes/six-walls.toml", {{"root", "first"}});
  Replay replay(trace);
  replay.go_to(trace.size());
  const MethodState& machine = replay.state().machine;
  std::string names;
  for (std::int32_t piece = 0; piece < static_cast<std::int32_t>(machine.pieces.size()); ++piece)
    names += piece_label(trace.scene(), machine, piece) + " ";
  CHECK(names == "A B C D E F F1 F2 E1 E2 ");
  CHECK(node_of_piece(machine, 6) == 3);
  CHECK(piece_label(trace.scene(), machine, 99) == "piece 99");
}
