// What a right click offers, beside the mouse: for the pixel, number, line of code or place in time that it points at.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/overlays.hpp"
#include "sim/viewer/panes/pane.hpp"

namespace zstep::viewer {

namespace {

/// Tabs as they can be drawn in one line.
std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '\t', ' ');
  return text;
}

}  // namespace

bool App::pick_here(SDL_Keycode code) {
  const auto line = static_cast<std::size_t>(picked);
  if (code != SDLK_RETURN || line >= here_.size()) return pick_among(here_.size(), code);
  take_here(line);
  return true;
}

void App::take_here(std::size_t line) {
  const HereLine taken = here_[line];
  open(Overlay::none);
  session_.message.clear();
  if (taken.first) taken.first(session_);
  if (taken.asks) open_explain(*taken.asks, taken.asks_as);
  if (!taken.copies.empty()) {
    requests.clipboard = taken.copies;
    const auto ends = std::count(taken.copies.begin(), taken.copies.end(), '\n');
    say(ends > 0 ? fmt::format("Copied {} lines; a spreadsheet takes them as a table.", ends)
                 : "Copied: " + spaced(taken.copies));
  }
  if (const Command* command = command_called(taken.command)) run(*command);
}

void draw_here(App& app, ImVec2 mouse) {
  Ui& ui = app.ui();
  const float height = std::max(std::round(ui.em * 1.5f), ui.least_target), gap = ui.em * 1.5f;
  const auto key_of = [](const HereLine& line) {
    const Command* command = command_called(line.command);
    return command ? key_names(*command) : std::string();
  };
  float widest = 0, keys = 0;
  for (const HereLine& line : app.here()) {
    widest = std::max(widest, text_size(ui, ui.fonts.text, line.text).x);
    keys = std::max(keys, text_size(ui, ui.fonts.mono, key_of(line)).x);
  }
  const ImVec2 size{widest + keys + gap + ui.em * 1.5f, height * static_cast<float>(app.here().size()) + ui.em};
  begin_overlay(app, "here", size, mouse);
  const float room = ImGui::GetContentRegionAvail().x - keys - gap;
  for (std::size_t k = 0; k < app.here().size(); ++k) {
    const HereLine& line = app.here()[k];
    const ListRow row = list_row(app, k, height);
    const float y = row.at.y + std::round((height - ui.em) / 2) - 1;
    draw_text(ui, {row.at.x + ui.em * 0.4f, y}, ui.fonts.text, ui.colors().text,
              fitted(ui, ui.fonts.text, line.text, room));
    draw_text(ui, {row.end.x - ui.em * 0.3f - text_size(ui, ui.fonts.mono, key_of(line)).x, y}, ui.fonts.mono,
              ui.colors().muted, key_of(line));
    if (row.clicked) {
      ImGui::End();
      return app.take_here(k);
    }
  }
  ImGui::End();
}

}  // namespace zstep::viewer
