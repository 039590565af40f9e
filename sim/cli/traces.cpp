#include "sim/cli/traces.hpp"

#include <cstdio>
#include <filesystem>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "sim/cli/watch.hpp"
#include "traces/error.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::cli {
namespace {

namespace fs = std::filesystem;

bool has_extension(const std::string& path, std::string_view extension) { return fs::path(path).extension().string() == extension; }

}  // namespace

bool is_trace(const std::string& path) { return has_extension(path, ".ztrace") || has_extension(path, ".jsonl"); }

Trace open_trace(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw InputError(path, "there is no such file", is_trace(path) ? "check its name, or make one: zstep record SCENE -o run.ztrace"
                                                                   : "give a trace: zstep record SCENE -o run.ztrace makes one");
  try {
    Trace trace = has_extension(path, ".jsonl") ? open_jsonl(path) : Trace::open(path);
    for (const std::string& warning : trace.warnings()) fmt::print(stderr, "{}\n", warning);
    return trace;
  } catch (const std::bad_alloc&) {
    throw InputError(path, "there is not enough memory to open it", "close other programs, or record with a smaller --size");
  }
}

Trace record_to_memory(const Run& run) {
  TraceRecorder recorder(header_for(*run.method, run.conventions), run.scene);
  {
    Watch watch;
    watch.attach(recorder);
    run.method->record(run.scene, run.conventions, recorder);
  }
  recorder.on_block(nullptr);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), run.scene.name);
}

}  // namespace zstep::cli
