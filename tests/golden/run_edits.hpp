// Golden runs with something done to them, for tables of what is then said of them.
#pragma once

#include <string>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::test {

using RunLines = std::vector<std::string>;

/// The lines of a run in JSON Lines: "tests/golden/bsp.jsonl".
RunLines lines_of_run(const std::string& path);

/// What is done to the Nth step of a name: "drop NAME N", "repeat NAME N", "swap NAME N" (with the step after it), or
/// "set NAME N FIELD=VALUE", of a field that it has.
RunLines with_edit(RunLines lines, const std::string& edit);

/// A step that cannot be ends the run there.
Trace trace_of_lines(const RunLines& lines);

}  // namespace zstep::test
