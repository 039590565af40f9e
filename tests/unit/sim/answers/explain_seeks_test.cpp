// How many seeks it takes to follow a number back. A seek through a long run takes milliseconds, all else microseconds.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/answers/explain_value.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep {
namespace {

Trace teapot_by(const Method& method) {
  ViewOptions view;
  view.width = 160, view.height = 120;
  const Scene scene = look_at_scene(load_scene("teapot:4").scene, view);
  TraceRecorder recorder(header_for(method, {}), scene);
  method.record(scene, {}, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), scene.name);
}

TEST_CASE("explain: a number is followed back with hardly more than the seek to its step") {
  constexpr int questions = 200;
  for (const char* name : {"z-buffer", "warnock", "bsp", "depth-sort", "scan-line", "shadow-buffer", "hidden-line"}) {
    CAPTURE(name);
    const Trace trace = teapot_by(method(name));
    // Marks close together, so that a step that a short run has far away is one that a long run has to be sought for.
    Replay replay(trace, {.undo_window = 2048, .check_point_every = 256, .lead_in = 1024, .key_frame_every = 8192});
    std::mt19937_64 random(2);
    for (int i = 0; i < questions; ++i)
      answers::explain_value(trace, replay,
                             {static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(trace.size())) + 1});
    // One to get to the step, and where planes and pieces were made, another one.
    CHECK(static_cast<double>(replay.seeks()) / questions < 2);
  }
}

}  // namespace
}  // namespace zstep
