// Run until a condition holds, bookmarks: what is typed, what is likely wanted, and how far a search has come.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/overlays.hpp"
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
  ImGui::PushClipRect(at, {at.x + split - ui.em * 0.5f, end.y}, true);
  draw_text(ui, {at.x + ui.em * 0.5f, y}, font, c.text, first);
  ImGui::PopClipRect();
  draw_text(ui, {at.x + split, y}, ui.fonts.text, second_muted ? c.muted : c.text,
            fitted(ui, ui.fonts.text, second, end.x - removes - at.x - split));
  if (removes > 0) draw_text(ui, {end.x - removes + ui.em * 0.4f, y}, ui.fonts.bold, c.muted, "\u00d7");
  return row.clicked;
}

}  // namespace

void draw_until(App& app) {
  Ui& ui = app.ui();
  const auto suggestions = app.places().suggestions();
  const float rows = static_cast<float>(suggestions.size());
  begin_overlay(app, "until", {ui.em * 45, ui.em * (8.4f + rows * 1.4f + (app.wrong.empty() ? 0.0f : 4.4f))});
  const Flow heading{.font = ui.fonts.bold};
  flow(ui, "Run until this is true. Enter: forwards; Shift+Enter: backwards; J and Shift+J: once more.", heading);
  app.draw_field("not nearer");
  if (!app.wrong.empty()) say_wrong(ui, app.wrong);
  const Flow how{.color = ui.colors().muted};
  flow(ui, "Or: z < 4.2 && x == 9, polygon == B, compare where x > 9, changes(9, 17).", how);
  flow(ui, "\u2191 \u2193 or a click take one of these:", how);
  ImGui::Dummy({1, ui.em * 0.3f});
  ImGui::BeginChild("suggestions", ImGui::GetContentRegionAvail(), false, ImGuiWindowFlags_NoNav);
  std::optional<std::size_t> clicked;
  for (std::size_t i = 0; i < suggestions.size(); ++i)
    if (draw_row(app, i, ui.em * 22, ui.fonts.mono, suggestions[i].condition, suggestions[i].meaning, true))
      clicked = i;
  app.scroll_to_picked = false;
  ImGui::EndChild();
  ImGui::End();
  if (clicked) app.run_until(suggestions[*clicked].condition, Places::Way::forwards);
}

void draw_name_bookmark(App& app) {
  Ui& ui = app.ui();
  begin_overlay(app, "name bookmark", {ui.em * 30, ui.em * (app.wrong.empty() ? 7.0f : 9.5f)});
  flow(ui, fmt::format("A bookmark at step {}", grouped(app.session().position())), {.font = ui.fonts.bold});
  app.draw_field("the first tie");
  const bool clicked = button(ui, "Keep it");
  ImGui::SameLine(0, ui.em * 0.6f);
  if (app.wrong.empty()) flow(ui, "Its name, or none. Enter keeps it; L lists all.", {.color = ui.colors().muted});
  else say_wrong(ui, app.wrong);
  ImGui::End();
  if (clicked) app.keep_bookmark();
}

void draw_range(App& app) {
  Ui& ui = app.ui();
  begin_overlay(app, "range", {ui.em * 32, ui.em * 7.5f});
  flow(ui, "The depths that the colours span", {.font = ui.fonts.bold});
  app.draw_field("0.2 0.8");
  const Flow how{.color = ui.colors().muted};
  if (app.wrong.empty())
    flow(ui, "The nearest and the farthest. Nothing: all of the trace. R fits them to what is shown.", how);
  else say_wrong(ui, app.wrong);
  ImGui::End();
}

void draw_bookmarks(App& app) {
  Ui& ui = app.ui();
  const auto& all = app.places().bookmarks();
  const float rows = std::clamp(static_cast<float>(all.size()), 2.0f, 14.0f);
  begin_overlay(app, "bookmarks",
                {ui.em * 42, ui.em * (4.5f + rows * 1.4f) + (app.places().trouble().empty() ? 0 : ui.em * 2)});
  const Flow heading{.font = ui.fonts.bold};
  flow(ui, "Bookmarks. Enter or a click goes there; Delete or \u00d7 removes one; Ctrl+B sets one.", heading);
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
  ImGui::End();
  if (clicked && removes) app.remove_bookmark(*clicked);
  else if (clicked) app.go_to_bookmark(*clicked);
}

void draw_search(App& app) { draw_progress(app, app.places().progress(), app.places().share(), "Esc stops"); }

void draw_progress(App& app, const std::string& text, double share, const std::string& help) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float pad = std::round(ui.em * 0.7f), bar = std::round(ui.em * 0.4f);
  const float width = std::min(
      screen.x - 8,
      std::max(text_size(ui, ui.fonts.text, text).x + text_size(ui, ui.fonts.bold, help).x + 2 * ui.em, ui.em * 20) +
          2 * pad);
  const ImVec2 size{width, std::round(ui.em * 2.6f)},
      at{std::floor((screen.x - size.x) / 2), std::floor(screen.y * 0.3f)};
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::SetNextWindowFocus();
  ImGui::Begin("progress", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + size.x, at.y + size.y};
  list->AddRectFilled(at, end, c.pane);
  frame_box(ui, at, end, c.now, 2);
  draw_text(ui, {at.x + pad, at.y + ui.em * 0.5f}, ui.fonts.text, c.text, text);
  draw_text(ui, {end.x - pad - text_size(ui, ui.fonts.bold, help).x, at.y + ui.em * 0.5f}, ui.fonts.bold, c.now, help);
  const float y = end.y - bar - ui.em * 0.35f, whole = size.x - 2 * pad;
  list->AddRectFilled({at.x + pad, y}, {at.x + pad + whole, y + bar}, c.head);
  list->AddRectFilled({at.x + pad, y}, {at.x + pad + whole * static_cast<float>(share), y + bar}, c.now);
  ImGui::End();
}

}  // namespace zstep::viewer
