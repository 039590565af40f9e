// A table of numbers: columns as wide as their content, aligned at the decimal point, rows that can be pointed at and
// held against a second run's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

struct TableCell {
  std::string text;
  std::optional<double> value;                ///< drawn with its column's decimals; exact on hover
  ImU32 chip = 0;                             ///< a swatch of this colour before the text
  std::optional<answers::Question> question;  ///< of a number: what a click asks
  std::string brief;                          ///< instead of the text where room is scarce; a sign
  bool changed = false;                       ///< by this step
  std::optional<std::string> was;  ///< in the run before the last change, where that has it otherwise; empty: not there
  bool result = false;  ///< the text is a result as numbers are: the second run's is shown where it is another
  TableCell(std::string t = {}) : text(std::move(t)) {}
  TableCell(double v) : value(v) {}
  TableCell(double v, answers::Question q) : value(v), question(std::move(q)) {}
  TableCell(std::string t, ImU32 color) : text(std::move(t)), chip(color) {}
  static TableCell result_of(std::string t, std::string in_brief = {}) {
    TableCell cell(std::move(t));
    cell.brief = std::move(in_brief), cell.result = true;
    return cell;
  }
};

struct TableRow {
  enum class Look { plain, now, gone, waiting, other };  ///< other: what the second run has in place of the row above
  std::vector<TableCell> cells;
  Look look = Look::plain;
  Findings::Trust trust = Findings::Trust::right;  ///< of what is wrong the text is red, and a sign says which it is
  bool lit = false;                                ///< selected or pointed at, here or in another pane
  int key = -1;                                    ///< what click and hover report; −1: nothing
  /// By which the row is found in the second run's table, of several rows about the same in their order; empty: it is
  /// not looked for there.
  std::string about = {};
  std::size_t name = 0;  ///< the cell that names it
};

struct TableResult {
  bool on_number = false;  ///< the mouse is over a number that can be asked about
  std::optional<int> hovered, clicked;
};

/// Draws headings and rows at the cursor. Decimals shrink, then gaps, before anything would be cut.
TableResult number_table(Ui& ui, const char* id, const std::vector<std::string>& headings,
                         const std::vector<TableRow>& rows);

/// A table's rows, marked where the run before the last change has them otherwise, and, below each whose numbers the
/// second run has otherwise, by more than rounding, those of it.
std::vector<TableRow> rows_of_both(Ui& ui, std::vector<TableRow> (*rows_of)(Ui&));
/// The edge that the step is about, if it is about one.
std::optional<std::int32_t> edge_now(const RecordedEvent* event);
/// What a row of an edge is about: numbers of edges are each run's own.
std::string about_edge(const EdgeTableInsert& edge);

// The rows of panes' tables that a second run is held against (rows_of_both in number_table.hpp).

/// The scan-line method's polygons, with planes and flags.
std::vector<TableRow> polygon_rows(Ui& ui);
/// The intervals of the edge at work, as faces hide it and as it is cut.
std::vector<TableRow> interval_rows(Ui& ui);
/// What the ray at work was held against.
std::vector<TableRow> ray_test_rows(Ui& ui);
/// The rays of the pixel at work.
std::vector<TableRow> ray_tree_rows(Ui& ui);
/// The nodes from the root of the BSP tree to the one at work.
std::vector<TableRow> path_rows(Ui& ui);

}  // namespace zstep::viewer
