// zstep query: questions to a trace in SQL; each kind of event is a table.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/cost/comparison.hpp"
#include "sim/query/database.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

struct QueryOptions {
  std::string trace, sql;
  bool csv = false, json = false;
};

// --- An answer's rows as they come

class Answer {
 public:
  virtual ~Answer() = default;
  virtual void columns(const std::vector<std::string>& names) = 0;
  virtual void row(std::span<const query::Value> values) = 0;
  virtual void end(bool /*complete*/) {}
};

std::string number_text(double value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return fmt::format("{}", value);
}

class Csv : public Answer {
 public:
  void columns(const std::vector<std::string>& names) override {
    for (std::size_t i = 0; i < names.size(); ++i) fmt::print("{}{}", i == 0 ? "" : ",", compare::csv_cell(names[i]));
    fmt::print("\n");
  }
  void row(std::span<const query::Value> values) override {
    std::string line;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) line += ',';
      if (const auto* whole = std::get_if<std::int64_t>(&values[i])) line += std::to_string(*whole);
      else if (const auto* number = std::get_if<double>(&values[i])) line += number_text(*number);
      else if (const auto* text = std::get_if<std::string>(&values[i])) line += compare::csv_cell(*text);
    }
    fmt::print("{}\n", line);
  }
};

/// A list of objects, one a line. JSON has no infinity; it is written as in traces, "inf".
class Json : public Answer {
 public:
  void columns(const std::vector<std::string>& names) override {
    for (const std::string& name : names) names_.push_back(text_of(name));
  }
  void row(std::span<const query::Value> values) override {
    std::string line = rows_++ == 0 ? "[\n{" : ",\n{";
    for (std::size_t i = 0; i < values.size(); ++i) {
      line += (i == 0 ? "" : ",") + names_[i] + ":";
      if (const auto* whole = std::get_if<std::int64_t>(&values[i])) line += std::to_string(*whole);
      else if (const auto* number = std::get_if<double>(&values[i]))
        line += std::isfinite(*number) ? fmt::format("{}", *number) : text_of(number_text(*number));
      else if (const auto* text = std::get_if<std::string>(&values[i])) line += text_of(*text);
      else line += "null";
    }
    fmt::print("{}}}", line);
  }
  void end(bool) override { fmt::print("{}\n", rows_ == 0 ? "[]" : "\n]"); }

 private:
  static std::string text_of(const std::string& text) {
    return printable_json(nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  std::vector<std::string> names_;
  std::int64_t rows_ = 0;
};

/// Columns under each other, so many rows at a time.
class Lines : public Answer {
 public:
  void columns(const std::vector<std::string>& names) override {
    rows_.push_back(names);
    align_.assign(names.size(), Table::Align::right);
  }
  void row(std::span<const query::Value> values) override {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (const auto* whole = std::get_if<std::int64_t>(&values[i])) cells.push_back(std::to_string(*whole));
      else if (const auto* number = std::get_if<double>(&values[i]))
        cells.push_back(std::isfinite(*number) ? fmt::format("{:.9g}", *number) : number_text(*number));
      else if (const auto* text = std::get_if<std::string>(&values[i]))
        cells.push_back(*text), align_[i] = Table::Align::left;
      else cells.emplace_back();
    }
    rows_.push_back(std::move(cells));
    any_ = true;
    if (rows_.size() > at_once) flush();
  }
  void end(bool complete) override {
    flush();
    if (complete && !any_) fmt::print("no rows\n");
  }

 private:
  static constexpr std::size_t at_once = 1000;
  void flush() {
    Table table(align_);
    for (auto& cells : rows_) table.row(std::move(cells));
    fmt::print("{}", table.text(0));
    rows_.clear();
  }
  std::vector<std::vector<std::string>> rows_;
  std::vector<Table::Align> align_;
  bool any_ = false;
};

// --- The command

/// What can be asked: tables with their columns.
void print_tables(const Trace& trace) {
  for (const std::uint8_t kind : query::kinds_in(trace)) {
    const query::Table& table = query::all_tables()[kind];
    fmt::print("{}: {}\n", table.name, table.meaning);
    std::string columns;
    for (const query::Column& column : table.columns) columns += (columns.empty() ? "  " : ", ") + column.name;
    fmt::print("{}\n", columns);
  }
}

int ask(const QueryOptions& options) {
  if (options.csv && options.json)
    throw InputError("zstep query", "--csv and --json are both given", "keep one of them");
  const Trace trace = open_trace(options.trace);
  if (options.sql.empty()) {
    print_tables(trace);
    return exit_code::done;
  }
  Watch watch;
  query::Database database(trace);
  query::Limits limits;
  limits.stop = [&] { return watch.interrupted() || time_is_up(); };
  std::unique_ptr<Answer> answer;
  if (options.csv) answer = std::make_unique<Csv>();
  else if (options.json) answer = std::make_unique<Json>();
  else answer = std::make_unique<Lines>();
  try {
    database.run(
        options.sql, limits, [&](const std::vector<std::string>& names) { answer->columns(names); },
        [&](std::span<const query::Value> values) {
          answer->row(values);
          return std::ferror(stdout) == 0;
        });
  } catch (const query::Stopped&) {
    answer->end(false);
    if (watch.interrupted()) throw Interrupted{0};
    throw Incomplete("query", "was not done in time; what is printed is a part",
                     "ask for fewer steps, or give --seconds more");
  }
  answer->end(true);
  return exit_code::done;
}

}  // namespace

void add_query(CLI::App& app, Action& action) {
  const auto options = std::make_shared<QueryOptions>();
  CLI::App* command = app.add_subcommand("query", "Ask a trace in SQL: each kind of event is a table");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_option("sql", options->sql, "One SELECT of SQLite; without it, the tables and their columns")
      ->type_name("SQL");
  command->add_flag("--csv", options->csv, "Comma-separated values, with a head");
  command->add_flag("--json", options->json, "A list of objects");
  command->footer(
      "Besides an event's own columns each table has step, name (of the line of pseudo-code), polygon and scan_line "
      "(at\n"
      "work). docs/querying.md has questions to begin with.\n"
      "\n"
      "Examples:\n"
      "  zstep query run.ztrace\n"
      "  zstep query run.ztrace \"select x, y, count(*) from depth_compare where not nearer group by x, y\"\n"
      "  zstep query run.ztrace \"select * from depth_compare where x = 8 and y = 5\" --csv");
  command->callback([options, &action] { action = [options] { return ask(*options); }; });
}

}  // namespace zstep::cli
