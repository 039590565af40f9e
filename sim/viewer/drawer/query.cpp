// Questions in SQL, what is typed and the rows of the answer; and places: conditions and bookmarks.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/words/numbers.hpp"

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

// Run until a condition holds, bookmarks, the range of the depths' colours: what is typed, and what is likely wanted.

namespace {

/// A row of two columns, the second muted; true when clicked. At its end, so wide, a sign that removes it.
bool draw_row(App& app, std::size_t place, float split, const ImFont* font, const std::string& first,
              const std::string& second, bool second_muted, float removes = 0) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const ListRow row = list_row(app, place, std::round(ui.em * 1.4f));
  const ImVec2 at = row.at, end = row.end;
  const float y = at.y + ui.em * 0.15f;
  draw_text(ui, {at.x + ui.em * 0.5f, y}, font, c.text, fitted(ui, font, first, split - ui.em));
  draw_text(ui, {at.x + split, y}, ui.fonts.text, second_muted ? c.muted : c.text,
            fitted(ui, ui.fonts.text, second, end.x - removes - at.x - split));
  if (removes > 0) draw_text(ui, {end.x - removes + ui.em * 0.4f, y}, ui.fonts.bold, c.muted, "\u00d7");
  return row.clicked;
}

}  // namespace

void draw_until(App& app) {
  Ui& ui = app.ui();
  const Flow how{.color = ui.colors().muted};
  const bool beside = begin_first(ui, "condition", 0.42f, ui.em * 9.6f);
  flow(ui, "Run until this is true.", {.font = ui.fonts.bold});
  app.draw_drawer_field("not nearer");
  if (!app.wrong.empty()) say_wrong(ui, app.wrong);
  flow(ui, "Enter: forwards; Shift+Enter: backwards; J and Shift+J: once more.", how);
  flow(ui, "Or: z < 4.2 && x == 9, polygon == B, compare where x > 9, changes(9, 17).", how);
  ImGui::EndChild();
  begin_second(ui, "suggestions", beside);
  flow(ui, "\u2191 \u2193 or a click take one of these:", how);
  const auto suggestions = app.places().suggestions();
  const float split = std::min(ui.em * 22, ImGui::GetContentRegionAvail().x * 0.58f);
  std::optional<std::size_t> clicked;
  for (std::size_t i = 0; i < suggestions.size(); ++i)
    if (draw_row(app, i, split, ui.fonts.mono, suggestions[i].condition, suggestions[i].meaning, true)) clicked = i;
  app.scroll_to_picked = false;
  ImGui::EndChild();
  if (clicked) app.run_until(suggestions[*clicked].condition, Places::Way::forwards);
}

void draw_name_bookmark(App& app) {
  Ui& ui = app.ui();
  flow(ui, fmt::format("A bookmark at step {}", grouped(app.session().position())), {.font = ui.fonts.bold});
  app.draw_drawer_field("the first tie");
  const bool clicked = button(ui, "Keep it");
  ImGui::SameLine(0, ui.em * 0.6f);
  if (app.wrong.empty()) flow(ui, "Its name, or none. Enter keeps it; L lists all.", {.color = ui.colors().muted});
  else say_wrong(ui, app.wrong);
  if (clicked) app.keep_bookmark();
}

void draw_range(App& app) {
  Ui& ui = app.ui();
  flow(ui, "The depths that the colours span", {.font = ui.fonts.bold});
  app.draw_drawer_field("0.2 0.8");
  const Flow how{.color = ui.colors().muted};
  if (app.wrong.empty())
    flow(ui, "The nearest and the farthest. Nothing: all of the trace. R fits them to what is shown.", how);
  else say_wrong(ui, app.wrong);
}

void draw_bookmarks(App& app) {
  Ui& ui = app.ui();
  const auto& all = app.places().bookmarks();
  flow(ui, "Enter or a click goes there; Delete or \u00d7 removes one; Ctrl+B sets one.", {.color = ui.colors().muted});
  ImGui::Dummy({1, ui.em * 0.3f});
  if (!app.places().trouble().empty()) say_wrong(ui, app.places().trouble());
  else if (all.empty()) say_empty(ui, "None yet. Ctrl+B sets one at the step where you are.");
  ImGui::BeginChild("list", ImGui::GetContentRegionAvail(), false, ImGuiWindowFlags_NoNav);
  std::optional<std::size_t> clicked;
  bool removes = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x, sign = ui.em * 1.6f;
    if (draw_row(app, i, ui.em * 8, ui.fonts.mono, grouped(all[i].step), all[i].name, false, sign))
      clicked = i, removes = ImGui::GetIO().MousePos.x >= end - sign;
  }
  app.scroll_to_picked = false;
  ImGui::EndChild();
  if (clicked) removes ? app.remove_bookmark(*clicked) : app.go_to_bookmark(*clicked);
}

}  // namespace zstep::viewer
