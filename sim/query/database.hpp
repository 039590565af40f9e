// Asks a trace in SQL: its tables and columns, and statements. Reading is all that a statement can do, and it ends when
// its time or memory is used up.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "traces/events/fields.hpp"
#include "traces/file/trace.hpp"

namespace zstep::query {

// The tables that a trace has for SQL, and their columns: what each kind of event tells, generated from the vocabulary.

/// What a column holds in a row: nothing, a whole number (truth values are 0 and 1), a number, or a text that lives as
/// long as the program or the trace.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string_view>;

/// What every table has before an event's own fields.
struct Context {
  std::int64_t step = 0;              ///< the position that the event leads to
  std::string_view name;              ///< of the line of pseudo-code: "compare"
  std::int32_t polygon = no_polygon;  ///< that of the event's facet or piece, or else the one at work
  std::int32_t scan_line = -1;        ///< the last that was begun for it; -1: none
};

struct Column {
  std::string name, meaning;
  const FieldOfKind* field = nullptr;  ///< of the event's own; nullptr for those of the context

  /// Of an event's own column.
  Cell of(const Event& event) const;
};

struct Table {
  std::string name, meaning;
  std::vector<Column> columns;                          ///< step, name, polygon, scan_line, then the event's own
  bool own_polygon = false;                             ///< the event's own `polygon` stands in place of the context's
  bool named_by_facet = false, named_by_piece = false;  ///< the context's is that of the event's facet or piece
  int x = -1, y = -1;                                   ///< the columns of its pixel, if it has both
};

/// The places of the context's columns in every table.
enum ContextColumn : int { step_column, name_column, polygon_column, scan_line_column, own_columns };

/// One table for each kind of event, by kind.
const std::vector<Table>& all_tables();

/// The kinds of events that this trace's pseudo-code can record, in the order of the page, none twice.
std::vector<std::uint8_t> kinds_in(const Trace& trace);

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
