#include "tests/golden/golden.hpp"

#include <algorithm>

#include "traces/record/trace_recorder.hpp"

namespace zstep::test {

std::vector<std::filesystem::path> golden_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(ZSTEP_SOURCE_DIR "/tests/golden"))
    if (entry.path().extension() == ".jsonl") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Trace record_again(const Trace& golden) {
  const Header& header = golden.header();
  const Method& m = method(header.algorithm);
  TraceRecorder recorder(header_for(m, header.conventions), golden.scene());
  m.record(golden.scene(), header.conventions, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), golden.name());
}

}  // namespace zstep::test
