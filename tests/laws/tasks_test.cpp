// What lessons ask to be tried: not done by the lesson's own run, and done by the solution.
#include <doctest/doctest.h>

#include <string>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/catalog/changes.hpp"
#include "sim/classroom/lesson.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;

TEST_CASE("law: each task of a lesson is done by its solution, and by no smaller part of it") {
  int tasks = 0;
  for (Lesson& lesson : all_lessons()) {
    const Trace trace = run_lesson(lesson);  // which says where the lesson's own run does the task already
    const Method& by = method(lesson.method);
    for (const Stop& stop : lesson.stops) {
      if (!stop.task) continue;
      CAPTURE(lesson.id);
      ++tasks;
      const TaskState before = state_of(*stop.task, trace);
      CHECK_FALSE(before.done);
      CHECK_FALSE(before.now.empty());
      CHECK_FALSE(stop.task->hints.empty());
      Scene scene = trace.scene();
      Conventions conventions = trace.header().conventions;
      for (std::size_t k = 0; k < stop.task->solution.size(); ++k) {
        CAPTURE(stop.task->solution[k]);
        make_change(by, read_change(stop.task->solution[k]), scene, conventions);
        TraceRecorder recorder(header_for(by, conventions), scene);
        by.record(scene, conventions, recorder);
        recorder.finish();
        const Trace changed = Trace::from_bytes(recorder.take_bytes(), "changed");
        const TaskState state = state_of(*stop.task, changed);
        CHECK_MESSAGE(state.done == (k + 1 == stop.task->solution.size()), state.now);
      }
    }
  }
  CHECK(tasks >= 20);
}
