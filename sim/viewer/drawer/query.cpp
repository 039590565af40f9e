// Questions in SQL: what is typed, and the rows of the answer.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"

namespace zstep::viewer {
namespace {

constexpr std::size_t measured = 200;  // rows; what is wider further down is cut

/// Widths of the columns, the widest narrowed until all fit.
std::vector<float> widths_for(Ui& ui, const Inquiry& inquiry, float room) {
  std::vector<float> widths;
  for (std::size_t k = 0; k < inquiry.columns().size(); ++k) {
    float width = text_size(ui, ui.fonts.small, inquiry.columns()[k]).x;
    for (std::size_t row = 0; row < std::min(measured, inquiry.rows().size()); ++row)
      width = std::max(width, text_size(ui, ui.fonts.mono, inquiry.rows()[row][k]).x);
    widths.push_back(width + ui.em);
  }
  float sum = 0;
  for (const float width : widths) sum += width;
  while (sum > room && !widths.empty()) {
    float& widest = *std::max_element(widths.begin(), widths.end());
    const float cut = std::min(sum - room, widest / 4);
    if (widest < 3 * ui.em) break;
    widest -= cut, sum -= cut;
  }
  return widths;
}

void draw_rows(App& app) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const Inquiry& inquiry = app.inquiry();
  const std::vector<float> widths = widths_for(ui, inquiry, ImGui::GetContentRegionAvail().x);
  const ImVec2 head = ImGui::GetCursorScreenPos();
  float x = head.x + 5;
  for (std::size_t k = 0; k < widths.size(); ++k) {
    draw_text(ui, {x, head.y}, ui.fonts.small, c.muted,
              fitted(ui, ui.fonts.small, inquiry.columns()[k], widths[k] - ui.em * 0.5f));
    x += widths[k];
  }
  ImGui::Dummy({1, std::round(ui.fonts.small->FontSize * 1.4f)});
  ImGui::BeginChild("rows", ImGui::GetContentRegionAvail(), false, ImGuiWindowFlags_NoNav);
  const float height = std::round(ui.fonts.mono->FontSize * 1.35f);
  std::optional<std::size_t> clicked;
  for (std::size_t row = 0; row < inquiry.rows().size(); ++row) {
    const ListRow line = list_row(app, row, height);
    if (line.clicked) clicked = row;
    if (!line.visible) continue;
    x = line.at.x + 5;
    for (std::size_t k = 0; k < widths.size(); ++k) {
      draw_text(ui, {x, line.at.y + 1}, ui.fonts.mono, c.text,
                fitted(ui, ui.fonts.mono, inquiry.rows()[row][k], widths[k] - ui.em * 0.5f));
      x += widths[k];
    }
  }
  app.scroll_to_picked = false;
  ImGui::EndChild();
  if (clicked) app.go_to_row(*clicked);
}

}  // namespace

void draw_query(App& app) {
  Ui& ui = app.ui();
  app.draw_drawer_field("select x, y, count(*) from depth_compare where not nearer group by x, y");
  const Inquiry& inquiry = app.inquiry();
  Flow how;
  how.color = ui.colors().muted;
  std::string note = inquiry.note();
  if (app.asking()) {
    note = "Asking the trace … Esc ends it.";
    how.color = ui.colors().now;
  } else if (!inquiry.rows().empty() && app.typed == inquiry.sql()) {
    note += ". Enter or a click goes where a row leads";
    if (inquiry.heat()) note += ui.heat ? "; Tab shows the colours again" : "; Tab paints them over the frame";
    note += ".";
  } else if (note.empty() || app.typed != inquiry.sql()) {
    note = "Enter asks. Tables are the kinds of events: " + app.tables() + ".";
  } else if (inquiry.is_wrong()) {
    note = "Not understood. " + note;
    how.color = ui.colors().bad;
    how.font = ui.fonts.bold;
  }
  flow(ui, note, how);
  if (!inquiry.columns().empty() && !app.asking()) draw_rows(app);
}

}  // namespace zstep::viewer
