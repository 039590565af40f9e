// What another run has in a table: below each row the results that a second run has otherwise, and marks on those that
// the run before the last change has otherwise.

#include "sim/viewer/panes/number_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/since_change.hpp"
#include "sim/words/numbers.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

struct Column {
  std::vector<std::string> shown;
  int decimals = 0;
  float width = 0;
  bool numeric = false, hidden = false;
};

std::vector<Column> lay_out(Ui& ui, const std::vector<std::string>& headings, const std::vector<TableRow>& rows,
                            const ImFont* font, int at_most, bool brief) {
  std::vector<Column> columns(headings.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Column& column = columns[k];
    std::vector<double> values;
    for (const TableRow& row : rows)
      if (k < row.cells.size() && row.cells[k].value) values.push_back(*row.cells[k].value);
    column.numeric = !values.empty();
    column.decimals = decimals_needed(values, at_most);
    column.width = text_size(ui, ui.fonts.small, headings[k]).x;
    for (const TableRow& row : rows) {
      std::string text;
      if (k < row.cells.size()) {
        const TableCell& cell = row.cells[k];
        text = cell.value                     ? cell_number(*cell.value, column.decimals)
               : brief && !cell.brief.empty() ? cell.brief
                                              : cell.text;
      }
      float width = text_size(ui, font, text).x;
      if (k < row.cells.size() && row.cells[k].chip) width += ui.em * 0.75f;
      column.width = std::max(column.width, width);
      column.shown.push_back(std::move(text));
    }
  }
  return columns;
}

TableSeen seen(const std::vector<std::string>& headings, const std::vector<TableRow>& rows,
               const std::vector<Column>& columns) {
  TableSeen table{"", headings, {}};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    TableSeen::Row row{{}, rows[r].look == TableRow::Look::now};
    for (const Column& column : columns) row.cells.push_back(column.shown[r]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

float total(const std::vector<Column>& columns, float gap) {
  float width = 0;
  for (const Column& column : columns) width += column.hidden ? 0 : column.width + gap;
  return width;
}

}  // namespace

namespace {

/// A row as it is copied: numbers in full, tabs between cells, as a spreadsheet takes them.
std::string as_copied(const TableRow& row) {
  std::string line;
  for (std::size_t k = 0; k < row.cells.size(); ++k)
    line += (k ? "\t" : "") + (row.cells[k].value ? exact(*row.cells[k].value) : row.cells[k].text);
  return line;
}

std::string as_copied(const std::vector<std::string>& headings, const std::vector<TableRow>& rows) {
  std::string lines = fmt::format("{}\n", fmt::join(headings, "\t"));
  for (const TableRow& row : rows) lines += as_copied(row) + "\n";
  return lines;
}

}  // namespace

TableResult number_table(Ui& ui, const char* id, const std::vector<std::string>& headings,
                         const std::vector<TableRow>& rows) {
  TableResult result;
  const Theme& c = ui.colors();
  const float room = ImGui::GetContentRegionAvail().x;
  // When it does not fit: smaller gaps, two decimals of numbers that have many, smaller type, signs for words, fewer
  // columns; and at last the pane scrolls. With fewer decimals a number would be another one.
  float gap = std::round(ui.em * 0.85f);
  const ImFont* font = ui.fonts.mono;
  int at_most = usual_decimals;
  bool brief = false;
  std::vector<Column> columns = lay_out(ui, headings, rows, font, at_most, brief);
  if (ui.tables_seen) ui.tables_seen->push_back(seen(headings, rows, columns));
  const auto fits = [&] { return total(columns, gap) <= room; };
  const auto again = [&] { columns = lay_out(ui, headings, rows, font, at_most, brief); };
  while (!fits() && gap > ui.em * 0.5f) gap -= 1;
  while (!fits() && at_most > 2) --at_most, again();
  if (!fits()) font = ui.fonts.small, again();
  if (!fits()) brief = true, again();
  while (!fits() && gap > ui.em * 0.35f) gap -= 1;
  while (!fits() && gap > ui.em * 0.2f) gap -= 1;
  // Columns of numbers are dropped from the right before a number loses a digit that tells it apart. The first two
  // stay, and so does a last column of words.
  for (std::size_t k = columns.size(); k-- > 2 && !fits();) columns[k].hidden = columns[k].numeric;
  const float width = std::max(room, total(columns, gap));
  const float height = std::round(ui.fonts.mono->FontSize * 1.35f),
              text_top = std::round((height - font->FontSize) / 2) - 1;
  ImGui::PushID(id);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImDrawList* list = ImGui::GetWindowDrawList();

  ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 top = at;
  const float heading_height = std::round(ui.fonts.small->FontSize * 1.3f);
  const auto draw_headings = [&](float y) {
    float left = top.x + gap / 2;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k].hidden) continue;
      const float shift = columns[k].numeric ? columns[k].width - text_size(ui, ui.fonts.small, headings[k]).x : 0;
      draw_text(ui, {left + shift, y}, ui.fonts.small, c.muted, headings[k]);
      left += columns[k].width + gap;
    }
    list->AddRectFilled({top.x, y + heading_height - ui.thin}, {top.x + width, y + heading_height}, c.rule);
  };
  draw_headings(top.y);
  ImGui::Dummy({width, heading_height});
  float x = 0;

  for (std::size_t r = 0; r < rows.size(); ++r) {
    const TableRow& row = rows[r];
    at = ImGui::GetCursorScreenPos();
    ImGui::PushID(index32(r));
    const bool clicked = ImGui::InvisibleButton("row", {width, height});
    const bool hovered = ImGui::IsItemHovered();
    ImGui::PopID();
    const ImVec2 end{at.x + width, at.y + height};
    can_be_hit(ui, at, end);
    if (row.look == TableRow::Look::now) list->AddRectFilled(at, end, c.now_soft);
    if (row.lit) list->AddRectFilled(at, end, c.selected_soft);
    if (row.look == TableRow::Look::now) list->AddRectFilled(at, {at.x + std::round(3 * ui.thin), end.y}, c.now);
    if (row.lit) frame_box(ui, at, end, c.selected);
    if (row.key >= 0) ui.row_places[{id, row.key}] = {at, {std::min(width, room), height}};
    if (hovered && row.key >= 0) result.hovered = row.key;
    bool on_number = false;
    const ImU32 color = row.trust != Findings::Trust::right || row.look == TableRow::Look::other ? c.bad
                        : row.look == TableRow::Look::gone                                       ? c.muted
                                                                                                 : c.text;
    x = at.x + gap / 2;
    std::vector<std::string> exact_values;
    std::optional<double> number;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (k < row.cells.size() && row.cells[k].value)
        exact_values.push_back(headings[k] + " = " + exact(*row.cells[k].value));
      if (columns[k].hidden) continue;
      float left = x;
      if (k < row.cells.size() && row.cells[k].chip) {
        const float side = std::round(ui.em * 0.55f), y = at.y + std::round((height - side) / 2);
        list->AddRectFilled({left, y}, {left + side, y + side}, row.cells[k].chip);
        frame_box(ui, {left, y}, {left + side, y + side}, c.text);
        left += ui.em * 0.75f;
      }
      if (columns[k].numeric) left = x + columns[k].width - text_size(ui, font, columns[k].shown[r]).x;
      draw_text(ui, {left, at.y + text_top}, font, color, columns[k].shown[r]);
      if (k < row.cells.size() && row.cells[k].changed) {
        // A filled corner, as in the pixels that the step changed.
        const float side = std::round(ui.em * 0.32f);
        const ImVec2 corner{left + text_size(ui, font, columns[k].shown[r]).x + side, at.y + 1};
        list->AddTriangleFilled({corner.x - side, corner.y}, corner, {corner.x, corner.y + side}, c.changed);
      }
      if (k < row.cells.size() && row.cells[k].was) {
        draw_change_mark(ui, {left - std::round(ui.em * 0.4f), end.y - 1}, ui.em);
        exact_values.push_back((headings[k].empty() ? "" : headings[k] + " ") + was_text(*row.cells[k].was));
      }
      if (k < row.cells.size() && row.cells[k].value && row.cells[k].question)
        if (number_at(ui, {left - 2, at.y}, {left + text_size(ui, font, columns[k].shown[r]).x + 2, end.y},
                      *row.cells[k].question)) {
          on_number = true, number = row.cells[k].value;
          const std::string line = exact_line(ui.session.trace(), *row.cells[k].question);
          if (!line.empty()) exact_values.push_back(line);
        }
      x += columns[k].width + gap;
    }
    result.on_number = result.on_number || on_number;
    if (clicked && row.key >= 0 && !on_number) result.clicked = row.key;
    if (row.look == TableRow::Look::now) follow(ui, at.y, height);
    if (hovered && !exact_values.empty()) tooltip(ui, exact_values);
    if (hovered && ui.asks && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
      if (number) ui.here.push_back({.text = "Copy " + exact(*number), .copies = exact(*number)});
      ui.here.push_back({.text = "Copy this row", .copies = as_copied(row)});
      ui.here.push_back({.text = "Copy the table", .copies = as_copied(headings, rows)});
    }
  }
  // When they have scrolled away, the headings stay at the top of the pane as long as some row does.
  const float pane = ImGui::GetWindowPos().y, foot = ImGui::GetCursorScreenPos().y;
  if (top.y < pane && foot > pane + 2 * heading_height) {
    list->AddRectFilled({top.x, pane}, {top.x + width, pane + heading_height}, c.pane);
    draw_headings(pane);
  }
  ImGui::PopStyleVar();
  ImGui::PopID();
  return result;
}

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

std::optional<std::int32_t> edge_now(const RecordedEvent* event) {
  if (!event) return std::nullopt;
  if (const auto* e = get_if<EdgeTableInsert>(&event->event)) return e->edge;
  if (const auto* e = get_if<EdgeEnter>(&event->event)) return e->edge;
  if (const auto* e = get_if<EdgeStep>(&event->event)) return e->edge;
  if (const auto* e = get_if<EdgeRetire>(&event->event)) return e->edge;
  return std::nullopt;
}

std::string about_edge(const EdgeTableInsert& edge) {
  const auto [first, last] = std::minmax(edge.vertex_0, edge.vertex_1);
  return fmt::format("{}: {}-{}", edge.polygon, first, last);
}

}  // namespace zstep::viewer
