// The buttons that move and play.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/panes/pane.hpp"

namespace zstep::viewer {
namespace {

/// A button that does what a key does, and says so.
void command_button(Ui& ui, const char* label, const char* id, bool lit = false) {
  const Command* command = command_called(id);
  if (!command) return;
  if (button(ui, label, lit)) ui.clicked = command;
  if (!ImGui::IsItemHovered()) return;
  const std::string says = fmt::format("{} ({})", command->title, key_names(*command));
  tooltip(ui, {says});
  ui.mouse_help = says;
}

/// What a finger that rests on an arrow, or a right click there, is offered: longer ways.
void offer_units(Ui& ui, bool on) {
  if (!ImGui::IsItemHovered() || !ImGui::IsMouseClicked(ImGuiMouseButton_Right)) return;
  const auto line = [](const char* id) { return HereLine{.text = command_called(id)->title, .command = id}; };
  if (on) ui.here = {line("next-pixel"), line("next-span"), line("next-line"), line("next-polygon")};
  else ui.here = {line("previous-pixel"), line("previous-span"), line("previous-line"), line("previous-polygon")};
}

}  // namespace

void draw_transport(Ui& ui, bool playing, const std::string& speed, float widest, float room) {
  const float gap = ui.em * 0.25f, from = ImGui::GetCursorScreenPos().x;
  command_button(ui, "|\u25c0", "first");
  ImGui::SameLine(0, gap);
  command_button(ui, "\u25c0", "previous");
  ImGui::SameLine(0, gap);
  command_button(ui, playing ? "Pause" : "Play \u25b6\u25b6", "play", playing);
  ImGui::SameLine(0, gap);
  command_button(ui, "\u25b6", "next");
  ImGui::SameLine(0, gap);
  command_button(ui, "\u25b6|", "last");
  ImGui::SameLine(0, ui.em * 0.7f);
  const float sign = text_size(ui, ui.fonts.text, "\u2212").x + 2 * std::round(ui.em * 0.55f);
  if (ImGui::GetCursorScreenPos().x - from + widest + 2 * (sign + gap) > room) return;
  command_button(ui, "\u2212##slower", "slower");
  ImGui::SameLine(0, gap);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_text(ui, {at.x + (widest - text_size(ui, ui.fonts.text, speed).x) / 2, at.y + std::round(ui.em * 0.25f)},
            ui.fonts.text, ui.colors().text, speed);
  ImGui::Dummy({widest, ui.em});
  ImGui::SameLine(0, gap);
  command_button(ui, "+##faster", "faster");
}

void draw_small_transport(Ui& ui, bool playing, ImVec2 size) {
  const float gap = std::round(ui.em * 0.25f), x = ImGui::GetCursorScreenPos().x, y = ImGui::GetCursorScreenPos().y;
  // Where there is no room for five buttons, three.
  const int most = size.x - 4 * gap < 5 * (text_size(ui, ui.fonts.text, "Pause").x + ui.em) ? 1 : 2;
  const float room = size.x - 2 * gap * static_cast<float>(most);
  const float width = std::max(1.0f, std::floor(room / static_cast<float>(2 * most + 1)));
  const char* const play = width < 5.2f * ui.em ? "\u25b6\u25b6" : "Play \u25b6\u25b6";
  const std::pair<const char*, const char*> all[] = {{"|\u25c0", "first"},
                                                     {"\u25c0", "previous"},
                                                     {playing ? "Pause" : play, "play"},
                                                     {"\u25b6##one", "next"},
                                                     {"\u25b6|", "last"}};
  for (int k = -most; k <= most; ++k) {
    const auto& [label, id] = all[k + 2];
    ImGui::SetCursorScreenPos({x + static_cast<float>(k + most) * (width + gap), y});
    if (button_of(ui, label, {width, size.y}, k == 0 && playing)) ui.clicked = command_called(id);
    if (ImGui::IsItemHovered()) ui.mouse_help = command_called(id)->title;
    if (k != 0) offer_units(ui, k > 0);
  }
}

}  // namespace zstep::viewer
