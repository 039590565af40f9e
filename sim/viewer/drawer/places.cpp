// Run until a condition holds, bookmarks, the range of the depths' colours: what is typed, and what is likely wanted.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/drawer/drawer.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {
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
