// Asks a trace in SQL. Reading is all that a statement can do, and it ends when its time or memory is used up.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::query {

/// What a row of an answer holds at a place: NULL, a whole number, a number or a text.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Limits {
  double seconds = 0;          ///< of processor and waiting together; 0: as long as it takes
  std::function<bool()> stop;  ///< asked now and then; true ends the statement
};

/// A statement did not come to its end, by a limit or by stop().
struct Stopped {
  bool by_time = false;
};

class Database {
 public:
  /// The trace must outlive it.
  explicit Database(const Trace& trace);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Runs one SELECT. Calls columns(names) once and then row(values) for each row, until it returns false.
  /// Throws InputError for what is not such a statement, or where the trace is damaged; Stopped.
  using Columns = std::function<void(const std::vector<std::string>& names)>;
  using Row = std::function<bool(std::span<const Value> values)>;
  void run(const std::string& sql, const Limits& limits, const Columns& columns, const Row& row);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace zstep::query
