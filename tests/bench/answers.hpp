// How long the questions take that a person asks of a trace: of explaining a value, of why-not, of SQL.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "traces/replay/replay.hpp"

namespace zstep::bench {

/// Names and values for a table.
std::vector<std::pair<std::string, std::string>> measure_answers(const Trace& trace, Replay& replay);

/// Reads two columns of the trace's largest table; returns its rows.
std::int64_t scan_by_sql(const Trace& trace);

}  // namespace zstep::bench
