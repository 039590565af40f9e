// The same moment by another method: what the window shows when it switches.
#include <doctest/doctest.h>

#include "algorithms/catalog/catalog.hpp"
#include "sim/viewer/stage.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"
#include "traces/error.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Trace run_of(const char* id, const Scene& scene) {
  TraceRecorder recorder(header_for(method(id), Conventions{}), scene);
  method(id).record(scene, Conventions{}, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), scene.name);
}

/// Z-buffer and depth sort in a circle.
ViewerOptions two_methods() {
  ViewerOptions options;
  options.other_method = [](const Trace& trace, int) -> std::optional<OtherRun> {
    return OtherRun{run_of(trace.header().algorithm == "z-buffer" ? "depth-sort" : "z-buffer", trace.scene()), true};
  };
  return options;
}

}  // namespace

TEST_CASE("switching shows the other method at the step that gave the selected pixel its colour, and back") {
  const Trace trace = test::record_run("pyramid");
  const ViewerOptions options = two_methods();
  Stage stage(trace, options, Settings{}, 1280, 720);
  const Cell cell{16, 16};
  stage.app().session().select(cell);
  test::press(stage.app(), SDLK_x);
  REQUIRE(stage.app().requests.switch_method == 1);
  stage.switch_method(1);

  CHECK(stage.trace().header().algorithm == "depth-sort");
  CHECK(stage.app().session().selected == cell);
  const Session& s = stage.app().session();
  REQUIRE(s.event() != nullptr);
  const auto* paint = get_if<PixelPaint>(&s.event()->event);
  REQUIRE(paint != nullptr);
  CHECK(Cell{paint->x, paint->y} == cell);
  // Nothing changes the pixel afterwards.
  Replay end(stage.trace());
  end.go_to(stage.trace().size());
  CHECK(end.state().picture.polygon[end.state().picture.at(16, 16)] == paint->polygon);
  CHECK(!test::picture(stage.app()).empty());

  stage.switch_method(1);
  CHECK(&stage.trace() == &trace);
  CHECK(stage.app().session().position() == 0);  // where it was left
  CHECK(stage.app().session().selected == cell);
}

TEST_CASE("switching keeps the moment: the pixel and the polygon at work, and the way back leads where one was") {
  const Trace trace = test::record_run("pyramid");
  Lesson lesson;
  Stop stop, question;
  stop.text = "Look.";
  question.position = 300;
  question.question = Question{"Which?", {{"this", true, "yes"}, {"that", false, "no"}}};
  lesson.stops = {stop, question};
  ViewerOptions options = two_methods();
  options.lesson = &lesson;
  Stage stage(trace, options, Settings{}, 1280, 720);
  // A compare of some polygon at some pixel.
  Session& first = stage.app().session();
  first.go_to(300);
  first.answer(1);
  while (!first.event() || !holds<DepthCompare>(first.event()->event)) first.go_to(first.position() + 1);
  const std::int64_t here = first.position();
  const Cell cell = *first.current_cell();
  const std::int32_t polygon = first.state().machine.polygon;
  REQUIRE(polygon >= 0);

  stage.switch_method(1);
  CHECK(stage.app().session().lesson() == nullptr);
  CHECK(stage.app().session().current_cell() == cell);
  CHECK(stage.app().session().state().machine.polygon == polygon);
  CHECK(stage.app().session().message.find("the lesson waits") != std::string::npos);
  CHECK(stage.first_app().session().position() == here);
  stage.app().set_dark(true);
  for (int there_and_back = 0; there_and_back < 3; ++there_and_back) {
    stage.switch_method(1);
    CHECK(stage.app().session().lesson() == &lesson);
    CHECK(stage.app().session().position() == here);
    CHECK(stage.app().session().chosen(1) == 1);  // what was answered stays answered
    CHECK(stage.app().settings().dark);
    stage.switch_method(1);
    CHECK(stage.app().session().current_cell() == cell);
  }
  // Where the reader moved meanwhile, the way back keeps that.
  stage.app().session().go_to(0);
  stage.switch_method(1);
  CHECK(stage.app().session().position() == 0);
  // With neither pixel nor polygon at work: as much of the run.
  stage.app().session().go_to(trace.size());
  stage.switch_method(1);
  CHECK(stage.app().session().position() == stage.trace().size());
}

TEST_CASE("what cannot be done is said, and nothing changes") {
  const Trace trace = test::record_run("pyramid");
  ViewerOptions options;
  Stage alone(trace, options, Settings{}, 1280, 720);
  alone.switch_method(1);
  CHECK(&alone.trace() == &trace);
  CHECK(alone.app().session().message.find("No other method") != std::string::npos);

  options.other_method = [](const Trace&, int) -> std::optional<OtherRun> {
    throw InputError("scene", "is no good", "mend it");
  };
  Stage failing(trace, options, Settings{}, 1280, 720);
  failing.switch_method(1);
  CHECK(&failing.trace() == &trace);
  CHECK(failing.app().session().message.find("is no good") != std::string::npos);

  ViewerOptions cut = two_methods();
  cut.other_method = [](const Trace& now, int) {
    return std::optional(OtherRun{run_of("depth-sort", now.scene()), false});
  };
  Stage stage(trace, cut, Settings{}, 1280, 720);
  stage.switch_method(1);
  CHECK(stage.app().session().message.find("cut off") != std::string::npos);
}
