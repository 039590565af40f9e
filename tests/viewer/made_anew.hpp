// A run made anew, as whoever opens the window has to.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/viewer.hpp"
#include "tests/viewer/words/some_runs.hpp"

namespace zstep::test {

/// What was opened by a method, its own or another, with these changes. InputError where that cannot be made.
inline OtherRun made_anew(const Trace& opened, const std::string& id, const std::vector<Change>& changes) {
  Scene scene = opened.scene();
  Conventions conventions = conventions_for(method(id), opened.header().conventions);
  for (const Change& change : changes) make_change(method(id), change, scene, conventions, "");
  check_run(method(id), scene, conventions);
  TraceRecorder recorder(header_for(method(id), conventions), scene);
  method(id).record(scene, conventions, recorder);
  recorder.finish();
  return {Trace::from_bytes(recorder.take_bytes(), scene.name), true};
}

}  // namespace zstep::test
