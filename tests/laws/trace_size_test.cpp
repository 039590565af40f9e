// What a trace takes. Events are foretold from the scene and from one another (docs/trace-format.md, "Guesses"); a
// method that computes otherwise than its guesses say makes no wrong trace, only a large one, so its size is held
// against what it was when both agreed.
#include <doctest/doctest.h>

#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/golden/golden.hpp"
#include "traces/file/visit.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;

namespace {

struct Recorded {
  double events = 0, bytes = 0;
};

Recorded record(const std::string& name, const std::string& mesh, double window) {
  ViewOptions view;
  view.width = 160, view.height = 120;
  if (window > 0) view.window = window;
  const Scene scene = look_at_scene(load_scene(mesh).scene, view);
  const Trace trace = test::recorded_by(name, scene);
  Recorded recorded{static_cast<double>(trace.size()), 0};
  for (const auto& block : trace.impl().blocks) recorded.bytes += static_cast<double>(block.place.size);
  return recorded;
}

}  // namespace

TEST_CASE("law: a trace takes no more bytes an event than its guesses leave over") {
  struct Subject {
    const char *method, *mesh;
    double most;  ///< bytes an event: a little more than was measured, and less than without the guesses for its pieces
    double window = 0;  ///< so small that much is clipped; 0: all is seen
  };
  for (const Subject& subject :
       {Subject{"z-buffer", "teapot:4", 0.24}, Subject{"bsp", "teapot:4", 2.24},
        Subject{"depth-sort", "teapot:12", 0.72}, Subject{"depth-sort", "teapot:12", 0.81, 0.2},
        Subject{"warnock", "teapot:4", 0.74}, Subject{"warnock", "teapot:4", 0.64, 0.2},
        Subject{"scan-line", "teapot:4", 1.345}, Subject{"scan-line", "teapot:4", 0.46, 0.2},
        Subject{"ray-casting", "teapot:2", 0.21}}) {
    const Recorded recorded = record(subject.method, subject.mesh, subject.window);
    const std::string name = subject.method;
    const double bytes = recorded.bytes / recorded.events;
    CAPTURE(name);
    CAPTURE(subject.window);
    CAPTURE(recorded.events);
    CAPTURE(bytes);
    CHECK(bytes <= subject.most);
  }
}

TEST_CASE("codec: a facet without corners is nobody's piece") {
  Scene scene = load_scene("pyramid-behind").scene;
  scene.facets.insert(scene.facets.begin(), Facet{0, 0, 0});
  TraceRecorder recorder(header_for(method("warnock"), Conventions()), scene);
  const Page page = method("warnock").page();
  for (const StepInfo& step : page)
    if (step.kind == kind_of<PlaneDepth>) record_any(recorder, step.id, PlaneDepth{0, 1, 2, 0.5});
  recorder.finish();
  const Trace trace = Trace::from_bytes(recorder.take_bytes(), "no corners");
  REQUIRE(trace.size() > 0);
  CHECK(get<PlaneDepth>(trace.event(1).event).z == 0.5);
}
