#include "sim/query/database.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <sqlite3.h>

#include "sim/query/virtual_table.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/scene.hpp"

namespace zstep::query {

namespace {

constexpr auto named_by = [] {
  std::array<Names, kind_count> names{};
  for_each_kind([&]<class E>() { names[kind_of<E>] = names_polygon<E>; });
  return names;
}();

Table table_of(std::size_t kind) {
  const bool facet = named_by[kind] == Names::facet, piece = named_by[kind] == Names::piece;
  Table table{std::string(description_of_kind(kind).name), std::string(description_of_kind(kind).meaning), {}};
  table.columns = {{"step", "the step, counted from 1"},
                   {"name", "the line of pseudo-code that recorded it"},
                   {"polygon", facet   ? "the polygon of its facet"
                               : piece ? "the polygon of its piece"
                                       : "the polygon at work; NULL where none is"},
                   {"scan_line", "the scan line at work; NULL before the first"}};
  table.named_by_facet = facet, table.named_by_piece = piece;
  for (const FieldOfKind& field : fields_of_kind(kind)) {
    if (field.name == "polygon") {
      table.own_polygon = true;
      table.columns[polygon_column] = {"polygon", std::string(field.meaning), &field};
      continue;
    }
    if (field.name == "x") table.x = size32(table.columns);
    if (field.name == "y") table.y = size32(table.columns);
    table.columns.push_back({std::string(field.name), std::string(field.meaning), &field});
  }
  if (table.x < 0 || table.y < 0) table.x = table.y = -1;
  return table;
}

}  // namespace

Cell Column::of(const Event& event) const {
  switch (field->type) {
    case FieldOfKind::Type::real:
      return field->read(event);
    case FieldOfKind::Type::word:
      return field->word_in(event);
    default:
      return std::int64_t{field->whole_in(event)};
  }
}

const std::vector<Table>& all_tables() {
  static const std::vector<Table> tables = [] {
    std::vector<Table> all;
    for (std::size_t kind = 0; kind < kind_count; ++kind) all.push_back(table_of(kind));
    return all;
  }();
  return tables;
}

std::vector<std::uint8_t> kinds_in(const Trace& trace) {
  std::vector<std::uint8_t> kinds;
  for (const StepInfo& step : trace.header().page)
    if (std::find(kinds.begin(), kinds.end(), step.kind) == kinds.end()) kinds.push_back(step.kind);
  return kinds;
}

namespace {

constexpr int longest_text = 100'000'000;       // bytes of a value
constexpr int longest_sql = 100'000;            // bytes of a statement
constexpr sqlite3_int64 most_memory = 1 << 30;  // bytes, of all that SQLite holds
constexpr int instructions_between_looks = 10'000;

// What reads, and nothing else: no file is opened, no table made, no setting changed.
int allow(void*, int action, const char*, const char* detail, const char*, const char*) {
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_READ:
    case SQLITE_RECURSIVE:
      return SQLITE_OK;
    case SQLITE_FUNCTION:
      return detail && std::string_view(detail) == "load_extension" ? SQLITE_DENY : SQLITE_OK;
    default:
      return SQLITE_DENY;
  }
}

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

Value value_of(sqlite3_stmt* statement, int column) {
  switch (sqlite3_column_type(statement, column)) {
    case SQLITE_INTEGER:
      return std::int64_t{sqlite3_column_int64(statement, column)};
    case SQLITE_FLOAT:
      return sqlite3_column_double(statement, column);
    case SQLITE_NULL:
      return std::monostate();
    default: {
      const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement, column));
      return std::string(bytes ? bytes : "", static_cast<std::size_t>(sqlite3_column_bytes(statement, column)));
    }
  }
}

// "depth_compare, depth_write, …"
std::string table_names(const Trace& trace) {
  std::string names;
  for (const std::uint8_t kind : kinds_in(trace)) names += (names.empty() ? "" : ", ") + all_tables()[kind].name;
  return names;
}

}  // namespace

struct Database::Impl {
  const Trace& trace;
  sqlite3* connection = nullptr;
  std::exception_ptr fault;  // of the trace, met while a table was read
  const Limits* limits = nullptr;
  std::chrono::steady_clock::time_point end;
  bool late = false, stopped = false;

  explicit Impl(const Trace& trace_) : trace(trace_) {
    if (sqlite3_open_v2(":memory:", &connection, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_PRIVATECACHE,
                        nullptr) != SQLITE_OK)
      throw std::runtime_error("SQLite cannot be opened");
    sqlite3_hard_heap_limit64(most_memory);
    sqlite3_exec(connection, "PRAGMA temp_store = MEMORY", nullptr, nullptr, nullptr);  // sorting writes no file
    make_tables(connection, trace, fault);
    sqlite3_limit(connection, SQLITE_LIMIT_LENGTH, longest_text);
    sqlite3_limit(connection, SQLITE_LIMIT_SQL_LENGTH, longest_sql);
    sqlite3_limit(connection, SQLITE_LIMIT_EXPR_DEPTH, 200);
    sqlite3_limit(connection, SQLITE_LIMIT_COMPOUND_SELECT, 50);
    sqlite3_limit(connection, SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 1000);
    sqlite3_limit(connection, SQLITE_LIMIT_ATTACHED, 0);
    sqlite3_limit(connection, SQLITE_LIMIT_TRIGGER_DEPTH, 1);
    sqlite3_set_authorizer(connection, allow, nullptr);
    sqlite3_progress_handler(connection, instructions_between_looks, look, this);
  }
  ~Impl() { sqlite3_close_v2(connection); }

  static int look(void* self) {
    Impl& impl = *static_cast<Impl*>(self);
    if (!impl.limits) return 0;
    impl.late = impl.limits->seconds > 0 && std::chrono::steady_clock::now() > impl.end;
    impl.stopped = impl.limits->stop && impl.limits->stop();
    return impl.late || impl.stopped;
  }

  /// The first statement of `rest`, which begins behind it afterwards; none where there is only white space or a
  /// comment.
  Statement prepare(const std::string& sql, std::string_view& rest) {
    sqlite3_stmt* statement = nullptr;
    const char* tail = nullptr;
    const int code = sqlite3_prepare_v2(connection, rest.data(), size32(rest), &statement, &tail);
    if (code != SQLITE_OK) fail(sql);
    rest.remove_prefix(static_cast<std::size_t>(tail - rest.data()));
    return Statement(statement);
  }

  [[noreturn]] void fail(const std::string& sql) {
    if (late || stopped) throw Stopped{late && !stopped};
    if (fault) std::rethrow_exception(fault);
    const std::string message = sqlite3_errmsg(connection);
    const int code = sqlite3_errcode(connection);
    if (code == SQLITE_AUTH || message.find("not authorized") != std::string::npos ||
        message.find("prohibited") != std::string::npos)
      throw InputError("query", "only reads: a trace is not changed, and no other file is opened", "ask with SELECT");
    if (code == SQLITE_NOMEM)
      throw InputError("query", "needs more than a gigabyte of memory", "ask for less: fewer rows to sort or to group");
    if (message.rfind("no such table", 0) == 0)
      throw InputError("query", message, "the tables of this trace are " + table_names(trace));
    const int at = sqlite3_error_offset(connection);
    const std::string where = at >= 0 && at < std::ssize(sql) ? fmt::format(", at \"{}\"", sql.substr(at, 24)) : "";
    throw InputError("query", message + where, "'zstep query FILE.ztrace' lists tables and columns");
  }
};

Database::Database(const Trace& trace) : impl_(std::make_unique<Impl>(trace)) {}
Database::~Database() = default;

void Database::run(const std::string& sql, const Limits& limits, const Columns& columns, const Row& row) {
  Impl& impl = *impl_;
  impl.limits = &limits;
  impl.late = impl.stopped = false;
  impl.fault = nullptr;
  impl.end = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                    std::chrono::duration<double>(limits.seconds));

  if (sql.size() > longest_sql)
    throw InputError("query", fmt::format("is longer than {} letters", longest_sql), "ask for less at once");
  std::string_view rest = sql;
  const Statement statement = impl.prepare(sql, rest);
  if (!statement) throw InputError("query", "asks nothing", "write a statement: select count(*) from …");
  if (impl.prepare(sql, rest)) throw InputError("query", "is more than one statement", "ask them one by one");
  sqlite3_stmt* const prepared = statement.get();
  if (sqlite3_stmt_readonly(prepared) == 0 || sqlite3_column_count(prepared) == 0)
    throw InputError("query", "only reads: a trace is not changed, and no other file is opened", "ask with SELECT");

  std::vector<std::string> names;
  const int count = sqlite3_column_count(prepared);
  for (int i = 0; i < count; ++i) names.emplace_back(sqlite3_column_name(prepared, i));
  columns(names);
  std::vector<Value> values(names.size());
  while (true) {
    const int step = sqlite3_step(prepared);
    if (step == SQLITE_DONE) return;
    if (step != SQLITE_ROW) impl.fail(sql);
    for (int i = 0; i < count; ++i) values[i] = value_of(prepared, i);
    if (!row(values)) return;
  }
}

}  // namespace zstep::query
