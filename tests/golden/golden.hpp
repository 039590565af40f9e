// The golden traces: recordings of small scenes as JSON Lines, reviewed once and compared ever after.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/trace.hpp"

namespace zstep::test {

/// Every tests/golden/*.jsonl, by name.
std::vector<std::filesystem::path> golden_files();

/// The run of a golden trace once more: its scene and conventions, recorded by the present code.
Trace record_again(const Trace& golden);

/// A run of this method with its standard conventions.
Trace recorded_by(const std::string& method, const Scene& scene, const Conventions& conventions = {});

/// Calls check(name, trace) for every golden trace.
template <class Check>
void for_each_golden(Check&& check) {
  for (const std::filesystem::path& path : golden_files()) {
    const Trace trace = open_jsonl(path);
    check(path.stem().string(), trace);
  }
}

inline std::string jsonl_of(const Trace& trace) {
  std::ostringstream out;
  write_jsonl(trace, out);
  return out.str();
}

}  // namespace zstep::test
