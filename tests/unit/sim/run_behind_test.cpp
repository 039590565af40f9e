// A run that is made on a thread of its own.
#include <doctest/doctest.h>

#include <atomic>
#include <thread>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "sim/viewer/model/run_behind.hpp"
#include "traces/error.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

Trace some_run() {
  const Scene scene = load_scene("cube").scene;
  TraceRecorder recorder(header_for(method("z-buffer"), {}), scene);
  method("z-buffer").record(scene, {}, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "run");
}

}  // namespace

TEST_CASE("a run behind says how far it is, and what it throws comes to who takes it") {
  std::atomic<bool> goes_on = true;
  {
    RunBehind run([&](const RunWatch& watch) -> OtherRun {
      for (std::int64_t steps = 0; watch(steps); ++steps) std::this_thread::yield();
      goes_on = false;
      return {some_run(), false};
    });
    while (run.steps() < 10) std::this_thread::yield();
    CHECK_FALSE(run.done());
  }
  CHECK_FALSE(goes_on);
  RunBehind fails([](const RunWatch&) -> OtherRun { throw InputError("rho", "is too small", "make it larger"); });
  while (!fails.done()) std::this_thread::yield();
  CHECK_THROWS_AS(fails.take(), InputError);
  RunBehind ends([](const RunWatch&) -> OtherRun { return {some_run(), true}; });
  while (!ends.done()) std::this_thread::yield();
  CHECK(ends.take().trace.size() > 0);
}
