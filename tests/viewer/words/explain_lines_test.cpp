// What is said of edges and their pieces.
#include <string>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "tests/where.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

Trace lines_run(const std::string& id) {
  const std::string name = test::in_checkout("lessons/scenes/hidden-lines.toml");
  const SceneFile file = load_scene(name);
  const Scene scene = look_at_scene(file.scene, {});
  const Method& chosen = method(id);
  TraceRecorder record(header_for(chosen, file.conventions), scene);
  chosen.record(scene, file.conventions, record);
  record.finish();
  return Trace::from_bytes(record.take_bytes(), name);
}

template <class E, class Condition>
Explanation told_at(const Trace& trace, Condition&& condition) {
  const auto position = trace.next(0, [&](const RecordedEvent& recorded) {
    const E* event = get_if<E>(&recorded.event);
    return event && condition(*event);
  });
  REQUIRE(position.has_value());
  Replay replay(trace);
  replay.go_to(*position);
  const Explanation told = explain(trace, replay.state(), *replay.current());
  CHECK(!told.doubt);
  return told;
}

}  // namespace

TEST_CASE("an edge is told with its ends, its faces and what it is to the contour") {
  const Trace trace = lines_run("hidden-line");
  const auto sentence = [&](std::int32_t line) {
    return told_at<LineBegin>(trace, [&](const LineBegin& e) { return e.line == line; }).sentence;
  };
  CHECK(
      sentence(0) ==
      "Edge 0 runs from vertex 0 to vertex 1, on the contour: of A and F one faces the eye and the other faces away.");
  CHECK(sentence(1) == "Edge 1 runs from vertex 1 to vertex 2. Its faces A and B both face the eye.");
  CHECK(sentence(9) == "Edge 9 runs from vertex 4 to vertex 7. Its faces D and F both face away.");
  CHECK(sentence(12) == "Edge 12 runs from vertex 8 to vertex 9. Only P is there; nothing lies on its other side.");
}

TEST_CASE("what a face does to an edge: own, before, beside, covered") {
  const Trace trace = lines_run("hidden-line");
  const auto sentence = [&](LineFace outcome) {
    return told_at<LineAgainst>(trace, [&](const LineAgainst& e) { return e.outcome == outcome; }).sentence;
  };
  CHECK(sentence(LineFace::own) == "Edge 0 (0\u20131) is an edge of A itself, and its own face does not hide it.");
  CHECK(sentence(LineFace::covered) == "P hides a part of edge 0 (0\u20131).");
  CHECK(sentence(LineFace::behind).find("beside B on the picture") != std::string::npos);
  CHECK(sentence(LineFace::in_front).find("lies in front of the plane of P") != std::string::npos);
}

TEST_CASE("crossings show their formula, and it gives the recorded number") {
  const Trace trace = lines_run("hidden-line");
  const Explanation space = told_at<LineCross>(trace, [](const LineCross& e) { return e.line == 12 && e.in_space; });
  CHECK(space.sentence == "Edge 12 (8\u20139) goes through the plane of A at t = 0.4.");
  CHECK(space.formulas.at(0).find("t = d_0/(d_0 \u2212 d_1) = ") == 0);
  CHECK(space.formulas.size() == 3);
  const Explanation picture = told_at<LineCross>(trace, [](const LineCross& e) { return e.line == 0; });
  CHECK(picture.sentence == "On the picture edge 0 (0\u20131) crosses an edge of P at t = 0.35.");
  CHECK(picture.formulas.at(0) ==
        "t = ((x_a \u2212 x_0)(y_b \u2212 y_a) \u2212 (y_a \u2212 y_0)(x_b \u2212 x_a))/((x_1 \u2212 x_0)(y_b "
        "\u2212 y_a) \u2212 (y_1 \u2212 y_0)(x_b \u2212 x_a)) = ((14.7 \u2212 12.3)(18.94 \u2212 28.54) \u2212 "
        "(28.54 \u2212 24.86)(26.7 \u2212 14.7))/((25.1 \u2212 12.3)(18.94 \u2212 28.54) \u2212 (30.62 \u2212 "
        "24.86)(26.7 \u2212 14.7)) = 0.35");
  CHECK(picture.formulas.at(1) == "x = x_0 + t\u00b7(x_1 \u2212 x_0) = 12.3 + 0.35\u00b7(25.1 \u2212 12.3) = 16.78");
}

TEST_CASE("pieces: visible, hidden, whole, of a back") {
  const Trace trace = lines_run("hidden-line");
  const auto sentence = [&](std::int32_t line, bool visible) {
    return told_at<LinePiece>(trace, [&](const LinePiece& e) { return e.line == line && e.visible == visible; })
        .sentence;
  };
  CHECK(sentence(0, true) == "Edge 0 (0\u20131) is visible from t = 0.35 to t = 1.");
  CHECK(sentence(0, false) == "Edge 0 (0\u20131) is hidden from t = 0 to t = 0.35.");
  CHECK(sentence(1, true) == "All of edge 1 (1\u20132) is drawn.");
  CHECK(sentence(9, false) == "All faces at edge 9 (4\u20137) face away, so none of it is seen.");
  CHECK(sentence(15, false) == "All of edge 15 (11\u20138) is hidden.");
  const Explanation hide = told_at<LineHide>(trace, [](const LineHide&) { return true; });
  CHECK(hide.sentence ==
        "From t = 0 to t = 0.35 edge 0 (0\u20131) is inside P on the picture and behind its plane: hidden there.");
  const Trace wires = lines_run("wireframe");
  CHECK(told_at<LinePiece>(wires, [](const LinePiece& e) { return e.line == 9; }).sentence ==
        "All of edge 9 (4\u20137) is drawn.");
}
