// What another run has in a table: below each row the results that a second run has otherwise, and marks on those that
// the run before the last change has otherwise.
#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/panes/since_change.hpp"
#include "sim/words/numbers.hpp"
#include "traces/formulas/rounding.hpp"

namespace zstep::viewer {
namespace {

constexpr const char* sign_of_b = "\u2260 B";

/// A line for the second run under a row of so many cells, all empty but its name.
TableRow line_of_b(std::size_t cells, std::size_t name, std::string text) {
  TableRow line;
  line.look = TableRow::Look::other;
  line.cells.resize(cells);
  line.cells[name] = TableCell(std::move(text));
  return line;
}

/// A result without what a row names it by.
TableCell result_of(const TableCell& cell) {
  return cell.value ? TableCell(*cell.value) : TableCell::result_of(cell.text, cell.brief);
}

bool same_result(const TableCell& a, const TableCell& b, double rounding) {
  if (a.value && b.value)
    return *a.value == *b.value || formulas::gives(formulas::Rounded(*a.value), *b.value, rounding);
  return (!a.result && !b.result) || (!a.value && !b.value && a.text == b.text);
}

/// The results of `b` that are not those of `a`; nothing where all are.
std::optional<TableRow> apart(const TableRow& a, const TableRow& b, double rounding) {
  TableRow line = line_of_b(a.cells.size(), a.name, sign_of_b);
  bool any = false;
  for (std::size_t k = 0; k < std::min(a.cells.size(), b.cells.size()); ++k) {
    if (same_result(a.cells[k], b.cells[k], rounding)) continue;
    line.cells[k] = result_of(b.cells[k]);
    any = true;
  }
  return any ? std::optional(std::move(line)) : std::nullopt;
}

/// What a row is about, and which of several about the same: the first of them is the first in the other run, too.
using About = std::pair<std::string, int>;
std::vector<About> abouts(const std::vector<TableRow>& table) {
  std::map<std::string, int> so_far;
  std::vector<About> found;
  for (const TableRow& row : table) found.emplace_back(row.about, so_far[row.about]++);
  return found;
}
std::map<About, const TableRow*> by_about(const std::vector<TableRow>& table) {
  const std::vector<About> about = abouts(table);
  std::map<About, const TableRow*> found;
  for (std::size_t k = 0; k < table.size(); ++k)
    if (!table[k].about.empty()) found.emplace(about[k], &table[k]);
  return found;
}

double rounding_of_both(const Ui& one, const Ui& other) {
  return std::max(formulas::rounding_of(one.session.header()), formulas::rounding_of(other.session.header()));
}

}  // namespace

void mark_changed(Ui& ui, std::vector<TableRow>& rows, std::vector<TableRow> (*rows_of)(Ui&)) {
  if (!ui.before) return;
  const std::vector<TableRow> before = rows_of(*ui.before);
  const std::map<About, const TableRow*> were = by_about(before);
  const std::vector<About> about = abouts(rows);
  const double rounding = rounding_of_both(ui, *ui.before);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    TableRow& row = rows[k];
    if (row.about.empty()) continue;
    const auto was = were.find(about[k]);
    if (was == were.end()) row.cells[row.name].was = "";
    for (std::size_t cell = 0; was != were.end() && cell < std::min(row.cells.size(), was->second->cells.size());
         ++cell) {
      const TableCell& then = was->second->cells[cell];
      if (same_result(row.cells[cell], then, rounding)) continue;
      const std::string text = then.value ? exact(*then.value) : then.text;
      row.cells[cell].was = text.empty() ? "\u2013" : text;
    }
  }
}

std::vector<TableRow> rows_of_both(Ui& ui, std::vector<TableRow> (*rows_of)(Ui&)) {
  std::vector<TableRow> rows = rows_of(ui);
  mark_changed(ui, rows, rows_of);
  if (!ui.other) return rows;
  const std::vector<TableRow> others = rows_of(*ui.other);
  const std::vector<About> about_mine = abouts(rows), about_others = abouts(others);
  std::map<About, const TableRow*> in_b = by_about(others);
  const double rounding = rounding_of_both(ui, *ui.other);
  std::vector<TableRow> all;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    all.push_back(std::move(rows[k]));
    const TableRow& mine = all.back();
    if (mine.about.empty()) continue;
    const auto its = in_b.find(about_mine[k]);
    std::optional<TableRow> line;
    if (its == in_b.end()) line = line_of_b(mine.cells.size(), mine.name, fmt::format("{}: not in it", sign_of_b));
    else line = apart(mine, *its->second, rounding), in_b.erase(its);
    if (line) all.push_back(std::move(*line));
  }
  for (std::size_t other = 0; other < others.size(); ++other) {
    const TableRow& row = others[other];
    if (!in_b.contains(about_others[other])) continue;
    TableRow line = line_of_b(row.cells.size(), row.name, fmt::format("{}: {}", sign_of_b, row.cells[row.name].text));
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      if (row.cells[k].value || row.cells[k].result) line.cells[k] = result_of(row.cells[k]);
    all.push_back(std::move(line));
  }
  return all;
}

std::string about_edge(const EdgeTableInsert& edge) {
  const auto [first, last] = std::minmax(edge.vertex_0, edge.vertex_1);
  return fmt::format("{}: {}-{}", edge.polygon, first, last);
}

}  // namespace zstep::viewer
