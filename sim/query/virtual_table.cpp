#include "sim/query/virtual_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include <sqlite3.h>

#include "traces/file/visit.hpp"

namespace zstep::query {

Walk::Walk(const Trace& trace, std::uint8_t kind, const Part& part)
    : trace_(trace),
      kind_(kind),
      part_(part),
      names_(step_limit),
      position_(std::max<std::int64_t>(part.first, 1) - 1),
      end_of_turns_(trace.end_of_turns()) {
  for (const StepInfo& step : trace.header().page) {
    names_[step.id] = step.name;
    if (step.kind == kind) steps_.push_back(step.id);
    has_scan_lines_ = has_scan_lines_ || step.kind == kind_of<ScanLineBegin>;
  }
  part_.last = std::min(part_.last, trace.size());
  if (all_tables()[kind].named_by_piece) trace.polygon_of_piece(0);  // asks for events, which read_to() may not
}

// Goes on to the next block that may hold what is wanted; position_ is just before it or in it.
bool Walk::enter_block() {
  const auto marks = trace_.polygons();
  while (position_ < part_.last) {
    if (part_.polygon) {  // on to where work on that polygon begins, unless it is at work
      const auto after = std::upper_bound(marks.begin(), marks.end(), position_ + 1,
                                          [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
      const bool at_work = after != marks.begin() && (after - 1)->polygon == *part_.polygon;
      if (!at_work) {
        const auto begins =
            std::find_if(after, marks.end(), [&](const PolygonMark& mark) { return mark.polygon == *part_.polygon; });
        if (begins == marks.end() || begins->position > part_.last) return false;
        position_ = begins->position - 1;
      }
    }
    const std::size_t block = trace_.impl().block_of(position_ + 1);
    const BlockInfo& info = trace_.impl().blocks[block].info;
    const std::int64_t end = std::min(part_.last, info.first_position + info.count);
    const bool pixel_may = !part_.x || !part_.y || trace_.impl().last_touch(block, {*part_.x, *part_.y}) > position_;
    const bool kind_may =
        std::any_of(steps_.begin(), steps_.end(), [&](std::uint8_t step) { return info.steps.has(step); });
    if (pixel_may && kind_may) {
      if (position_ != known_to_) begin_context();
      read_to(end);
      if (!found_.empty()) return true;
    } else {
      position_ = end;
    }
  }
  return false;
}

// All that is wanted up to `end`, which is in the same block.
void Walk::read_to(std::int64_t end) {
  found_.clear();
  next_ = 0;
  trace_.visit(position_, end, [&]<class E>(std::int64_t position, std::uint8_t step, const E& event) {
    position_ = position;
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) {
      context_.polygon = event.polygon;
      context_.scan_line = -1;
    } else if constexpr (std::is_same_v<E, ScanLineBegin>) {
      context_.scan_line = event.y;
    }
    if (position == end_of_turns_) context_.polygon = no_polygon;
    if (kind_of<E> != kind_) return true;
    context_.step = position;
    context_.name = names_[step];
    found_.push_back({context_, event});
    if constexpr (names_polygon<E> == Names::facet || names_polygon<E> == Names::piece)
      found_.back().context.polygon = trace_.polygon_named(event).value_or(no_polygon);
    return true;
  });
  known_to_ = position_ = end;
}

// What is at work at position_, for who comes there from elsewhere.
void Walk::begin_context() {
  const auto marks = trace_.polygons();
  const auto after = std::upper_bound(marks.begin(), marks.end(), position_,
                                      [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
  context_.polygon = trace_.polygon_at_work(position_);
  context_.scan_line = -1;
  if (!has_scan_lines_) return;
  const std::int64_t begins = after == marks.begin() ? 1 : (after - 1)->position;
  const auto line = trace_.previous(
      position_ + 1, [](const RecordedEvent&) { return true; }, Trace::Among({}, kind_of<ScanLineBegin>, begins));
  if (line) context_.scan_line = get<ScanLineBegin>(trace_.event(*line).event).y;
}

bool Walk::next() {
  while (next_ >= found_.size()) {
    found_.clear();
    next_ = 0;
    if (position_ >= part_.last || !enter_block()) return false;
  }
  at_ = &found_[next_++];
  return true;
}

namespace {

// What a module knows of all its tables.
struct Source {
  const Trace& trace;
  std::exception_ptr& fault;
};

struct VirtualTable : sqlite3_vtab {
  const Source& source;
  std::uint8_t kind;
  const Table& table;
  VirtualTable(const Source& source_, std::uint8_t kind_)
      : sqlite3_vtab{}, source(source_), kind(kind_), table(all_tables()[kind_]) {}
};

struct Cursor : sqlite3_vtab_cursor {
  const VirtualTable& table;
  std::unique_ptr<Walk> walk;
  bool ended = true;
  explicit Cursor(const VirtualTable& table_) : sqlite3_vtab_cursor{}, table(table_) {}
};

VirtualTable& table_of(sqlite3_vtab* table) { return *static_cast<VirtualTable*>(table); }
Cursor& cursor_of(sqlite3_vtab_cursor* cursor) { return *static_cast<Cursor*>(cursor); }

// Nothing may be thrown through SQLite.
template <class Function>
int guarded(std::exception_ptr& fault, Function&& function) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    return SQLITE_NOMEM;
  } catch (...) {
    fault = std::current_exception();
    return SQLITE_ERROR;
  }
}

// argv: the module, the database, the table, and the kind as it was written in make_tables().
int connect(sqlite3* connection, void* aux, int, const char* const* argv, sqlite3_vtab** made, char**) {
  const auto& source = *static_cast<const Source*>(aux);
  return guarded(source.fault, [&] {
    const auto kind = static_cast<std::uint8_t>(std::stoi(argv[3]));
    auto table = std::make_unique<VirtualTable>(source, kind);
    std::string columns;
    for (const Column& column : table->table.columns) columns += (columns.empty() ? "\"" : ", \"") + column.name + "\"";
    const int code = sqlite3_declare_vtab(connection, ("CREATE TABLE t(" + columns + ")").c_str());
    if (code == SQLITE_OK) *made = table.release();
    return code;
  });
}

int disconnect(sqlite3_vtab* table) {
  delete &table_of(table);
  return SQLITE_OK;
}

// What filter() is told, in this order of bits; the values follow in the same order.
enum Bound : int {
  step_is = 1,
  step_from = 2,
  step_beyond = 4,
  step_to = 8,
  step_before = 16,
  x_is = 32,
  y_is = 64,
  polygon_is = 128
};

int bound_of(const Table& table, int column, unsigned char op) {
  if (column == step_column || column < 0) {  // the row's id is its step
    switch (op) {
      case SQLITE_INDEX_CONSTRAINT_EQ:
        return step_is;
      case SQLITE_INDEX_CONSTRAINT_GE:
        return step_from;
      case SQLITE_INDEX_CONSTRAINT_GT:
        return step_beyond;
      case SQLITE_INDEX_CONSTRAINT_LE:
        return step_to;
      case SQLITE_INDEX_CONSTRAINT_LT:
        return step_before;
      default:
        return 0;
    }
  }
  if (op != SQLITE_INDEX_CONSTRAINT_EQ) return 0;
  if (column == table.x) return x_is;
  if (column == table.y) return y_is;
  return column == polygon_column && !table.own_polygon && !table.named_by_facet && !table.named_by_piece ? polygon_is
                                                                                                          : 0;
}

int best_index(sqlite3_vtab* vtab, sqlite3_index_info* info) {
  const VirtualTable& table = table_of(vtab);
  int bounds = 0;
  for (int bit = step_is; bit <= polygon_is; bit *= 2) {
    for (int i = 0; i < info->nConstraint; ++i) {
      const auto& constraint = info->aConstraint[i];
      if (!constraint.usable || (bounds & bit) != 0 || bound_of(table.table, constraint.iColumn, constraint.op) != bit)
        continue;
      bounds |= bit;
      int count = 0;
      for (int b = bounds; b != 0; b &= b - 1) ++count;
      info->aConstraintUsage[i].argvIndex = count;
    }
  }
  info->idxNum = bounds;
  // Guesses: how much of the trace is walked over, and how many rows come of it.
  double rows = std::fmax(1.0, static_cast<double>(table.source.trace.size()));
  if ((bounds & (step_from | step_beyond)) != 0) rows /= 4;
  if ((bounds & (step_to | step_before)) != 0) rows /= 4;
  if ((bounds & polygon_is) != 0)
    rows /= std::fmax(1.0, static_cast<double>(table.source.trace.scene().polygons.size()));
  if ((bounds & x_is) != 0) rows /= 8;
  if ((bounds & y_is) != 0) rows /= 8;
  if ((bounds & step_is) != 0) rows = 1;
  info->estimatedCost = rows;
  info->estimatedRows = static_cast<sqlite3_int64>(rows);
  if ((bounds & step_is) != 0) info->idxFlags |= SQLITE_INDEX_SCAN_UNIQUE;
  const bool by_step =
      info->nOrderBy == 1 && (info->aOrderBy[0].iColumn == step_column || info->aOrderBy[0].iColumn < 0);
  if (by_step && !info->aOrderBy[0].desc) info->orderByConsumed = 1;
  return SQLITE_OK;
}

int open(sqlite3_vtab* vtab, sqlite3_vtab_cursor** made) {
  const VirtualTable& table = table_of(vtab);
  return guarded(table.source.fault, [&] {
    *made = std::make_unique<Cursor>(table).release();
    return SQLITE_OK;
  });
}

int close(sqlite3_vtab_cursor* cursor) {
  delete &cursor_of(cursor);
  return SQLITE_OK;
}

int advance(Cursor& cursor) {
  return guarded(cursor.table.source.fault, [&] {
    cursor.ended = !cursor.walk->next();
    return SQLITE_OK;
  });
}

// A bound as SQL gives it, as the whole number on the wanted side. What is no number compares with none: nothing is
// left out then, as SQLite holds each row against the condition itself.
struct Whole {
  std::int64_t at_least, at_most;  // the whole numbers next to it
  bool exact;
};
std::optional<Whole> whole_of(sqlite3_value* value) {
  const int type = sqlite3_value_type(value);
  if (type == SQLITE_INTEGER) return Whole{sqlite3_value_int64(value), sqlite3_value_int64(value), true};
  if (type != SQLITE_FLOAT) return std::nullopt;
  const double number = sqlite3_value_double(value);
  constexpr double most = 9e18;
  if (!(std::abs(number) <= most)) return std::nullopt;
  return Whole{static_cast<std::int64_t>(std::ceil(number)), static_cast<std::int64_t>(std::floor(number)),
               std::floor(number) == number};
}

std::optional<std::int32_t> number_of(const Whole& whole) {
  if (!whole.exact || whole.at_least < std::numeric_limits<std::int32_t>::min() ||
      whole.at_least > std::numeric_limits<std::int32_t>::max())
    return std::nullopt;
  return static_cast<std::int32_t>(whole.at_least);
}

int filter(sqlite3_vtab_cursor* c, int bounds, const char*, int count, sqlite3_value** values) {
  Cursor& cursor = cursor_of(c);
  const int code = guarded(cursor.table.source.fault, [&] {
    Part part;
    int next = 0;
    for (int bit = step_is; bit <= polygon_is && next < count; bit *= 2) {
      if ((bounds & bit) == 0) continue;
      const auto whole = whole_of(values[next++]);
      if (!whole) continue;
      const std::int64_t after =
          whole->at_most == std::numeric_limits<std::int64_t>::max() ? whole->at_most : whole->at_most + 1;
      const std::int64_t before =
          whole->at_least == std::numeric_limits<std::int64_t>::min() ? whole->at_least : whole->at_least - 1;
      switch (bit) {
        case step_is:
          part.first = std::max(part.first, whole->at_least), part.last = std::min(part.last, whole->at_most);
          break;
        case step_from:
          part.first = std::max(part.first, whole->at_least);
          break;
        case step_beyond:
          part.first = std::max(part.first, after);
          break;
        case step_to:
          part.last = std::min(part.last, whole->at_most);
          break;
        case step_before:
          part.last = std::min(part.last, before);
          break;
        case x_is:
          part.x = number_of(*whole);
          break;
        case y_is:
          part.y = number_of(*whole);
          break;
        default:
          part.polygon = number_of(*whole);
          break;
      }
    }
    cursor.walk = std::make_unique<Walk>(cursor.table.source.trace, cursor.table.kind, part);
    return SQLITE_OK;
  });
  return code == SQLITE_OK ? advance(cursor) : code;
}

int next(sqlite3_vtab_cursor* cursor) { return advance(cursor_of(cursor)); }
int at_end(sqlite3_vtab_cursor* cursor) { return cursor_of(cursor).ended; }

int row_id(sqlite3_vtab_cursor* cursor, sqlite3_int64* id) {
  *id = cursor_of(cursor).walk->context().step;
  return SQLITE_OK;
}

int give(sqlite3_context* to, const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) sqlite3_result_int64(to, *whole);
  else if (const auto* number = std::get_if<double>(&cell)) sqlite3_result_double(to, *number);  // not a number is NULL
  else if (const auto* text = std::get_if<std::string_view>(&cell))
    sqlite3_result_text(to, text->data(), static_cast<int>(text->size()), SQLITE_STATIC);
  else sqlite3_result_null(to);
  return SQLITE_OK;
}

int column(sqlite3_vtab_cursor* c, sqlite3_context* to, int number) {
  const Cursor& cursor = cursor_of(c);
  const Column& wanted = cursor.table.table.columns[number];
  const Context& context = cursor.walk->context();
  if (wanted.field) return give(to, wanted.of(cursor.walk->event()));
  switch (number) {
    case step_column:
      return give(to, context.step);
    case name_column:
      return give(to, context.name);
    case polygon_column:
      return give(to, context.polygon == no_polygon ? Cell() : Cell(std::int64_t{context.polygon}));
    default:
      return give(to, context.scan_line < 0 ? Cell() : Cell(std::int64_t{context.scan_line}));
  }
}

const sqlite3_module& module_of_traces() {
  static const sqlite3_module module = [] {
    sqlite3_module made{};
    made.xCreate = connect;
    made.xConnect = connect;
    made.xBestIndex = best_index;
    made.xDisconnect = disconnect;
    made.xDestroy = disconnect;
    made.xOpen = open;
    made.xClose = close;
    made.xFilter = filter;
    made.xNext = next;
    made.xEof = at_end;
    made.xColumn = column;
    made.xRowid = row_id;
    return made;
  }();
  return module;
}

}  // namespace

void make_tables(sqlite3* connection, const Trace& trace, std::exception_ptr& fault) {
  const auto forget = [](void* source) { delete static_cast<Source*>(source); };
  auto source = std::make_unique<Source>(Source{trace, fault});
  if (sqlite3_create_module_v2(connection, "trace", &module_of_traces(), source.release(), forget) != SQLITE_OK)
    throw std::runtime_error(sqlite3_errmsg(connection));
  for (const std::uint8_t kind : kinds_in(trace)) {
    const std::string sql =
        "CREATE VIRTUAL TABLE \"" + all_tables()[kind].name + "\" USING trace(" + std::to_string(kind) + ")";
    if (sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(connection));
  }
}

}  // namespace zstep::query
