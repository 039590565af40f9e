// What a second run has in a table: below each row the numbers that it has otherwise.
#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/panes/number_table.hpp"
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

/// The numbers of `b` that are not those of `a`; nothing where all are.
std::optional<TableRow> apart(const TableRow& a, const TableRow& b, double rounding) {
  TableRow line = line_of_b(a.cells.size(), a.name, sign_of_b);
  bool any = false;
  for (std::size_t k = 0; k < std::min(a.cells.size(), b.cells.size()); ++k) {
    const auto &mine = a.cells[k].value, &its = b.cells[k].value;
    if (!mine || !its || *mine == *its || formulas::gives(formulas::Rounded(*mine), *its, rounding)) continue;
    line.cells[k] = TableCell(*its);
    any = true;
  }
  return any ? std::optional(std::move(line)) : std::nullopt;
}

}  // namespace

std::vector<TableRow> rows_of_both(Ui& ui, std::vector<TableRow> (*rows_of)(Ui&)) {
  std::vector<TableRow> rows = rows_of(ui);
  if (!ui.other) return rows;
  const std::vector<TableRow> others = rows_of(*ui.other);
  std::map<std::string, const TableRow*> in_b;
  for (const TableRow& row : others)
    if (!row.about.empty()) in_b.emplace(row.about, &row);
  const double rounding = std::max(formulas::rounding_of(ui.session.header()),
                                   formulas::rounding_of(ui.other->session.header()));
  std::vector<TableRow> all;
  for (TableRow& row : rows) {
    all.push_back(std::move(row));
    const TableRow& mine = all.back();
    if (mine.about.empty()) continue;
    const auto its = in_b.find(mine.about);
    std::optional<TableRow> line;
    if (its == in_b.end()) line = line_of_b(mine.cells.size(), mine.name, fmt::format("{}: not in it", sign_of_b));
    else line = apart(mine, *its->second, rounding), in_b.erase(its);
    if (line) all.push_back(std::move(*line));
  }
  for (const TableRow& row : others) {
    if (row.about.empty() || !in_b.contains(row.about)) continue;
    TableRow line = line_of_b(row.cells.size(), row.name, fmt::format("{}: {}", sign_of_b, row.cells[row.name].text));
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      if (row.cells[k].value) line.cells[k] = TableCell(*row.cells[k].value);
    all.push_back(std::move(line));
  }
  return all;
}

std::string about_edge(const EdgeTableInsert& edge) {
  const auto [first, last] = std::minmax(edge.vertex_0, edge.vertex_1);
  return fmt::format("{}: {}-{}", edge.polygon, first, last);
}

}  // namespace zstep::viewer
