// The tables that a trace has for SQL, and their columns: what each kind of event tells, generated from the vocabulary.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "traces/events/fields.hpp"
#include "traces/file/trace.hpp"

namespace zstep::query {

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

}  // namespace zstep::query
