// One page for all that stays from run to run: each row says what it is now, and has the keys of the commands that
// change it.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/commands.hpp"
#include "sim/viewer/overlays.hpp"

namespace zstep::viewer {
namespace {

struct SettingRow {
  const char* title;
  const char *less, *more;  ///< commands; the same where there are but two states, or one thing to be done
  std::string (*now)(App&);
};

const std::array<SettingRow, 7>& setting_rows() {
  static const std::array<SettingRow, 7> all{
      {{"Text size", "smaller", "larger",
        [](App& a) { return fmt::format("{:.0f} %", a.settings().text_scale * 100); }},
       {"Speed of playing", "slower", "faster",
        [](App& a) { return std::string(Session::speeds()[static_cast<std::size_t>(a.session().speed)].name); }},
       {"Colours", "theme", "theme", [](App& a) { return std::string(a.settings().dark ? "dark" : "light"); }},
       {"Presenter mode, for a class", "presenter", "presenter",
        [](App& a) { return std::string(a.settings().presenter ? "on" : "off"); }},
       {"Reduced motion", "reduced-motion", "reduced-motion",
        [](App& a) {
          return std::string(a.settings().reduced_motion ? "on: nothing moves by itself" : "off: panes move");
        }},
       {"Borders between panes", "layout", "layout",
        [](App& a) {
          return std::string(a.settings().layout == Layout{} ? "as usual" : "moved; a click puts them back");
        }},
       {"Full screen", "full-screen", "full-screen", [](App&) { return std::string("on, or off"); }}}};
  return all;
}

void carry_out(App& app, const char* id) { app.run(*command_called(id)); }

std::string keys_of(const SettingRow& row) {
  const std::string less = key_names(*command_called(row.less));
  return row.less == row.more ? less : less + ", " + key_names(*command_called(row.more));
}

}  // namespace

bool App::pick_setting(SDL_Keycode code) {
  const int rows = static_cast<int>(setting_rows().size());
  const SettingRow& row = setting_rows()[static_cast<std::size_t>(std::clamp(picked, 0, rows - 1))];
  if (code == SDLK_UP || code == SDLK_DOWN) picked = std::clamp(picked + (code == SDLK_DOWN ? 1 : -1), 0, rows - 1);
  else if (code == SDLK_LEFT) carry_out(*this, row.less);
  else if (code == SDLK_RIGHT || code == SDLK_RETURN) carry_out(*this, row.more);
  else return false;
  return true;
}

void draw_settings(App& app) {
  Ui& ui = app.ui();
  const float room = ImGui::GetIO().DisplaySize.x - 3 * ui.em;
  float names = 0, values = 0, keys = 0;
  for (const SettingRow& row : setting_rows()) {
    names = std::max(names, text_size(ui, ui.fonts.text, row.title).x);
    values = std::max(values, text_size(ui, ui.fonts.text, row.now(app)).x);
    keys = std::max(keys, text_size(ui, ui.fonts.mono, keys_of(row)).x);
  }
  const float buttons = 4.2f * ui.em, all = names + values + buttons + keys + 4 * ui.em;
  const bool with_keys = all <= room;
  const std::string path = settings_path().string();
  const std::string kept = path.empty() ? "They hold until the window is closed: there is no folder to keep them in."
                                        : "Kept as they change, in " + path + ".";
  const float width = std::min(room, with_keys ? all : all - keys);
  const bool narrow = all - keys > room;  // what it is now stands below what it is
  const float height = std::max(std::round(ui.em * (narrow ? 2.9f : 2.1f)), ui.least_target);
  const Flow small{.color = ui.colors().muted, .width = width};
  begin_overlay(app, "settings",
                {width + ui.em * 1.2f, height * static_cast<float>(setting_rows().size()) +
                                           (narrow ? 4.8f : 3.4f) * ui.em + flow_height(ui, kept, small)});
  flow(ui, "Settings. \u2191 \u2193 choose a row, \u2190 \u2192 change it; Esc closes.", {.font = ui.fonts.bold});
  ImGui::Dummy({1, ui.em * 0.4f});
  const char* clicked = nullptr;
  for (std::size_t k = 0; k < setting_rows().size(); ++k) {
    const SettingRow& row = setting_rows()[k];
    const ImVec2 at = ImGui::GetCursorScreenPos(), end{at.x + width, at.y + height};
    if (static_cast<int>(k) == app.picked) {
      ImGui::GetWindowDrawList()->AddRectFilled(at, end, ui.colors().now_soft);
      ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + 3, end.y}, ui.colors().now);
    }
    const float y = at.y + std::round((height - ui.em * (narrow ? 2.3f : 1)) / 2) - 1;
    draw_text(ui, {at.x + ui.em * 0.5f, y}, ui.fonts.text, ui.colors().text, row.title);
    const float x = narrow ? end.x - buttons : at.x + names + ui.em * 1.2f,
                middle = std::round((height - ui.em * 1.6f) / 2);
    const auto press = [&](float left, const std::string& label, const char* id) {
      ImGui::SetCursorScreenPos({left, at.y + middle});
      if (button(ui, fmt::format("{}##{}{}", label, id, k))) clicked = id, app.picked = static_cast<int>(k);
    };
    if (row.less == row.more) {
      press(x, "\u21c4", row.more);
    } else {
      press(x, "\u2212", row.less);
      press(x + ui.em * 2.0f, "+", row.more);
    }
    if (narrow) draw_text(ui, {at.x + ui.em * 0.5f, y + ui.em * 1.25f}, ui.fonts.text, ui.colors().muted, row.now(app));
    else draw_text(ui, {x + buttons, y}, ui.fonts.text, ui.colors().text, row.now(app));
    if (with_keys) {
      const std::string its = keys_of(row);
      draw_text(ui, {end.x - text_size(ui, ui.fonts.mono, its).x - ui.em * 0.4f, y + 1}, ui.fonts.mono,
                ui.colors().muted, its);
    }
    ImGui::SetCursorScreenPos({at.x, end.y});
  }
  ImGui::Dummy({1, ui.em * 0.5f});
  flow(ui, kept, small);
  ImGui::End();
  if (clicked) carry_out(app, clicked);
}

}  // namespace zstep::viewer
