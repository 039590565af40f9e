#include "tests/golden/golden.hpp"

#include <algorithm>

#include "tests/where.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::test {

std::vector<std::filesystem::path> golden_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(test::in_checkout("tests/golden")))
    if (entry.path().extension() == ".jsonl") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Trace recorded_by(const std::string& id, const Scene& scene, const Conventions& conventions) {
  const Method& m = method(id);
  TraceRecorder recorder(header_for(m, conventions, scene.camera.kind), scene);
  m.record(scene, conventions, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), scene.name);
}

Trace record_again(const Trace& golden) {
  return recorded_by(golden.header().algorithm, golden.scene(), golden.header().conventions);
}

}  // namespace zstep::test
