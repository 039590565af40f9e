// Law: no run of zstep's own is doubted, whatever method, scene and conventions, and its formulas give every bit.
#include <doctest/doctest.h>

#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/laws/agreement/n_gons.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep {
namespace {

/// False where the method cannot draw the scene so.
bool is_right(const Method& method, const Scene& scene, const Conventions& conventions) {
  try {
    check_run(method, scene, conventions);
  } catch (const InputError&) {
    return false;
  }
  TraceRecorder recorder(header_for(method, conventions), scene);
  method.record(scene, conventions, recorder);
  recorder.finish();
  const Trace trace = Trace::from_bytes(recorder.take_bytes(), scene.name);
  const CheckReport report = check(trace);
  CAPTURE(method.id);
  CAPTURE(scene.name);
  for (const Cause& cause : report.causes) {
    const StepInfo* step = find_step(trace.header().page, cause.first.line);
    FAIL_CHECK(step->name << " at step " << cause.first.step << ": " << cause.first.field << cause.first.impossible
                          << (cause.first.rule ? rule_text(*cause.first.rule).name : ""));
  }
  CHECK(report.exact == report.numbers);
  return true;
}

TEST_CASE("law: check doubts no run of any method") {
  int runs = 0;
  for (const char* name : {"pyramid", "pyramid-behind", "cube", "torus", "teapot:2", "foley", "delhi", "cyclic"}) {
    for (const bool ortho : {false, true}) {
      ViewOptions view;
      view.width = 32, view.height = 24;
      if (ortho) view.orthographic = true;
      Scene scene;
      try {
        scene = look_at_scene(load_scene(name).scene, view);
      } catch (const InputError&) {
        continue;  // a scene in screen coordinates has no camera to choose
      }
      for (const Method& method : methods()) {
        for (int bits = 0; bits < 16; ++bits) {
          Conventions conventions;
          if (bits & 1) conventions.interpolation = Conventions::Interpolation::increments;
          if (bits & 2) conventions.coverage = Conventions::Coverage::inclusive;
          if (bits & 4) conventions.depth = Conventions::Depth::view;
          if (bits & 8) conventions.cull = false;
          runs += is_right(method, scene, conventions);
        }
      }
    }
  }
  // Meshes of n-gons that are bent, concave, thin, or pass through each other.
  for (const test::NGonKind& kind : test::n_gon_kinds())
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      for (const Scene& scene : test::two_views(kind.make(seed), seed))
        for (const Method& method : methods()) runs += is_right(method, scene, {});
  CHECK(runs > 1000);
  MESSAGE(runs, " runs");
}

}  // namespace
}  // namespace zstep
