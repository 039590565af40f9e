// Traces for the commands that read one: from a file, from JSON Lines, or recorded on the spot.
#pragma once

#include <string>

#include "sim/cli/run_options.hpp"
#include "traces/file/trace.hpp"

namespace zstep::cli {

/// Whether the argument names a trace (a .ztrace or .jsonl file, or any file that begins like a trace) and not a scene.
bool is_trace(const std::string& path);

/// Opens a .ztrace or .jsonl file and prints its warnings on stderr.
Trace open_trace(const std::string& path);

/// Records the run to memory. Throws Interrupted after Ctrl-C.
Trace record_to_memory(const Run& run);

}  // namespace zstep::cli
