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

/// The table of the trace with the most rows, and a question for which two columns of it are read whole.
struct LargestTable {
  std::string name, question;
};
LargestTable largest_table(const Trace& trace);
/// Asks it; returns the table's rows.
std::int64_t scan_by_sql(const Trace& trace, const LargestTable& table);

}  // namespace zstep::bench
