// The same pixel by another method: what the window shows when it switches.
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
  const auto* paint = std::get_if<PixelPaint>(&s.event()->event);
  REQUIRE(paint != nullptr);
  CHECK(Cell{paint->x, paint->y} == cell);
  // Nothing changes the pixel afterwards.
  Replay end(stage.trace());
  end.go_to(stage.trace().size());
  CHECK(end.state().picture.polygon[end.state().picture.at(16, 16)] == paint->polygon);
  CHECK(!test::picture(stage.app()).empty());

  stage.switch_method(1);
  CHECK(&stage.trace() == &trace);
  CHECK(std::holds_alternative<PixelWrite>(stage.app().session().event()->event));
}

TEST_CASE("without a selected pixel the other method is shown at its end, and a lesson waits where it was opened") {
  const Trace trace = test::record_run("pyramid");
  Lesson lesson;
  Stop stop;
  stop.text = "Look.";
  lesson.stops = {stop};
  ViewerOptions options = two_methods();
  options.lesson = &lesson;
  Stage stage(trace, options, Settings{}, 1280, 720);
  stage.switch_method(1);
  CHECK(stage.app().session().position() == stage.trace().size());
  CHECK(stage.app().session().lesson() == nullptr);
  stage.switch_method(-1);
  CHECK(stage.app().session().lesson() == &lesson);
}

TEST_CASE("what cannot be done is said, and nothing changes") {
  const Trace trace = test::record_run("pyramid");
  ViewerOptions options;
  Stage alone(trace, options, Settings{}, 1280, 720);
  alone.switch_method(1);
  CHECK(&alone.trace() == &trace);
  CHECK(alone.app().session().message.find("No other method") != std::string::npos);

  options.other_method = [](const Trace&, int) -> std::optional<OtherRun> { throw InputError("scene", "is no good", "mend it"); };
  Stage failing(trace, options, Settings{}, 1280, 720);
  failing.switch_method(1);
  CHECK(&failing.trace() == &trace);
  CHECK(failing.app().session().message.find("is no good") != std::string::npos);

  ViewerOptions cut = two_methods();
  cut.other_method = [](const Trace& now, int) { return std::optional(OtherRun{run_of("depth-sort", now.scene()), false}); };
  Stage stage(trace, cut, Settings{}, 1280, 720);
  stage.switch_method(1);
  CHECK(stage.app().session().message.find("cut off") != std::string::npos);
}
