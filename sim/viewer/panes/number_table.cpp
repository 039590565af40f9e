#include "sim/viewer/panes/number_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/ranges.h>

#include "sim/viewer/panes/exact_line.hpp"
#include "sim/viewer/panes/since_change.hpp"
#include "sim/words/numbers.hpp"

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
    ImGui::PushID(static_cast<int>(r));
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

}  // namespace zstep::viewer
